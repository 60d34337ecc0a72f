"""Plane frames of Euler-Bernoulli beams from a scene file, dense.

    axial   EA/L [1 -1; -1 1],         m L/6 [2 1; 1 2]
    bending EI/L^3 [12 6L -12 6L; ..], m L/420 [156 22L 54 -13L; ..]      in u_y, r_z of both ends

Members, one section each, pinned supports; no springs. Order of unknowns: ux, uy, rz node by node along the
members, without what is fixed. check_against() compares frequencies with those that `signorini check` prints.
"""
import json
import subprocess
import tomllib

import numpy as np


def beam(EA, EI, m, x1, y1, x2, y2):
    """Stiffness and consistent mass of a beam, 6 x 6, in global directions."""
    L = np.hypot(x2 - x1, y2 - y1)
    c, s = (x2 - x1) / L, (y2 - y1) / L
    k, a = np.zeros((6, 6)), np.zeros((6, 6))
    axial, bend = [0, 3], [1, 2, 4, 5]
    k[np.ix_(axial, axial)] = EA / L * np.array([[1, -1], [-1, 1]])
    a[np.ix_(axial, axial)] = m * L / 6 * np.array([[2, 1], [1, 2]])
    k[np.ix_(bend, bend)] = EI / L**3 * np.array(
        [[12, 6 * L, -12, 6 * L], [6 * L, 4 * L * L, -6 * L, 2 * L * L],
         [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L * L, -6 * L, 4 * L * L]])
    a[np.ix_(bend, bend)] = m * L / 420 * np.array(
        [[156, 22 * L, 54, -13 * L], [22 * L, 4 * L * L, 13 * L, -3 * L * L],
         [54, 13 * L, 156, -22 * L], [-13 * L, -3 * L * L, -22 * L, 4 * L * L]])
    r = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    R = np.kron(np.eye(2), r)
    return R.T @ k @ R, R.T @ a @ R


class Frame:
    """M, C, K, gravity load and the numbers of named nodes' unknowns, of a scene file."""

    def __init__(self, path, program):
        with open(path, 'rb') as f:
            self.scene = tomllib.load(f)
        self.check = json.loads(subprocess.run([program, 'check', '--json', path], check=True,
                                               capture_output=True, text=True).stdout)
        nodes, points, elements, self.at = self.scene['nodes'], [], [], {}

        def number(name):
            if name not in self.at:
                self.at[name] = len(points)
                points.append(nodes[name])
            return self.at[name]

        for member in self.scene['members']:
            names, counts = member['nodes'], member['elements']
            section = self.scene['sections'][member['section']]
            for a, b, n in zip(names, names[1:], counts):
                last = number(a)
                for i in range(1, n + 1):
                    if i < n:
                        points.append([p + (q - p) * i / n for p, q in zip(nodes[a], nodes[b])])
                        here = len(points) - 1
                    else:
                        here = number(b)
                    elements.append((last, here, section))
                    last = here
        size = 3 * len(points)
        M, K = np.zeros((size, size)), np.zeros((size, size))
        for a, b, s in elements:
            k, m = beam(s['EA'], s['EI'], s['mass_per_length'], *points[a], *points[b])
            d = np.r_[3 * a:3 * a + 3, 3 * b:3 * b + 3]
            K[np.ix_(d, d)] += k
            M[np.ix_(d, d)] += m
        weight = M @ np.tile([*self.scene['gravity'], 0.0], len(points))
        fixed = {3 * self.at[s['node']] + ['ux', 'uy', 'rz'].index(c)
                 for s in self.scene.get('supports', []) for c in s['fix']}
        free = [i for i in range(size) if i not in fixed]
        self.M, self.K, self.weight = M[np.ix_(free, free)], K[np.ix_(free, free)], weight[free]
        self.C = self.check['damping']['alpha'] * self.M
        self.number = {i: j for j, i in enumerate(free)}
        self.contacts = [self.dof(c['node'], 1) for c in self.scene['contacts']]
        self.slides = [self.dof(c['node'], 0) for c in self.scene['contacts']]

    def dof(self, node, component):
        return self.number[3 * self.at[node] + component]

    def static(self):
        """Equilibrium under gravity, supports closed and without friction; and the reactions, >= 0.

        A horizontal motion that nothing holds is fixed at the first contact."""
        n, held = len(self.weight), []
        stiffness = [c.get('normal_stiffness') for c in self.scene['contacts']]
        K = self.K.copy()
        for dof, kn in zip(self.contacts, stiffness):
            if kn:
                K[dof, dof] += kn
            else:
                held.append(dof)
        if not self.scene.get('supports'):
            held.append(self.slides[0])
        free = [i for i in range(n) if i not in held]
        u = np.zeros(n)
        u[free] = np.linalg.solve(K[np.ix_(free, free)], self.weight[free])
        return u, (self.K @ u - self.weight)[self.contacts]

    def check_against(self):
        """Greatest relative difference from the program: open frequencies and static reactions."""
        w = np.sqrt(np.maximum(np.linalg.eigvals(np.linalg.solve(self.M, self.K)).real, 0.0))
        w = np.sort(w[w > 1.0])
        theirs = [m['omega'] for m in self.check['frequencies']['open']['modes']]
        theirs = [x for x in theirs if x > 1.0]
        _, reactions = self.static()
        return max(max(abs(a / b - 1) for a, b in zip(w, theirs)),
                   max(abs(r / -c['N'] - 1) for r, c in zip(reactions, self.check['contacts'])))
