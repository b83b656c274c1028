"""Trajectories: states with times, velocities and accelerations."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray


class Trajectory(Struct, frozen=True, kw_only=True, eq=False):
    """States over time; all arrays have a row for each."""

    times: NDArray[np.float64]
    """(N,) from the start, rising [s]."""
    positions: NDArray[np.float64]
    """(N, n) [rad, m]."""
    velocities: NDArray[np.float64]
    """(N, n)"""
    accelerations: NDArray[np.float64]
    """(N, n)"""

    @property
    def duration(self) -> float:
        """Time of the last state [s]."""
        return float(self.times[-1]) if len(self.times) else 0.0
