"""How fast a commanded speed may be, change, and change its change."""

import math

from msgspec import Struct


class SpeedLimit(Struct, frozen=True, kw_only=True):
    """Limits of one direction of motion; the smaller limit on the way to it wins."""

    slowest: float = -math.inf
    fastest: float = math.inf
    """[m/s or rad/s]"""
    hardest_braking: float = -math.inf
    hardest: float = math.inf
    """[m/s² or rad/s²]"""
    lowest_jerk: float = -math.inf
    highest_jerk: float = math.inf
    """[m/s³ or rad/s³]"""

    def limited(self, wanted: float, last: float, before_last: float, dt: float) -> float:
        """The speed nearest to the one wanted, dt [s] after the last and twice that after the one before."""
        if math.isfinite(self.highest_jerk) or math.isfinite(self.lowest_jerk):
            change, before = wanted - last, last - before_last
            twice = 2.0 * dt * dt
            wanted = last + before + min(max(change - before, self.lowest_jerk * twice), self.highest_jerk * twice)
        wanted = last + min(max(wanted - last, self.hardest_braking * dt), self.hardest * dt)
        return min(max(wanted, self.slowest), self.fastest)
