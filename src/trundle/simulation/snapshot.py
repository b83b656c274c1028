"""Where everything is at one instant."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Snapshot:
    """The state of a world at one instant; links and joints are in file order, over all models."""

    time_ns: int
    poses: NDArray[np.float64]
    """(links, 7) link frames in the world: x y z [m], qw qx qy qz."""
    twists: NDArray[np.float64]
    """(links, 6) velocity of the link frame's origin [m/s], angular velocity [rad/s]; world axes."""
    joint_positions: NDArray[np.float64]
    """(joints,) [rad or m]; 0 for joints without one axis of freedom."""
    joint_velocities: NDArray[np.float64]
    """(joints,) [rad/s or m/s]"""
    joint_efforts: NDArray[np.float64]
    """(joints,) what drives them [N·m or N]"""
