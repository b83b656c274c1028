"""Limits of velocity, acceleration and jerk of a command."""

import math

from msgspec import Struct


class SpeedLimit(Struct, frozen=True, kw_only=True):
    """Limits of one direction of motion; the tightest applies."""

    min_velocity: float = -math.inf
    max_velocity: float = math.inf
    """[m/s or rad/s]"""
    min_acceleration: float = -math.inf
    max_acceleration: float = math.inf
    """[m/s² or rad/s²]"""
    min_jerk: float = -math.inf
    max_jerk: float = math.inf
    """[m/s³ or rad/s³]"""

    def limit(self, requested: float, last: float, before_last: float, dt: float) -> float:
        """Return the allowed velocity nearest to the requested one; the last two velocities are dt [s] apart."""
        if math.isfinite(self.max_jerk) or math.isfinite(self.min_jerk):
            change, before = requested - last, last - before_last
            twice = 2.0 * dt * dt
            requested = last + before + min(max(change - before, self.min_jerk * twice), self.max_jerk * twice)
        requested = last + min(max(requested - last, self.min_acceleration * dt), self.max_acceleration * dt)
        return min(max(requested, self.min_velocity), self.max_velocity)
