"""States of many worlds in the memory of this machine, stepped by a GPU."""

from typing import TYPE_CHECKING

import mujoco
import numpy as np
from numpy.typing import NDArray

from ..batch import part_of

if TYPE_CHECKING:
    from .stepper import GpuStepper

_Array = NDArray[np.float64]
_INPUTS = {
    "qpos": mujoco.mjtState.mjSTATE_QPOS,
    "qvel": mujoco.mjtState.mjSTATE_QVEL,
    "qacc_warmstart": mujoco.mjtState.mjSTATE_WARMSTART,
    "ctrl": mujoco.mjtState.mjSTATE_CTRL,
    "qfrc_applied": mujoco.mjtState.mjSTATE_QFRC_APPLIED,
    "xfrc_applied": mujoco.mjtState.mjSTATE_XFRC_APPLIED,
}


def advance(
    stepper: "GpuStepper",
    model: mujoco.MjModel,
    states: _Array,
    *,
    max_efforts: _Array,
    rates: _Array,
    count: int,
    chosen: NDArray[np.bool_],
    max_speed: float,
) -> NDArray[np.bool_]:
    """Step chosen rows; those that diverge keep their states.

    Args:
        stepper: of as many worlds as there are rows.
        model: one of the worlds.
        states: (rows, …) mjSTATE_INTEGRATION; changed in place.
        max_efforts: (rows, motors)
        rates: (rows, motors)
        count: number of steps.
        chosen: (rows,)
        max_speed: from which on a row has diverged [m/s or rad/s].

    Returns:
        (rows,) True for the stable ones of the chosen.
    """
    inputs = {name: part_of(model, states, part) for name, part in _INPUTS.items()}
    inputs["xfrc_applied"] = inputs["xfrc_applied"].reshape(len(states), -1, 6)
    after = stepper.step(count, inputs, max_efforts, rates)
    stable = chosen & np.isfinite(after["qpos"]).all(axis=1)
    stable &= (np.abs(after["qvel"]) < max_speed).all(axis=1)
    for name, values in after.items():
        part_of(model, states, _INPUTS[name])[stable] = values[stable]
    part_of(model, states, mujoco.mjtState.mjSTATE_TIME)[stable] += count * model.opt.timestep
    return stable
