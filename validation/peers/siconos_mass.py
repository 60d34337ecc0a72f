"""A one-mass scene of tests/cases by Siconos. Prints JSON.

    siconos_mass.py SCENE dt theta
"""
import json
import sys

import numpy as np

import moreau_jean
from scenes import Mass

scene, dt, theta = Mass(sys.argv[1]), float(sys.argv[2]), float(sys.argv[3])
r = moreau_jean.run(scene.m * np.eye(2), np.zeros((2, 2)), np.diag([scene.k, 0.0]), [scene.x0, scene.y0],
                    [scene.vx0, scene.vy0], [([0.0, 1.0], [1.0, 0.0])], scene.friction, scene.restitution,
                    scene.force, scene.t_end, dt, theta, scene.times)
rows = [list(u) for u in r['u']]
v = r['path'][:, 0]
if scene.slider:  # the first slip, or the first change of sign of the velocity: at the end of the step
    change = np.flatnonzero(np.abs(v) > 1e-9) if abs(v[0]) < 1e-9 else np.flatnonzero(v * v[0] <= 0.0)
    first, rows = (float(change[0] + 1) * dt if change.size else None), [[u[0]] for u in rows]
else:  # the first percussion after none: a landing
    hit = r['percussion'][:, 0] > 0.0
    landing = np.flatnonzero(hit[1:] & ~hit[:-1])
    first = float(landing[0] + 2) * dt if landing.size else None
    rows = rows if scene.along else [[u[1]] for u in rows]
json.dump({'seconds': r['seconds'], 'steps': r['steps'], 'rows': rows, 'first': first}, sys.stdout)
