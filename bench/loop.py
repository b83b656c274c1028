"""The peer of most rows: a plain loop of `mj_step` on the same compiled model, without contact laws."""

import copy
import time
from collections.abc import Callable

import mujoco

from trundle.sim.physics.compile.law_tables import disable_laws
from trundle.sim.simulation import Simulation


def bare_loop(sim: Simulation) -> Callable[[int], None]:
    """Steps of the same bodies with the same options, from where the simulation is.

    It looks ahead at no contact, which our laws switch off, too, while everything is slow; else the loop would take up
    to twice as long.
    """
    model, data = copy.copy(sim.engine.compiled.model), sim.engine.save().data
    disable_laws(model)
    model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    return lambda steps: mujoco.mj_step(model, data, nstep=steps)


def cpu_rate(work: Callable[[int], None], steps: int) -> float:
    """[steps/s] Of this process' CPU."""
    start = time.process_time()
    work(steps)
    return steps / (time.process_time() - start)
