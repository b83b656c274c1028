"""States of many worlds in the memory of this machine, stepped by a GPU."""

from enum import IntEnum
from typing import TYPE_CHECKING

import mujoco
import numpy as np
from numpy.typing import NDArray

from ..batch import part_of, velocities_of

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


class StepResult(IntEnum):
    """Result of the steps of a world."""

    STABLE = 0
    UNSTABLE = 1
    """Divergence; the world keeps its state."""
    CROWDED = 2
    """More contacts than the GPU has room for; the world keeps its state."""


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
) -> NDArray[np.int8]:
    """Step chosen rows; unstable and crowded ones keep their states.

    Args:
        stepper: stepper of as many worlds as rows.
        model: one of the worlds.
        states: (rows, …) mjSTATE_INTEGRATION; changed in place.
        max_efforts: (rows, motors)
        rates: (rows, motors)
        count: number of steps.
        chosen: (rows,)
        max_speed: speed from which on a row has diverged [m/s or rad/s].

    Returns:
        (rows,) `StepResult`s; undefined for rows that were not chosen.
    """
    inputs = {name: part_of(model, states, part) for name, part in _INPUTS.items()}
    inputs["qvel"] = velocities_of(model, states)
    inputs["xfrc_applied"] = inputs["xfrc_applied"].reshape(len(states), -1, 6)
    laws = part_of(model, states, mujoco.mjtState.mjSTATE_USERDATA)  # see law_tables.h
    targets = laws[:, : model.nu].copy()
    after, crowded = stepper.step(count, inputs, max_efforts, rates, targets)
    slow = (np.abs(after["qvel"]) < max_speed).all(axis=1)
    results = np.where(np.isfinite(after["qpos"]).all(axis=1) & slow, StepResult.STABLE, StepResult.UNSTABLE)
    results[crowded] = StepResult.CROWDED
    stable = chosen & (results == StepResult.STABLE)
    rows = slice(None) if stable.all() else stable  # a mask copies each array once more
    for name, values in after.items():
        part_of(model, states, _INPUTS[name])[rows] = values[rows]
    laws[rows, : model.nu], laws[rows, model.nu : model.nu + model.nv] = targets[rows], 0.0
    part_of(model, states, mujoco.mjtState.mjSTATE_TIME)[rows] += count * model.opt.timestep
    return results.astype(np.int8)
