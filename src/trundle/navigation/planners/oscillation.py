"""base_local_planner's OscillationCostFunction: forbids motion to and fro."""

import math

import numpy as np
from numpy.typing import NDArray

from .interfaces import Pose2D

_Velocity = tuple[float, float, float]


class OscillationFlags:
    """Forbids to reverse a change of direction until the robot has moved on."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Allow everything."""
        self._last = [0.0, 0.0, 0.0]
        """Sign of the last motion along each axis."""
        self._forbidden = [0.0, 0.0, 0.0]
        """Sign of motion that is forbidden along each axis; 0: none."""
        self._since: Pose2D | None = None

    def allowed(self, samples: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the samples (n, 3) that are not forbidden."""
        is_allowed = np.ones(len(samples), dtype=bool)
        for axis, sign in enumerate(self._forbidden):
            if sign:
                is_allowed &= samples[:, axis] * sign <= 0.0
        return np.ascontiguousarray(samples[is_allowed])

    def note(self, pose: Pose2D, velocity: _Velocity, distance_m: float, angle: float) -> None:
        """Note a command; sideways motion and turns count only if the robot does not drive forwards."""
        if self._since is not None and (
            math.hypot(pose.x - self._since.x, pose.y - self._since.y) > distance_m
            or abs(math.remainder(pose.yaw - self._since.yaw, 2.0 * math.pi)) > angle
        ):
            self.reset()
        counts = (True, abs(velocity[0]) <= 1e-6, abs(velocity[0]) <= 1e-6)
        for axis, (value, is_counted) in enumerate(zip(velocity, counts, strict=True)):
            sign = (value > 0.0) - (value < 0.0)
            if not sign or not is_counted:
                continue
            if self._last[axis] * sign < 0.0:
                self._forbidden[axis] = -float(sign)
                self._since = pose
            self._last[axis] = float(sign)
