#!/bin/bash
# Tables (Markdown, on stdout) and pictures of validation/paper/README.md.
#
#   validation/paper/run.sh [PROGRAM] > tables.md      PROGRAM: default build/release/signorini
#
# Needs bash, python3 (standard library only) and gnuplot with pngcairo. Results go to validation/paper/out, which
# is removed first. One run at a time, so that times mean something; some three minutes.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(realpath "${1:-$root/build/release/signorini}")
scene=models/pipeline.toml
steps="5e-4 2e-4 1e-4 5e-5 2e-5 1e-5 5e-6 2e-6 1e-6"
finer="5e-7 2e-7 1e-7" # only to 0.1 s
cd "$root"
out=validation/paper/out
rm -rf "$out"
mkdir -p "$out"

# run NAME ENGINE FRICTION [KEY=VALUE...]; a run that stops early keeps its summary, and its row says so
run() {
  local name=$1 engine=$2 f=$3 sets=() code=0
  shift 3
  for s in "$@"; do sets+=(--set "$s"); done
  "$program" run $scene -o "$out/$name" --engine "$engine" --set run.certify=false --set "contacts.*.friction=$f" "${sets[@]}" \
    --quiet --no-plots 2>>"$out/messages.txt" || code=$?
  if [ $code -ne 0 ] && [ $code -ne 4 ]; then echo "$name: exit code $code" >&2; exit 1; fi
}

echo "sweep" >&2
"$program" sweep $scene --vary 'contacts.*.friction=0:1.3:0.1' --set run.engine=exact -o "$out/sweep" --quiet --no-plots

echo "histories" >&2
for f in 0 0.1 0.3 0.5 1.0 1.3; do run "history-$f" exact $f; done

echo "forces" >&2
run forces-exact exact 1.3 run.output_dt=2e-5 run.t_end=0.4
run forces-newmark newmark 1.3 run.output_dt=2e-5 run.t_end=0.4 run.dt=1e-5
run forces-friction-iteration friction-iteration 1.3 run.output_dt=2e-5 run.t_end=0.4 run.dt=1e-5

echo "errors" >&2
for f in 0.3 1.3; do
  run "error-$f-exact" exact $f
  for dt in $steps; do
    run "error-$f-root-$dt" newmark $f run.dt=$dt
    run "error-$f-linear-$dt" newmark $f run.dt=$dt 'run.refine="linear"'
    run "error-$f-iteration-$dt" friction-iteration $f run.dt=$dt
  done
  for dt in $finer; do
    run "error-$f-root-$dt" newmark $f run.dt=$dt run.t_end=0.1
    run "error-$f-linear-$dt" newmark $f run.dt=$dt run.t_end=0.1 'run.refine="linear"'
    run "error-$f-iteration-$dt" friction-iteration $f run.dt=$dt run.t_end=0.1
  done
done

echo "times" >&2
for repeat in 1 2 3; do
  for f in 0.3 1.3; do
    for dt in $steps; do
      run "time-$f-root-$dt-$repeat" newmark $f run.dt=$dt run.output_dt=0.3
      run "time-$f-iteration-$dt-$repeat" friction-iteration $f run.dt=$dt run.output_dt=0.3
    done
  done
done

echo "tables" >&2
python3 - "$out" "$steps" "$finer" <<'PYTHON'
import csv, json, math, os, sys

out, steps, finer = sys.argv[1], sys.argv[2].split(), sys.argv[3].split()
frictions = ['0.3', '1.3']
names = {'root': 'newmark', 'linear': 'newmark, linear', 'iteration': 'friction-iteration'}
columns = [n + '.' + c for n in 'ABD' for c in ('ux', 'uy')]


def table(title, head, rows):
    print('\n' + title + '\n')
    print('| ' + ' | '.join(head) + ' |')
    print('|' + '---|' * len(head))
    for row in rows:
        print('| ' + ' | '.join(str(c) for c in row) + ' |')


def rows_of(run, file):
    with open(os.path.join(out, run, file)) as f:
        return list(csv.DictReader(f))


def summary(run):
    with open(os.path.join(out, run, 'summary.json')) as f:
        return json.load(f)


def done(run):
    return summary(run)['outcome']['kind'] == 'done'


# (a)
sweep = rows_of('sweep', 'sweep.csv')
peaks = ['first.peak_t', 'first.peak_n', 'second.peak_t', 'second.peak_n']
mm = lambda x: '%.2f' % (1e3 * float(x))
table('(a) Greatest motion from the start, mm; events',
      ['f', 'first, horizontal', 'first, vertical', 'second, horizontal', 'second, vertical', 'slip', 'stick',
       'separation', 'contact', 'events'],
      [[r['contacts.*.friction']] + [mm(r[p]) for p in peaks[:3]] + ['%.3f' % (1e3 * float(r[peaks[3]]))] +
       [r[e] for e in ('slip', 'stick', 'separation', 'contact', 'events')] for r in sweep])
print()
for p in peaks:
    v = [float(r[p]) for r in sweep]
    up = [sweep[i]['contacts.*.friction'] for i in range(1, len(v)) if v[i] >= v[i - 1]]
    print(p, 'falls at every step of f' if not up else 'rises at f = ' + ', '.join(up),
          '(from %.3f to %.3f mm, %.0f %%)' % (1e3 * v[0], 1e3 * v[-1], 100 * (v[-1] / v[0] - 1)))
with open(os.path.join(out, 'sweep.dat'), 'w') as f:
    for r in sweep:
        f.write(' '.join([r['contacts.*.friction']] + [str(1e3 * float(r[p])) for p in peaks] + [r['events']]) + '\n')

# (b)
for c in ('0', '0.1', '0.3', '0.5', '1.0', '1.3'):
    h = rows_of('history-' + c, 'history.csv')
    with open(os.path.join(out, 'history-%s.dat' % c), 'w') as f:
        for r in h:
            f.write('%s %.9g %.9g\n' % (r['t'], 1e3 * (float(r['A.ux']) - float(h[0]['A.ux'])),
                                        1e3 * (float(r['A.uy']) - float(h[0]['A.uy']))))
rows = []
for c in ('0', '0.1', '0.3', '0.5', '1.0', '1.3'):
    e = [r for r in rows_of('history-' + c, 'events.csv') if r['contact'] == 'first']
    h = rows_of('history-' + c, 'history.csv')
    off = [float(r['t']) for r in e if r['event'] == 'separation']
    on = [float(r['t']) for r in e if r['event'] == 'contact']
    rows.append([c, '%.3f' % (1e3 * off[0]), '%.2f' % (1e3 * on[0]), '%.2f' % (1e3 * on[-1]),
                 '%.2f' % (1e3 * (float(h[-1]['A.ux']) - float(h[0]['A.ux'])))])
table('(b) First support, f from 0 to 1.3', ['f', 'first lift-off, ms', 'first landing, ms', 'last landing, ms',
                                           'horizontal motion left at 1.2 s, mm'], rows)

# (c)
level = {'open': 0, 'stick': 1, 'slip-': 2, 'slip+': 3}
rows, reference = [], None
for lane, engine in enumerate(('exact', 'newmark', 'friction-iteration')):
    c = [r for r in rows_of('forces-' + engine, 'contacts.csv') if r['contact'] == 'first']
    e = [r for r in rows_of('forces-' + engine, 'events.csv') if r['contact'] == 'first']
    with open(os.path.join(out, 'forces-%s.dat' % engine), 'w') as f:
        for r in c:
            f.write('%.9g %s %s %.9g\n' % (1e3 * float(r['t']), r['N'], r['T'], -1.3 * float(r['N'])))
    with open(os.path.join(out, 'states-%s.dat' % engine), 'w') as f:
        t, s = 0.0, c[0]['state']
        for r in e + [{'t': '0.4', 'to': '', 'event': ''}]:
            if r['event'] == 'time':
                continue
            f.write('%.9g %d %.9g %d\n' % (1e3 * t, 2 - lane, 1e3 * (float(r['t']) - t), level[s]))
            t, s = float(r['t']), r['to']
    e = [r for r in e if r['event'] != 'time']
    if reference is None:
        reference, order = c, e
    flights = [[float(r['t']) for r in x if r['event'] in ('separation', 'contact')] for x in (e, order)]
    apart = max(abs(a - b) for a, b in zip(*flights)) if len(flights[0]) == len(flights[1]) else None
    count = lambda k: sum(r['event'] == k for r in e)
    share = lambda s: '%.1f' % (100 * sum(r['state'] in s for r in c) / len(c))
    rows.append([engine, count('slip'), count('stick'), count('reversal'), count('separation'), count('contact'),
                 share(['open']), share(['stick']), share(['slip+', 'slip-']),
                 '-' if apart is None else '%.3f' % (1e3 * apart),
                 '%.1f' % max(-float(r['N']) for r in c), '%.1f' % max(abs(float(r['T'])) for r in c),
                 '%.1f' % max(abs(float(a['N']) - float(b['N'])) for a, b in zip(c, reference)),
                 '%.1f' % max(abs(float(a['T']) - float(b['T'])) for a, b in zip(c, reference))])
table('(c) First support, f = 1.3, to 0.4 s, dt = 1e-5',
      ['engine', 'slip', 'stick', 'reversal', 'separation', 'contact', 'open, %', 'stuck, %', 'slipping, %',
       'lift-offs and landings off by, ms',
       'greatest -N, kN', 'greatest T, kN', 'N off by, kN', 'T off by, kN'], rows)


# (d), (e)
def history(run):
    return [[float(r['t'])] + [float(r[c]) for c in columns] for r in rows_of(run, 'history.csv')]


def difference(a, b, end):
    return max(abs(x - y) for p, q in zip(a, b) if p[0] <= end for x, y in zip(p[1:], q[1:]))


early = 0.1
cost, error, errors_early, between, scale, hist = {}, {}, {}, {}, {}, {}
for f in frictions:
    ref = history('error-%s-exact' % f)
    scale[f] = max(abs(x - y) for p in ref for x, y in zip(p[1:], ref[0][1:]))
    for dt in steps:
        for k in names:
            name = 'error-%s-%s-%s' % (f, k, dt)
            if not done(name):
                continue
            hist[k] = history(name)
            error[f, k, dt] = difference(hist[k], ref, 9) / scale[f]
            errors_early[f, k, dt] = difference(hist[k], ref, early) / scale[f]
            if k != 'linear':
                runs = [summary('time-%s-%s-%s-%d' % (f, k, dt, i)) for i in (1, 2, 3)]
                cost[f, k, dt] = (min(r['wall_time'] for r in runs), runs[0]['counters']['steps'],
                                  runs[0]['counters']['solves'])
        if (f, 'root', dt) in error and (f, 'iteration', dt) in error:
            between[f, dt] = difference(hist['root'], hist['iteration'], 9) / scale[f]
    for dt in finer:
        for k in names:
            name = 'error-%s-%s-%s' % (f, k, dt)
            if done(name):
                errors_early[f, k, dt] = difference(history(name), ref, early) / scale[f]
number = lambda d, k: '%.1e' % d[k] if k in d else 'stopped'

for f in frictions:
    r = []
    for dt in steps:
        n, i = (f, 'root', dt), (f, 'iteration', dt)
        ok = n in cost and i in cost
        r.append([dt, number(error, n), number(error, i), number(between, (f, dt))] +
                 (['%.4f' % cost[n][0], '%.4f' % cost[i][0], '%.2f' % (cost[i][0] / cost[n][0]),
                   '%.2f' % (cost[n][2] / cost[n][1]), '%.2f' % (cost[i][2] / cost[i][1]),
                   '%.2f' % (cost[i][2] / cost[n][2])] if ok else [''] * 6))
    table('(d) f = %s: differences relative to %.1f mm, the greatest motion; output every 0.3 s for the times' %
          (f, 1e3 * scale[f]),
          ['dt, s', 'newmark - exact', 'iteration - exact', 'iteration - newmark', 'newmark, s', 'iteration, s',
           'ratio of times', 'solves a step, newmark', 'the same, iteration', 'ratio of solves'], r)


def time_at(f, k, goal):
    """Time from which on the error stays below goal: logarithmic between the last run above and the next."""
    s = [(error[f, k, d], cost[f, k, d][0]) for d in steps if (f, k, d) in cost]
    last = max([i for i, p in enumerate(s) if p[0] > goal], default=-1)
    if last < 0 or last + 1 == len(s):
        return None
    (e0, t0), (e1, t1) = s[last], s[last + 1]
    x = math.log(e0 / goal) / math.log(e0 / e1)
    return t0 * (t1 / t0) ** x


r = []
for f in frictions:
    for goal in (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5):
        a, b = time_at(f, 'root', goal), time_at(f, 'iteration', goal)
        if a or b:
            r.append([f, '%.0e' % goal] + ['%.4f' % x if x else '-' for x in (a, b)] +
                     ['%.2f' % (b / a) if a and b else '-'])
table('(d) Equal error: time from which on the error stays below', ['f', 'error', 'newmark, s', 'iteration, s', 'ratio'], r)

# steps with slip: share of the output times, and what one of them costs the iteration
r = []
for f in frictions:
    for dt in ('2e-5', '5e-6'):
        c = rows_of('error-%s-iteration-%s' % (f, dt), 'contacts.csv')
        slipping = {x['t'] for x in c if x['state'].startswith('slip')}
        share = len(slipping) / len({x['t'] for x in c})
        w = cost[f, 'iteration', dt]
        r.append([f, dt, '%.1f' % (100 * share), '%.2f' % (1 + (w[2] / w[1] - 1) / share)])
table('(d) Steps of the iteration in which a contact slips', ['f', 'dt, s', 'share, %', 'solves in such a step, about'], r)

for what, data, dts in (('to 1.2 s', error, steps),
                        ('to %g s, before the first support lands' % early, errors_early, steps + finer)):
    for f in frictions:
        r = []
        for i, dt in enumerate(dts):
            row = [dt]
            for k in names:
                row.append(number(data, (f, k, dt)))
                p = (f, k, dts[i - 1])
                ok = i and p in data and (f, k, dt) in data
                row.append('%.1f' % (math.log(data[p] / data[f, k, dt]) / math.log(float(dts[i - 1]) / float(dt)))
                           if ok else '')
            r.append(row)
        table('(e) f = %s, %s: greatest difference from exact, relative to %.1f mm' % (f, what, 1e3 * scale[f]),
              ['dt, s'] + [x for k in names for x in (names[k], 'order')], r)
for f in frictions:
    with open(os.path.join(out, 'error-%s.dat' % f), 'w') as g:
        for dt in steps + finer:
            g.write(' '.join([dt] + [str(d.get((f, k, dt), 'nan')) for d in (error, errors_early) for k in names] +
                             [str(cost[f, k, dt][0]) if (f, k, dt) in cost else 'nan' for k in ('root', 'iteration')]) + '\n')

# number of events against dt
r = []
for dt in steps:
    r.append([dt] + [summary('error-%s-%s-%s' % (f, k, dt))['events']['total'] - 1 for f in frictions for k in names])
r.append(['exact'] + [summary('error-%s-exact' % f)['events']['total'] - 1 for f in frictions for k in names])
table('(e) Events without the end of the pulse',
      ['dt, s'] + ['f = %s, %s' % (f, names[k]) for f in frictions for k in names], r)

print()
for f in frictions:
    e = [x for x in rows_of('error-%s-exact' % f, 'events.csv') if float(x['t']) < early and x['event'] != 'time']
    print('f = %s: %d events before %g s, of which %d landings of the second support' %
          (f, len(e), early, sum(x['event'] == 'contact' and x['contact'] == 'second' for x in e)))

# (f)
r = []
for f in frictions:
    for engine, k in (('exact', ''), ('newmark', 'root'), ('newmark, linear', 'linear'), ('friction-iteration', 'iteration')):
        for dt in (('',) if not k else ('1e-4', '5e-6')):
            s = summary('error-%s-%s' % (f, k + '-' + dt if k else 'exact'))
            r.append([f, engine, dt or '-', s['counters']['steps']] +
                     ['%.0e' % s['audit'][a]['relative'] for a in
                      ('equilibrium', 'gap', 'tension', 'product', 'friction', 'direction', 'energy')])
table('(f) Greatest violation after any step, relative to its scale',
      ['f', 'engine', 'dt, s', 'steps', 'equation of motion', 'closed with gap > 0', 'N > 0', 'N x gap',
       '\\|T\\| above its limit', 'T against the slip', 'energy balance'], r)
PYTHON

echo "pictures" >&2
cd "$out"
gnuplot <<'GNUPLOT'
note = "Reconstructed pipeline: not the paper's curves"
set grid lc rgb '#dddddd' lt 1
set tics nomirror
set border 3

set terminal pngcairo size 1000,420 font 'sans,10' noenhanced
set output '../support-motion.png'
set multiplot layout 1,2 title note font 'sans,10'
set xlabel 'friction coefficient f'
set xrange [0:1.3]
set yrange [0:]
set ylabel 'greatest horizontal motion, mm'
plot 'sweep.dat' u 1:2 w lp pt 7 ps 0.8 lc rgb '#0072b2' t 'first support', \
     '' u 1:4 w lp pt 5 ps 0.8 lc rgb '#d55e00' t 'second support'
set ylabel 'greatest vertical motion, mm'
set yrange [0.5:20]
set logscale y
set ytics (0.5, 1, 2, 5, 10, 20)
plot 'sweep.dat' u 1:3 w lp pt 7 ps 0.8 lc rgb '#0072b2' t 'first support', \
     '' u 1:5 w lp pt 5 ps 0.8 lc rgb '#d55e00' t 'second support'
unset multiplot
unset logscale
set ytics autofreq

set terminal pngcairo size 1000,640 font 'sans,10' noenhanced
set output '../histories.png'
set multiplot layout 2,1 title 'Motion of the first support from its start. '.note font 'sans,10'
set xrange [0:0.6]
set xlabel 't, s'
set yrange [*:*]
colours = "#000000 #56b4e9 #009e73 #e69f00 #d55e00 #cc79a7"
values = "0 0.1 0.3 0.5 1.0 1.3"
set ylabel 'horizontal, mm'
set key outside right top
plot for [i=1:6] 'history-'.word(values,i).'.dat' u 1:2 w l lw 1.4 lc rgb word(colours,i) t 'f = '.word(values,i)
set ylabel 'vertical, mm'
plot for [i=1:6] 'history-'.word(values,i).'.dat' u 1:3 w l lw 1.4 lc rgb word(colours,i) t 'f = '.word(values,i)
unset multiplot

set terminal pngcairo size 1100,820 font 'sans,10' noenhanced
set key inside
set output '../forces.png'
set multiplot title 'First support, f = 1.3, dt = 1e-5 s. '.note font 'sans,10'
engines = "exact newmark friction-iteration"
c3 = "#999999 #0072b2 #d55e00"
w3 = "4 1.6"
state = "open stick slip- slip+"
shade = "#e8e8e8 #4daf4a #377eb8 #e41a1c"
a = 150; b = 320
set lmargin at screen 0.12
set rmargin at screen 0.97
set xlabel ''
set xrange [a:b]
set key right top
set tmargin at screen 0.94; set bmargin at screen 0.70
set ylabel '-N, kN'
plot for [i=1:2] 'forces-'.word(engines,i).'.dat' u 1:(-$2) w l lw real(word(w3,i)) lc rgb word(c3,i) t word(engines,i), \
     'forces-friction-iteration.dat' u 1:(-$2) w l lw 1.2 dt 2 lc rgb word(c3,3) t word(engines,3)
set tmargin at screen 0.64; set bmargin at screen 0.36
set ylabel 'T, kN'
plot for [i=1:2] 'forces-'.word(engines,i).'.dat' u 1:3 w l lw real(word(w3,i)) lc rgb word(c3,i) t '', \
     'forces-friction-iteration.dat' u 1:3 w l lw 1.2 dt 2 lc rgb word(c3,3) t ''
set tmargin at screen 0.28; set bmargin at screen 0.07
set xlabel 't, ms'
set ylabel ''
set yrange [-0.5:3.2]
set ytics ('exact' 2, 'newmark' 1, 'iteration' 0)
set key horizontal top center
set style fill solid 1 noborder
plot for [k=0:3] for [e=1:3] 'states-'.word(engines,e).'.dat' \
     u ($4==k && $1<b && $1+$3>a ? ($1>a?$1:a) : NaN):2:($1>a?$1:a):($1+$3<b?$1+$3:b):($2-0.35):($2+0.35) \
     w boxxyerror lc rgb word(shade,k+1) t (e==1 ? word(state,k+1) : '')
unset multiplot
reset

set grid lc rgb '#dddddd' lt 1
set tics nomirror
set border 3
set terminal pngcairo size 1100,780 font 'sans,10' noenhanced
set output '../convergence.png'
set multiplot layout 2,2 title 'Greatest difference from exact, relative to the greatest motion. '.note font 'sans,10'
set logscale xy
set format x '%.0e'
set format y '%.0e'
n3 = 'newmark;newmark, linear;friction-iteration'
label(i) = i==1 ? 'newmark' : i==2 ? 'newmark, refine = "linear"' : 'friction-iteration'
c(i) = i==1 ? '#0072b2' : i==2 ? '#009e73' : '#d55e00'
set key right bottom
do for [f in '0.3 1.3'] {
  set xlabel 'dt, s'
  set ylabel 'f = '.f
  plot for [i=1:3] 'error-'.f.'.dat' u 1:(column(i+1)) w lp pt (i==1?7:i==2?6:5) ps (i==2?1.3:0.8) lc rgb c(i) t label(i).', to 1.2 s', \
       for [i=1:3] 'error-'.f.'.dat' u 1:(column(i+4)) w l dt 2 lw 1.5 lc rgb c(i) t label(i).', to 0.1 s', \
       [1e-7:1e-5] 1e5*x*x w l lc rgb '#888888' t 'order 2'
  set xlabel 'time of the run, s'
  set ylabel ''
  set key right top
  plot 'error-'.f.'.dat' u 8:2 w lp pt 7 ps 0.8 lc rgb c(1) t label(1), \
       '' u 9:4 w lp pt 5 ps 0.8 lc rgb c(3) t label(3)
  set key right bottom
}
unset multiplot
GNUPLOT
