#!/bin/bash
# The pipeline on rigid supports, as the paper has them, beside the compliant ones; ida beside the other engines; what
# refining the time of an event costs. Prints Markdown tables.
#
#   validation/paper/rigid.sh [PROGRAM] > tables.md      PROGRAM: default build/release/signorini
#
# Needs bash and python3 (standard library only). Results go to validation/paper/out-rigid, which is removed first. One run
# at a time; times are processor time, so that a busy machine does little to them. Some two minutes.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(realpath "${1:-$root/build/release/signorini}")
cd "$root"
rm -rf validation/paper/out-rigid
python3 - "$program" <<'PYTHON'
import csv, json, os, resource, subprocess, sys

program, out = sys.argv[1], 'validation/paper/out-rigid'
scenes = {'compliant': 'models/pipeline.toml', 'rigid': 'validation/contact-stiffness/pipeline-rigid.toml'}
steps = ['1e-4', '1e-5', '1e-6']
columns = [n + '.' + c for n in 'ABD' for c in ('ux', 'uy')]


def rows_of(folder, file):
    with open(os.path.join(folder, file)) as f:
        return list(csv.DictReader(f))


class Run:
    """One run: rows, events without the load's, counters, processor seconds."""

    def __init__(self, supports, f, name, engine, *sets, certify='false'):
        folder = os.path.join(out, '%s-%s-%s%s' % (supports, f, name, ', certified' if certify == 'true' else ''))
        changes = [s for key in ('contacts.*.friction=' + f, 'run.certify=' + certify) + sets for s in ('--set', key)]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([program, 'run', scenes[supports], '-o', folder, '--engine', engine, '--quiet', '--no-plots']
                              + changes, stderr=subprocess.PIPE, text=True)
        self.seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if done.returncode not in (0, 4):
            sys.exit('%s: exit code %d\n%s' % (folder, done.returncode, done.stderr))
        with open(os.path.join(folder, 'summary.json')) as s:
            summary = json.load(s)
        self.done, self.counters, self.audit = done.returncode == 0, summary['counters'], summary['audit']
        self.certified = summary['certified']
        self.name = name
        self.history = [[float(r['t'])] + [float(r[c]) for c in columns] for r in rows_of(folder, 'history.csv')]
        self.events = [r for r in rows_of(folder, 'events.csv') if r['event'] != 'time']

    def off(self, exact, end):
        """Greatest difference of displacements, relative to the greatest motion of the run."""
        scale = max(abs(x - y) for p in exact.history for x, y in zip(p[1:], exact.history[0][1:]))
        return max(abs(x - y) for p, q in zip(self.history, exact.history) if p[0] <= end
                   for x, y in zip(p[1:], q[1:])) / scale

    def agrees(self, exact):
        """How many events come as in `exact`, the greatest difference of their times, and when it parts from it.
        Rows of one instant are taken as a set."""
        def key(e):
            return e['contact'], e['from'], e['to']

        n, late, i = 0, 0.0, 0
        while i < min(len(self.events), len(exact.events)):
            j = i + 1
            while j < len(exact.events) and exact.events[j]['t'] == exact.events[i]['t']:
                j += 1
            if sorted(map(key, self.events[i:j])) != sorted(map(key, exact.events[i:j])):
                break
            apart = max(abs(float(a['t']) - float(b['t'])) for a, b in zip(self.events[i:j], exact.events[i:j]))
            if apart > 1e-3:  # the same kinds by chance
                break
            late, n, i = max(late, apart), j, j
        until = '' if n == len(exact.events) == len(self.events) else '%.4f' % float(exact.events[n]['t']) \
            if n < len(exact.events) else 'its end'
        return n, late, until


def table(title, head, rows):
    print('\n' + title + '\n\n| ' + ' | '.join(head) + ' |\n|' + '---|' * len(head))
    for row in rows:
        print('| ' + ' | '.join(str(c) for c in row) + ' |')


runs = {}
for supports in scenes:
    for f in ('0.3', '1.3'):
        print(supports, f, file=sys.stderr)
        all_of = [Run(supports, f, 'exact', 'exact')]
        all_of += [Run(supports, f, 'ida, ' + r, 'ida', 'run.rtol=' + r) for r in ('1e-6', '1e-8', '1e-10')]
        all_of += [Run(supports, f, 'newmark, ' + dt, 'newmark', 'run.dt=' + dt) for dt in steps]
        all_of += [Run(supports, f, 'newmark, linear, ' + dt, 'newmark', 'run.dt=' + dt, 'run.refine="linear"')
                   for dt in steps]
        if supports == 'compliant':  # the iteration needs contact elements
            all_of += [Run(supports, f, 'friction-iteration, ' + dt, 'friction-iteration', 'run.dt=' + dt) for dt in steps]
        runs[supports, f] = all_of

for supports in scenes:
    for f in ('0.3', '1.3'):
        exact, rows = runs[supports, f][0], []
        for r in runs[supports, f]:
            if 'linear' in r.name:
                continue
            n, late, until = r.agrees(exact)
            rows.append([r.name, len(r.events)] + (['', '', '', '', ''] if r is exact else
                        [n, until, '%.0e' % late, '%.1e' % r.off(exact, 0.15), '%.1e' % r.off(exact, 9)]) +
                        ['%.0e' % r.audit['energy']['relative'], r.counters['steps'], r.counters['solves'],
                         '%.2f' % r.seconds])
        table('%s supports, f = %s:' % (supports.capitalize(), f),
              ['engine, rtol or dt in s', 'events', 'as in exact', 'until, s', 'off in time by, s', 'displacements to 0.15 s',
               'to 1.2 s', 'energy balance', 'steps', 'solves', 'processor, s'], rows)

# Certified horizons: IDA beside the exact flow, newmark beside half its step, exact beside itself, disturbed.
rows = []
for supports in scenes:
    for f in ('0.3', '1.3'):
        for name, engine, companion, sets in (
                [('exact', 'exact', 'finer', [])] +
                [('ida, ' + r, 'ida', 'exact', ['run.rtol=' + r]) for r in ('1e-6', '1e-8', '1e-10')] +
                [('newmark, ' + dt, 'newmark', 'finer', ['run.dt=' + dt]) for dt in steps]):
            r = Run(supports, f, name, engine, 'run.companion=' + companion, *sets, certify='true')
            c = r.certified
            rows.append([supports, f, name, c['companion'], '%.4f' % c['until'], c['events'],
                         sum(1 for e in r.events), c['reason'].split(',')[0] or 'to the end'])
table('Until when the sequence of events is certain:',
      ['supports', 'f', 'engine', 'companion', 'certain until, s', 'rows of events certain', 'events', 'why no further'], rows)

rows = []
for supports in scenes:
    for f in ('0.3', '1.3'):
        named = {r.name: r for r in runs[supports, f]}
        for dt in steps:
            root, linear = named['newmark, ' + dt], named['newmark, linear, ' + dt]
            rows.append([supports, f, dt, len(root.events), linear.counters['solves'], root.counters['solves'],
                         '%.1f %%' % (100 * (root.counters['solves'] / linear.counters['solves'] - 1)),
                         '%.1f %%' % (100 * (root.counters['solves'] / (1.2 / float(dt)) - 1)),
                         '%.0e' % linear.audit['energy']['relative'], '%.0e' % root.audit['energy']['relative']])
table('Refining the time of an event until its guard is zero ("root") beside interpolating it once ("linear"):',
      ['supports', 'f', 'dt, s', 'events', 'solves, linear', 'solves, root', 'root costs more', 'all that events cost',
       'energy balance, linear', 'root'], rows)
PYTHON
