"""The rigid Z-shaped frame by Siconos. Prints JSON.

    siconos_frame.py SCENE dt theta PROGRAM
"""
import json
import math
import sys

import numpy as np

import moreau_jean
from frame import Frame

path, dt, theta, program = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
frame = Frame(path, program)
run, load, contact = frame.scene['run'], frame.scene['loads'][0], frame.scene['contacts'][0]
n = len(frame.weight)
pulse = np.zeros(n)
for component, d in enumerate(load['direction']):
    pulse[frame.dof(load['node'], component)] = load['amplitude'] * d
duration = load['history']['duration']
unit = np.eye(n)
steps = round(run['t_end'] / run['output_dt'])
u0, _ = frame.static()
r = moreau_jean.run(
    frame.M, frame.C, frame.K, u0, np.zeros(n), [(unit[a], unit[b]) for a, b in zip(frame.contacts, frame.slides)],
    contact['friction'], contact['restitution'],
    lambda t: frame.weight + (math.sin(math.pi * t / duration) if t < duration else 0.0) * pulse,
    run['t_end'], dt, theta, [i * run['output_dt'] for i in range(steps + 1)])
watched = [i for pair in zip(frame.slides, frame.contacts) for i in pair]
off = np.flatnonzero(r['percussion'][:, 0] <= 0.0)
flights = np.diff((r['percussion'] > 0.0).astype(int), axis=0)
json.dump({'seconds': r['seconds'], 'steps': r['steps'], 'rows': [list(u[watched]) for u in r['u']],
           'first': float((off[0] + 0.5) * dt) if off.size else None,
           'changes': int(np.count_nonzero(flights)), 'last': float((np.flatnonzero(flights.any(axis=1))[-1] + 1.5) * dt),
           'check': frame.check_against(), 'v': float(np.abs(r['v']).max())}, sys.stdout)
