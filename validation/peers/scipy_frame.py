"""The pipeline, a frame on two compliant supports, by SciPy's DOP853, with events coded by hand. Prints JSON.

    scipy_frame.py SCENE rtol PROGRAM

    open: N = 0, T = 0;  stick: N = kn g, T = kt (ut - p);  slip s: N = kn g, T = -s f N
    guards: g;  -N and f |N| -+ T;  -N and s p', p' = ut' + s f (kn/kt) g'
    next state: of each contact by itself; stick after closing if kt |ut'| <= f kn |g'|, else slip
"""
import json
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

from frame import Frame

MASK = 1e-10  # s: guards count from here on after an event, where one of them is zero

path, rtol, program = sys.argv[1], float(sys.argv[2]), sys.argv[3]
frame = Frame(path, program)
run, load = frame.scene['run'], frame.scene['loads'][0]
n, contacts = len(frame.weight), frame.scene['contacts']
inverse = np.linalg.inv(frame.M)
stiffness, damping = inverse @ frame.K, frame.check['damping']['alpha']
pulse = np.zeros(n)
for component, d in enumerate(load['direction']):
    pulse[frame.dof(load['node'], component)] = load['amplitude'] * d
resting = inverse @ frame.weight
pushed = resting + inverse @ pulse
begin, end = load['history']['start'], load['history']['end']
steps = round(run['t_end'] / run['output_dt'])
samples = np.array([i * run['output_dt'] for i in range(steps)] + [run['t_end']])
watched = [i for pair in zip(frame.slides, frame.contacts) for i in pair]


class Contact:
    def __init__(self, spec, normal, tangent):
        self.kn, self.kt, self.f = (spec[k] for k in ('normal_stiffness', 'tangential_stiffness', 'friction'))
        self.normal, self.tangent, self.state, self.anchor = normal, tangent, 'stick', 0.0
        self.to_normal, self.to_tangent = inverse[:, normal], inverse[:, tangent]

    def forces(self, y):
        if self.state == 'open':
            return 0.0, 0.0
        N = self.kn * y[self.normal]
        return N, self.kt * (y[self.tangent] - self.anchor) if self.state == 'stick' else -self.state * self.f * N

    def guards(self):
        """Pairs of a guard and the state after it; None: to be decided from the velocities."""
        if self.state == 'open':
            return [(lambda t, y: y[self.normal], None)]
        apart = (lambda t, y: -self.forces(y)[0], 'open')
        if self.state == 'stick':
            return [apart] + [(lambda t, y, s=s: -self.f * self.forces(y)[0] - s * self.forces(y)[1], s)
                              for s in (1, -1)]
        s, ratio = self.state, self.state * self.f * self.kn / self.kt
        return [apart, (lambda t, y: s * (y[n + self.tangent] + ratio * y[n + self.normal]), 'stick')]

    def switch(self, to, y):
        if to is None:  # closing: T = 0, the apex of the cone
            vn, vt = y[n + self.normal], y[n + self.tangent]
            sticks = self.kt * abs(vt) <= self.f * self.kn * abs(vn)
            self.anchor, self.state = y[self.tangent], 'stick' if sticks else 1 if vt > 0 else -1
            return
        if to == 'stick':
            self.anchor = y[self.tangent] - self.forces(y)[1] / self.kt
        self.state = to


u0, _ = frame.static()
supports = [Contact(c, a, b) for c, a, b in zip(contacts, frame.contacts, frame.slides)]
for c in supports:
    c.anchor = u0[c.tangent]
y, t, events, evaluations, rows = np.r_[u0, np.zeros(n)], 0.0, [], 0, {}
start = time.process_time()
while t < run['t_end']:
    pushing = begin <= t < end
    constant = pushed if pushing else resting

    def rate(t, y):
        a = constant - stiffness @ y[:n] - damping * y[n:]
        for c in supports:
            N, T = c.forces(y)
            if N:
                a = a - N * c.to_normal - T * c.to_tangent
        return np.concatenate((y[n:], a))

    def armed(guard):
        def g(at, y, restart=t):
            return guard(at, y) if at > restart + MASK else 1.0
        g.terminal, g.direction = True, -1
        return g

    guards = [(c, g, to) for c in supports for g, to in c.guards()]
    stop = end if pushing else run['t_end']
    r = solve_ivp(rate, (t, stop), y, 'DOP853', rtol=rtol, atol=np.repeat([1e-3 * rtol, rtol], n),
                  events=[armed(g) for _, g, _ in guards], t_eval=np.r_[samples[(samples >= t) & (samples < stop)], stop])
    evaluations += r.nfev
    for at, column in zip(r.t, np.transpose(r.y)):
        rows[at] = [column[i] for i in watched]
    if r.status == 1:
        fired = [i for i, e in enumerate(r.t_events) if e.size]
        t, y = r.t_events[fired[0]][0], r.y_events[fired[0]][0]
        events.append(t)
        for i in fired:
            guards[i][0].switch(guards[i][2], y)
    else:
        t, y = stop, np.asarray(r.y)[:, -1]
seconds = time.process_time() - start
json.dump({'seconds': seconds, 'steps': evaluations // 12, 'rows': [rows[s] for s in samples], 'first': events[0],
           'changes': len(events), 'check': frame.check_against()}, sys.stdout)
