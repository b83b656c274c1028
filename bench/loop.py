"""The peer of most rows: a plain loop of `mj_step` on the same compiled model, as a MuJoCo user would have it."""

import copy
import time
from collections.abc import Callable

import mujoco

from trundle.sim.physics.compile.law_tables import disable_laws
from trundle.sim.simulation import Simulation

_TRIED_STEPS = 20


def bare_loop(sim: Simulation) -> Callable[[int], None]:
    """Steps of the same bodies from where the simulation is, by the faster of two integrators.

    One is the model's own, the discrete one, the other implicitfast, MuJoCo's own advice. Contact laws are off, and so
    are contacts that are looked ahead at, which our laws leave out, too, while everything is slow.
    """
    integrators = mujoco.mjtIntegrator.mjINT_DISCRETE, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    rates = {integrator: cpu_rate(_loop(sim, integrator), _TRIED_STEPS) for integrator in integrators}
    return _loop(sim, max(rates, key=rates.__getitem__))


def _loop(sim: Simulation, integrator: mujoco.mjtIntegrator) -> Callable[[int], None]:
    model, data = copy.copy(sim.engine.compiled.model), sim.engine.save().data
    disable_laws(model)
    model.opt.integrator = integrator
    model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    return lambda steps: mujoco.mj_step(model, data, nstep=steps)


def cpu_rate(work: Callable[[int], None], steps: int) -> float:
    """[steps/s] Of this process' CPU."""
    start = time.process_time()
    work(steps)
    return steps / (time.process_time() - start)
