#!/usr/bin/env python3
"""event_phases.py PROGRAM [N ...]: what an event costs, by phase, against the number of contacts.

    benchmarks/event_phases.py build/release/signorini 100 300 1000

A beam of N nodes (3 N unknowns) on N compliant contacts with friction under N/10 pulses, `certify = false`, `--no-plots`.
us an event: user CPU time of a whole run over its events. Shares: instructions by callgrind (valgrind), on a short run, of
functions with all that they call, over those of the loop; a phase within another one counts in both (a decision makes series and
factorisations). Floor: bytes of the factors that one solve must touch, counted as KLU keeps a banded matrix.
"""
import os
import random
import re
import resource
import subprocess
import sys
import tempfile

PHASES = [
    ("decide", [r"ContactStateSolver::decide\("]),
    ("factor", [r"SystemMatrix::set\(", r"CondensedMatrix::set\("]),
    ("series", [r"Taylor::level_any\(", r"Taylor::level_dense"]),
    ("guards", [r"ExactEngine::earliest_crossing\(", r"StepGuards::evaluate\(", r"NewmarkEngine::earliest_candidate\(", r"GuardMonitor::check\("]),
    ("works", [r"(Exact|Newmark|Ida)Engine::integrate\("]),
    ("records", [r"MotionRecord::(add|before|after)\(", r"CurveRecord::add\("]),
    ("audit", [r"Auditor::\w+\(", r"RunLawChecker::\w+\("]),
]


def beam(n, engine, t_end):
    """The text of a scene; the same for every engine."""
    r = random.Random(5)
    out = ['schema = 1', 'units = { force = "N", mass = "kg", length = "m", time = "s" }', 'gravity = [0.0, -9.81]',
           '[run]', f't_end = {t_end}', 'output_dt = 0.1', f'engine = "{engine}"', 'initial = "static"', 'certify = false']
    if engine == 'newmark':
        out.append('dt = 1e-4')
    out += ['[damping]', 'ratios = [0.02, 0.02]', 'frequencies = [1.0, 30.0]', '[sections.s]', 'EA = 2.1e9', 'EI = 2.1e7',
            'mass_per_length = 100.0', '[nodes]']
    out += [f'b{i} = [{2 * i}, 0.0]' for i in range(n)]
    names = ', '.join(f'"b{i}"' for i in range(n))
    out += ['[[members]]', f'nodes = [{names}]', 'section = "s"', 'elements = 1']
    for i in range(n):
        out.append(f'[[contacts]]\nname = "c{i}"\nnode = "b{i}"\nlaw = "compliant"\nnormal = [0.0, 1.0]\n'
                   'normal_stiffness = 1e7\ntangential_stiffness = 1e7\nfriction = 0.3')
    for i in range(0, n, 10):
        across, size, start = r.uniform(-1, 1), 2e4 * r.random(), 0.2 * r.random()
        out.append(f'[[loads]]\nnode = "b{i}"\ndirection = [{across:.4f}, 1]\namplitude = {size:.4f}\n'
                   f'history = {{ type = "half_sine", start = {start:.4f}, duration = 0.03 }}')
    return '\n'.join(out) + '\n'


def run(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def events_of(folder):
    with open(os.path.join(folder, 'events.csv')) as f:
        return sum(1 for _ in f) - 1


def shares(program, scene, folder):
    profile = os.path.join(folder, 'profile')
    run(['valgrind', '--tool=callgrind', f'--callgrind-out-file={profile}', program, 'run', scene, '--no-plots', '--quiet',
         '--force', '-o', os.path.join(folder, 'short')])
    text = subprocess.run(['callgrind_annotate', '--inclusive=yes', '--threshold=99.9', profile], capture_output=True,
                          text=True).stdout
    cost = []
    for line in text.splitlines():
        m = re.match(r'\s*([\d,]+) \(\s*[\d.]+%\)\s+\S*?:(.*)', line)
        if m:
            cost.append((int(m.group(1).replace(',', '')), m.group(2)))
    whole = next(c for c, name in cost if 'Loop::on(' in name)

    def of(patterns):
        # A function of a class that another one of the phase calls would count twice: the greatest of each pattern.
        return sum(max((c for c, name in cost if re.search(p, name)), default=0) for p in patterns)
    return {name: of(patterns) / whole for name, patterns in PHASES}


def main():
    program = sys.argv[1]
    sizes = [int(a) for a in sys.argv[2:]] or [100, 300]
    print('| contacts | engine | events | us an event | ' + ' | '.join(name for name, _ in PHASES) + ' | floor, kB |')
    print('|' + '---|' * (5 + len(PHASES)))
    for n in sizes:
        for engine in ('newmark', 'exact', 'ida'):
            with tempfile.TemporaryDirectory() as folder:
                scene, short = os.path.join(folder, 'a.toml'), os.path.join(folder, 'b.toml')
                for path, t_end in ((scene, 0.3), (short, 0.06)):
                    with open(path, 'w') as f:
                        f.write(beam(n, engine, t_end))
                seconds = run([program, 'run', scene, '--no-plots', '--quiet', '--force', '-o', os.path.join(folder, 'long')])
                events = events_of(os.path.join(folder, 'long'))
                part = shares(program, short, folder)
                floor = 12 * (2 * 6 + 1) * 3 * n / 1000  # L and U of a band of three degrees of freedom a node, 12 bytes a number
                print(f'| {n} | {engine} | {events} | {1e6 * seconds / events:.0f} | ' +
                      ' | '.join(f'{100 * part[name]:.0f} %' for name, _ in PHASES) + f' | {floor:.0f} |', flush=True)


if __name__ == '__main__':
    main()
