"""Siconos: a linear structure on rigid contacts by the Moreau-Jean scheme, timed.

    M u'' + C u' + K u = P(t) + sum ( n p_n + t p_t ),   Signorini and Coulomb on velocities at the steps' ends
"""
import time

import numpy as np
import siconos.kernel as sk
import siconos.numerics as sn


def run(M, C, K, u0, v0, contacts, mu, restitution, force, t_end, dt, theta, samples):
    """contacts: pairs of linear forms (normal, tangent), gap = normal . u. force(t): load vector.

    Returns a dictionary: seconds of the loop, steps, u at the `samples` (multiples of dt), the percussions of
    every step by contact, the velocity of the first unknown after every step (path), the last velocity."""
    n = len(u0)
    ds = sk.LagrangianLinearTIDS(u0, v0, M, K, C)
    load = np.zeros(n)
    ds.setFExtPtr(load)
    load = ds.fExt()  # the vector that Siconos keeps
    nsds = sk.NonSmoothDynamicalSystem(0.0, t_end)
    nsds.insertDynamicalSystem(ds)
    friction = mu > 0.0
    interactions = []
    for normal, tangent in contacts:
        H = np.array([normal, tangent]) if friction else np.array([normal])
        law = (sk.NewtonImpactFrictionNSL(restitution, 0.0, mu, 2) if friction
               else sk.NewtonImpactNSL(restitution))
        interactions.append(sk.Interaction(law, sk.LagrangianLinearTIR(H)))
        nsds.link(interactions[-1], ds)
    integrator = sk.MoreauJeanOSI(theta)
    integrator.setConstraintActivationThreshold(1e-10)
    steps = round(t_end / dt)
    problem = sk.FrictionContact(2, sn.SICONOS_FRICTION_2D_NSGS) if friction else sk.LCP(sn.SICONOS_LCP_LEMKE)
    if friction:
        # Sharper tolerances change no digit that is compared, and at 1e-12 the solver runs to its last iteration.
        problem.numericsSolverOptions().dparam[sn.SICONOS_DPARAM_TOL] = 1e-8
        problem.numericsSolverOptions().iparam[sn.SICONOS_IPARAM_MAX_ITER] = 1000
    simulation = sk.TimeStepping(nsds, sk.TimeDiscretisation(0.0, dt), integrator, problem)
    simulation.setNewtonOptions(sk.SICONOS_TS_LINEAR)
    every = {round(t / dt) for t in samples}
    before = np.asarray(force(0.0))
    rows = {0: np.array(u0)}
    percussion = np.zeros((steps, len(contacts)))
    path = np.zeros((steps, 1))
    velocity = ds.velocity()
    start = time.process_time()
    for i in range(1, steps + 1):
        after = np.asarray(force(i * dt))
        load[:] = theta * after + (1.0 - theta) * before
        before = after
        simulation.computeOneStep()
        for k, interaction in enumerate(interactions):
            percussion[i - 1, k] = interaction.lambda_(1)[0]
        path[i - 1, 0] = velocity[0]
        if i in every:
            rows[i] = ds.q().copy()
        simulation.nextStep()
    seconds = time.process_time() - start
    return {'seconds': seconds, 'steps': steps, 'u': [rows[round(t / dt)] for t in samples],
            'percussion': percussion, 'path': path, 'v': ds.velocity().copy()}
