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

    def limit(self, wanted: float, last: float, before_last: float, dt: float) -> float:
        """Return the allowed velocity nearest to the wanted one, from the last two, each dt [s] apart."""
        if math.isfinite(self.max_jerk) or math.isfinite(self.min_jerk):
            change, before = wanted - last, last - before_last
            twice = 2.0 * dt * dt
            wanted = last + before + min(max(change - before, self.min_jerk * twice), self.max_jerk * twice)
        wanted = last + min(max(wanted - last, self.min_acceleration * dt), self.max_acceleration * dt)
        return min(max(wanted, self.min_velocity), self.max_velocity)
