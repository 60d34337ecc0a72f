"""The one-mass scenes of tests/cases that peers compute too: mass, spring, loads, contact.

Read from the scene files, so that no number stands twice. Unknowns x along the contact and y away from it; a
scene with a slider becomes a mass pressed on the ground by its normal_force.
"""
import math
import tomllib


class Mass:
    def __init__(self, path):
        with open(path, 'rb') as f:
            scene = tomllib.load(f)
        run, matrices, contact = scene['run'], scene['matrices'], scene['contacts'][0]
        self.times, self.t_end = run['output_times'], run['t_end']
        self.friction, self.restitution = contact.get('friction', 0.0), contact.get('restitution', 0.0)
        self.k = matrices['stiffness'][0][0]
        self.m = matrices['mass'][0][0]
        self.capture = contact.get('capture_velocity', 0.0)
        self.slider = contact['law'] == 'slider'
        dofs = matrices['dofs']
        self.along = along = 'd0' if self.slider or len(dofs) == 2 else None
        initial = dict(zip(dofs, zip(run['initial']['u'], run['initial']['v'])))
        self.x0, self.vx0 = initial[along] if along else (0.0, 0.0)
        away = None if self.slider else dofs[-1]
        self.y0, self.vy0 = initial[away] if away else (0.0, 0.0)
        self.loads = []  # (0 along or 1 away, amplitude, omega or 0 for constant, end)
        if self.slider:
            self.loads.append((1, -contact['normal_force'], 0.0, math.inf))
        for load in scene.get('loads', []):
            (dof, factor), = load['direction'].items()
            h = load['history']
            self.loads.append((0 if dof == along else 1, factor * load['amplitude'], h.get('omega', 0.0),
                               h.get('end', math.inf)))

    def force(self, t):
        """Load along and away; of a load that ends, the value just before at its end."""
        f = [0.0, 0.0]
        for axis, amplitude, omega, end in self.loads:
            if t <= end:
                f[axis] += amplitude * (math.sin(omega * t) if omega else 1.0)
        return f
