"""Peer of most rows: a plain loop of `mj_step` on the same compiled model, without contact laws."""

import copy
import time
from collections.abc import Callable

import mujoco

from trundle.sim.physics.compile.law_tables import disable_laws
from trundle.sim.simulation import Simulation

_TRIAL_STEPS = 20


def bare_loop(sim: Simulation) -> Callable[[int], None]:
    """Return a function that steps the same bodies from the simulation's state, with the faster of two integrators.

    One is the model's own, the discrete integrator, the other implicitfast, which MuJoCo recommends. Speculative
    contacts are disabled, as in Trundle while all bodies are slow; otherwise the loop would take up to twice as long.
    """
    integrators = mujoco.mjtIntegrator.mjINT_DISCRETE, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    rates = {integrator: cpu_rate(_loop(sim, integrator), _TRIAL_STEPS) for integrator in integrators}
    return _loop(sim, max(rates, key=rates.__getitem__))


def _loop(sim: Simulation, integrator: mujoco.mjtIntegrator) -> Callable[[int], None]:
    model, data = copy.copy(sim.engine.compiled.model), sim.engine.save().data
    disable_laws(model)
    model.opt.integrator = integrator
    model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    return lambda steps: mujoco.mj_step(model, data, nstep=steps)


def cpu_rate(work: Callable[[int], None], steps: int) -> float:
    """Return steps per second of this process' CPU time."""
    start = time.process_time()
    work(steps)
    return steps / (time.process_time() - start)
