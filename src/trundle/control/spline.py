"""Joint trajectories: linear, cubic or quintic segments, depending on the data of each point."""

from bisect import bisect_right
from collections.abc import Sequence

from msgspec import Struct


class JointPoint(Struct, frozen=True):
    """Position of a joint at a time, with optional velocity and acceleration."""

    time_s: float
    position: float
    velocity: float | None = None
    acceleration: float | None = None


class JointSpline:
    """Trajectory through points; constant before the first and after the last."""

    def __init__(self, points: Sequence[JointPoint]) -> None:
        """Create a trajectory from at least one point, in order of time."""
        self._points = list(points)
        self._times = [point.time_s for point in self._points]

    @property
    def end_s(self) -> float:
        """Time of the last point."""
        return self._times[-1]

    def sample(self, time_s: float) -> tuple[float, float, float]:
        """Return position, velocity and acceleration."""
        number = bisect_right(self._times, time_s)
        if number == 0:
            return self._points[0].position, 0.0, 0.0
        if number == len(self._points):
            return self._points[-1].position, 0.0, 0.0
        before, after = self._points[number - 1], self._points[number]
        return _interpolate(before, after, time_s - before.time_s)


def _interpolate(a: JointPoint, b: JointPoint, t: float) -> tuple[float, float, float]:
    """Return the state on the polynomial of lowest degree through the data of both ends."""
    span = b.time_s - a.time_s
    way = b.position - a.position
    if a.velocity is None or b.velocity is None:
        return a.position + way * t / span, way / span, 0.0
    v0, v1 = a.velocity, b.velocity
    if a.acceleration is None or b.acceleration is None:
        c2 = (3.0 * way - (2.0 * v0 + v1) * span) / span**2
        c3 = (-2.0 * way + (v0 + v1) * span) / span**3
        return _polynomial((a.position, v0, c2, c3, 0.0, 0.0), t)
    a0, a1 = a.acceleration, b.acceleration
    c3 = (20.0 * way - (8.0 * v1 + 12.0 * v0) * span - (3.0 * a0 - a1) * span**2) / (2.0 * span**3)
    c4 = (-30.0 * way + (14.0 * v1 + 16.0 * v0) * span + (3.0 * a0 - 2.0 * a1) * span**2) / (2.0 * span**4)
    c5 = (12.0 * way - 6.0 * (v1 + v0) * span + (a1 - a0) * span**2) / (2.0 * span**5)
    return _polynomial((a.position, v0, a0 / 2.0, c3, c4, c5), t)


def _polynomial(c: tuple[float, float, float, float, float, float], t: float) -> tuple[float, float, float]:
    position = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))))
    velocity = c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))
    acceleration = 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))
    return position, velocity, acceleration
