"""Velocities at the time of the positions.

A tree's velocities in `MjData` may belong to a time half a step earlier; see `cpp/contact/midpoint.h`.
"""

from collections.abc import Generator
from contextlib import contextmanager

import mujoco
import numpy as np
from numpy.typing import NDArray

from ..compile.law_tables import velocity_times

_WRITTEN, _MIDPOINT = 0.0, 1.0


class Velocities:
    """Velocities of one `MjData`."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model = model
        self._data = data
        self._times = velocity_times(model, data)
        self._half = 0.5 * model.opt.timestep
        self._first, self._number = model.tree_dofadr.tolist(), model.tree_dofnum.tolist()

    def read(self) -> NDArray[np.float64]:
        """Return (nv,) velocities [rad/s or m/s]."""
        return midpoints_moved(self._data.qvel, self._times, self._data.qacc_warmstart, self._half)

    def read_one(self, dof: int) -> float:
        """Return the velocity of a degree of freedom [rad/s or m/s]."""
        speed: float = self._data.qvel.item(dof)
        if self._times.item(dof) == _MIDPOINT:
            speed += self._half * self._data.qacc_warmstart.item(dof)
        return speed

    def set_velocities(self, qvel: NDArray[np.float64]) -> None:
        """Set velocities (nv,)."""
        self._data.qvel[:], self._times[:] = qvel, _WRITTEN

    @contextmanager
    def shown(self) -> Generator[None]:
        """Write the velocities to the data within the context."""
        stepped = self._data.qvel.copy()
        self._data.qvel[:] = self.read()
        try:
            yield
        finally:
            self._data.qvel[:] = stepped

    def synchronize(self, dof: int) -> None:
        """Write the velocities of a degree of freedom's tree to the data, before its state is changed."""
        tree = self._model.dof_treeid[dof]
        dofs = slice(self._first[tree], self._first[tree] + self._number[tree])
        self._data.qvel[dofs] = self.read()[dofs]
        self._times[dofs] = _WRITTEN


def midpoints_moved(
    qvel: NDArray[np.float64], times: NDArray[np.float64], qacc: NDArray[np.float64], half_step_s: float
) -> NDArray[np.float64]:
    """Return velocities at the time of the positions, from the arrays (…, nv) of one `MjData` or several."""
    return np.where(times == _MIDPOINT, qvel + half_step_s * qacc, qvel)
