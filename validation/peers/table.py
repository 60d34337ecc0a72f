"""Runs all programs on all shared scenes, alternating, and prints Markdown: least times, errors, events.

Times are those of the processor, user and system, so that other work on the machine does not count. The loop of
signorini is at most its wall_time, and at most the whole process: the smaller one stands.

    table.py PROGRAM repeats siconos|- scipy|- [scene]...    all scenes, or those whose names begin so

Reference: engine exact; its own error where the scene has a closed form.
"""
import csv
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
root = os.path.dirname(os.path.dirname(here))
program, repeats, have_siconos, have_scipy = sys.argv[1], int(sys.argv[2]), sys.argv[3] != '-', sys.argv[4] != '-'
only = sys.argv[5:]
python = sys.executable
long_run = 4.0  # s: runs longer than that are not repeated
kept = tempfile.TemporaryDirectory()  # gone when the script ends
work = kept.name


def timed(command):
    """Output and seconds on the processor."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return text, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def signorini(scene, columns, *options):
    """A run: seconds of the loop and of the process, rows of `columns` at `times`, log and number of events."""
    out = os.path.join(work, 'run')
    _, process = timed([program, 'run', scene, '-o', out, '--force', '--quiet', '--no-plots', '--set', 'run.certify=false', *options])
    with open(os.path.join(out, 'summary.json')) as f:
        summary = json.load(f)
    with open(os.path.join(out, 'history.csv')) as f:
        history = list(csv.DictReader(f))
    with open(os.path.join(out, 'events.csv')) as f:
        events = [e for e in csv.DictReader(f) if e['event'] != 'time']
    return {'seconds': min(summary['wall_time'], process), 'process': process, 'steps': summary['counters']['steps'],
            'times': [float(r['t']) for r in history],
            'rows': [[float(r[c]) for c in columns] for r in history], 'log': events, 'events': len(events)}


def peer(script, *arguments):
    text, process = timed([python, os.path.join(here, script), *map(str, arguments)])
    return {**json.loads(text[text.index('{"'):]), 'process': process}  # Siconos may warn on stdout


def least(candidates):
    """candidates: name -> function that runs it. Alternating repeats; least times."""
    best, slow = {}, set()
    for i in range(repeats):
        for name, run in candidates.items():
            if name in slow:
                continue
            r = run()
            if r['process'] > long_run:
                slow.add(name)
            if name in best:
                for k in ('seconds', 'process'):
                    r[k] = min(r[k], best[name][k])
            best[name] = r
    return best


def number(x):
    return '-' if x is None else '%.1e' % x


def print_table(title, best, first):
    reference = best['signorini, exact']['rows']
    scale = max(abs(a - b) for r in reference for a, b in zip(r, reference[0]))
    moved = [b - a for a, b in zip(reference[0], reference[-1])]
    print('\n## %s\n\nGreatest motion %.4g m; at the end, from the start: %s m.\n' %
          (title, scale, ', '.join('%.4g' % m for m in moved)))
    print('| program | steps | loop, s | process, s | greatest error / motion | error at the end, m | first event off by, s | events |')
    print('|---|---|---|---|---|---|---|---|')
    for name, r in best.items():
        greatest = max(abs(a - b) for p, q in zip(r['rows'], reference) for a, b in zip(p, q)) / scale
        last = max(abs(a - b) for a, b in zip(r['rows'][-1], reference[-1]))
        at = first(r['log']) if 'log' in r else r.get('first')
        off = None if at is None else abs(at - first(best['signorini, exact']['log']))
        print('| %s | %s | %.2g | %.2g | %s | %s | %s | %s |' % (
            name, r['steps'], r['seconds'], r['process'], number(greatest), number(last),
            number(off), r.get('events', r.get('changes', '-'))), flush=True)


def coulomb_decay(t):
    """Case 01a: half swings of pi/omega, each about a centre at -+ f N / k, losing 2 f N / k."""
    omega, shift, amplitude = 2.0, 0.1, 1.03
    half = math.pi / omega
    n = int(t / half)
    for i in range(n + 1):
        sign = 1.0 if i % 2 == 0 else -1.0
        if amplitude <= shift:
            return sign * amplitude
        if i == n:
            return sign * ((amplitude - shift) * math.cos(omega * (t - i * half)) + shift)
        amplitude -= 2.0 * shift


def ball(t):
    """Case 04a: parabolas of falling height, then rest."""
    g, e, v = 9.81, 0.8, math.sqrt(2.0 * 9.81)
    if t < v / g:
        return 1.0 - 0.5 * g * t * t
    t -= v / g
    while v > 1e-9:
        v *= e
        if t < 2.0 * v / g:
            return v * t - 0.5 * g * t * t
        t -= 2.0 * v / g
    return 0.0


def time_of(kind, contact=None):
    return lambda log: next(float(e['t']) for e in log
                            if e['event'] in kind and contact in (None, e['contact']))


masses = [('01a_coulomb_decay_rigid', ['d0.u'], time_of(['reversal']), ['1e-2', '1e-3', '1e-4'], coulomb_decay),
          ('03b_den_hartog_2stop', ['d0.u'], time_of(['slip']), ['1e-2', '1e-3'], None),
          ('04a_bouncing_ball', ['d0.u'], time_of(['impact']), ['1e-3', '1e-4', '1e-5'], ball),
          ('06_point_rigid_e0.5', ['d0.u', 'd1.u'], time_of(['impact']), ['1e-3', '1e-4', '1e-5'], None)]
ours = {'exact': ('--engine', 'exact'), 'ida, rtol 1e-6': ('--engine', 'ida', '--set', 'run.rtol=1e-6'),
        'ida, rtol 1e-9': ('--engine', 'ida', '--set', 'run.rtol=1e-9')}


def with_ours(scene, columns):
    return {'signorini, ' + name: lambda options=options: signorini(scene, columns, *options)
            for name, options in ours.items()}


def wanted(name):
    return not only or any(name.startswith(o) for o in only)


for case, columns, first, steps, closed_form in masses:
    if not wanted(case):
        continue
    scene = os.path.join(root, 'tests/cases', case + '.toml')
    runs = with_ours(scene, columns)
    if have_siconos:
        for theta in (0.5, 1.0):
            for dt in steps:
                runs['Siconos, theta %g, dt %s' % (theta, dt)] = (
                    lambda dt=dt, theta=theta: peer('siconos_mass.py', scene, dt, theta))
    if have_scipy and not case.startswith('06'):
        for rtol in ('1e-4', '1e-6', '1e-8', '1e-10', '1e-12'):
            runs['DOP853, rtol ' + rtol] = lambda rtol=rtol: peer('scipy_mass.py', scene, rtol)
    best = least(runs)
    print_table(case, best, first)
    if closed_form:
        exact = best['signorini, exact']
        print('\nEngine `exact` against the closed form: %.1e m.' %
              max(abs(r[0] - closed_form(t)) for t, r in zip(exact['times'], exact['rows'])), flush=True)

if wanted('rigid-frame'):
    scene = os.path.join(root, 'models/rigid-frame.toml')
    runs = with_ours(scene, ['A.ux', 'A.uy', 'B.ux', 'B.uy'])
    if have_siconos:
        for theta in (0.5, 1.0):
            for dt in ('1e-3', '1e-4', '1e-5'):
                runs['Siconos, theta %g, dt %s' % (theta, dt)] = (
                    lambda dt=dt, theta=theta: peer('siconos_frame.py', scene, dt, theta, program))
    print_table('rigid-frame', least(runs), time_of(['separation'], 'A'))

if wanted('pipeline'):
    scene = os.path.join(root, 'models/pipeline.toml')
    runs = with_ours(scene, ['A.ux', 'A.uy', 'D.ux', 'D.uy'])
    if have_scipy:
        for rtol in ('1e-4', '1e-6', '1e-8', '1e-10'):
            runs['DOP853, rtol ' + rtol] = lambda rtol=rtol: peer('scipy_frame.py', scene, rtol, program)
    print_table('pipeline', least(runs), time_of(['slip'], 'first'))
