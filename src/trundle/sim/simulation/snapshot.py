"""Snapshots of a world's state."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.sim.physics import EngineSnapshot

_Array = NDArray[np.float64]


class Snapshot:
    """Immutable state of a world at one instant, for any thread; links and joints in file order, over all models.

    `joint_positions`, `joint_velocities` and `joint_efforts` hold each joint's first axis; `axes_of` returns all.
    """

    __module__ = "trundle"

    def __init__(
        self, *, time_ns: int, instant: EngineSnapshot, first_axes: NDArray[np.intp], joint_axes: Sequence[range] = ()
    ) -> None:
        """Wrap an engine snapshot.

        Args:
            time_ns: simulation time.
            instant: the engine's state.
            first_axes: first axis of each joint, −1 if it has none.
            joint_axes: all axes of each joint.
        """
        self.time_ns = time_ns
        self.engine = instant
        self._axes = first_axes
        self._joint_axes = joint_axes

    @property
    def poses(self) -> _Array:
        """(links, 7) poses of the link frames in the world: x y z [m], qw qx qy qz."""
        return self.engine.poses

    @property
    def twists(self) -> _Array:
        """(links, 6) velocity of the link frame's origin [m/s] and angular velocity [rad/s], world axes."""
        return self.engine.twists

    @property
    def joint_positions(self) -> _Array:
        """(joints,) positions [rad or m]; 0 for rigid joints."""
        return self._of_joints(self.engine.axis_positions)

    @property
    def joint_velocities(self) -> _Array:
        """(joints,) velocities [rad/s or m/s]."""
        return self._of_joints(self.engine.axis_velocities)

    @property
    def joint_efforts(self) -> _Array:
        """(joints,) efforts [N·m or N]."""
        return self._of_joints(self.engine.axis_efforts)

    def axes_of(self, joint: int) -> tuple[list[float], list[float], list[float]]:
        """Return position, velocity and effort of each axis of a joint."""
        axes = slice(self._joint_axes[joint].start, self._joint_axes[joint].stop)
        engine = self.engine
        return (
            engine.axis_positions[axes].tolist(),
            engine.axis_velocities[axes].tolist(),
            engine.axis_efforts[axes].tolist(),
        )

    def _of_joints(self, values: _Array) -> _Array:
        result, moves = np.zeros(len(self._axes)), self._axes >= 0
        result[moves] = values[self._axes[moves]]
        return result
