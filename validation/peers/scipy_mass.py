"""A one-mass scene of tests/cases by SciPy's DOP853, with events coded by hand for each mode. Prints JSON.

    scipy_mass.py SCENE rtol

    slider: stick, slip+, slip-;  m x'' = P(t) - k x - s f N,  ends at x' = 0, stick at |P - k x| = f N
    ball:   flight, rest;         y'' = P / m,                 ends at y = 0, then y' := -e y'

    A guard that starts at zero counts from the first instant after its start; steps are held to half a radian of
    the load, since a block at rest gives the step control nothing to see and a whole cycle would be passed over.
"""
import json
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

from scenes import Mass

scene, rtol = Mass(sys.argv[1]), float(sys.argv[2])
start = time.process_time()
rows, events, evaluations, t = {}, [], 0, 0.0
samples = np.array(scene.times)
longest = min([0.5 / load[2] for load in scene.loads if load[2]], default=np.inf)


def advance(f, guards, y):
    """To the first guard that falls, from above; keeps the samples on the way."""
    global t, evaluations

    def armed(guard):
        def g(at, y, begin=t):
            return guard(at, y) if at > begin else 1.0
        g.terminal, g.direction = True, -1
        return g

    r = solve_ivp(f, (t, scene.t_end), y, 'DOP853', rtol=rtol, atol=rtol, events=[armed(g) for g in guards],
                  t_eval=samples[samples >= t], max_step=longest)
    evaluations += r.nfev
    for at, column in zip(r.t, np.transpose(r.y)):
        rows.setdefault(at, [column[0]])
    if r.status != 1:
        t = scene.t_end
        return r.y[:, -1], None
    fired = next(i for i, e in enumerate(r.t_events) if e.size)
    t = r.t_events[fired][0]
    events.append(t)
    return r.y_events[fired][0], fired


if scene.slider:
    limit = scene.friction * -scene.force(0.0)[1]
    state, y = 0, [scene.x0, scene.vx0]

    def required(t, y):
        return scene.force(t)[0] - scene.k * y[0]

    def slide(y, old):
        """After v = 0: stick, or on to where the spring and the load pull."""
        r = required(t, y)
        return 0 if abs(r) <= limit else 1 if r > 0 else -1

    state = slide(y, 0)
    while t < scene.t_end:
        if state == 0:
            y, fired = advance(lambda t, y: [0.0, 0.0], [lambda t, y: limit - required(t, y),
                                                        lambda t, y: limit + required(t, y)], y)
            state = {0: 1, 1: -1, None: 0}[fired]
        else:
            s = state
            y, fired = advance(lambda t, y: [y[1], (required(t, y) - s * limit) / scene.m],
                               [lambda t, y: s * y[1]], y)
            y[1] = 0.0
            state = slide(y, s)
else:
    y, weight = [scene.y0, scene.vy0], scene.force(0.0)[1]
    while t < scene.t_end:
        y, fired = advance(lambda t, y: [y[1], weight / scene.m], [lambda t, y: y[0]], y)
        y = [0.0, -scene.restitution * y[1]]
        if y[1] < scene.capture:
            break
    for at in samples[samples >= t]:
        rows.setdefault(at, [0.0])
seconds = time.process_time() - start
json.dump({'seconds': seconds, 'steps': evaluations // 12, 'rows': [rows[s] for s in samples],
           'first': events[0] if events else None, 'events': len(events)}, sys.stdout)
