"""Segments of joint trajectories: linear, cubic or quintic, depending on the data of both ends."""

from typing import Self, TypeAlias

from msgspec import Struct

_Coefficients: TypeAlias = tuple[float, float, float, float, float, float]


class JointState(Struct, frozen=True):
    """Position of a joint, with optional velocity and acceleration."""

    position: float
    velocity: float | None = None
    acceleration: float | None = None


class JointSegment(Struct, frozen=True):
    """Polynomial from a start to an end time; at rest outside."""

    start_ns: int
    end_ns: int
    coefficients: _Coefficients
    """Coefficients of the powers of the time since the start [s]."""

    @classmethod
    def between(cls, start_ns: int, start: JointState, end_ns: int, end: JointState) -> Self:
        """Return the polynomial of lowest degree through the data given at both ends.

        Raises:
            ValueError: the end is before the start.
        """
        if end_ns < start_ns:
            raise ValueError("end_time < start_time")
        return cls(start_ns, end_ns, _coefficients(start, end, (end_ns - start_ns) / 1e9))

    def sample(self, time_ns: int) -> tuple[float, float, float]:
        """Return position, velocity and acceleration."""
        if self.start_ns <= time_ns <= self.end_ns:
            return _evaluate(self.coefficients, (time_ns - self.start_ns) / 1e9)
        nearest_ns = self.start_ns if time_ns < self.start_ns else self.end_ns
        return _evaluate(self.coefficients, (nearest_ns - self.start_ns) / 1e9)[0], 0.0, 0.0


def _coefficients(a: JointState, b: JointState, span: float) -> _Coefficients:
    distance = b.position - a.position
    if a.velocity is None or b.velocity is None:
        return (a.position, distance / span if span else 0.0, 0.0, 0.0, 0.0, 0.0)
    v0, v1 = a.velocity, b.velocity
    if a.acceleration is None or b.acceleration is None:
        if not span:
            return (a.position, v0, 0.0, 0.0, 0.0, 0.0)
        c2 = (3.0 * distance - (2.0 * v0 + v1) * span) / span**2
        c3 = (-2.0 * distance + (v0 + v1) * span) / span**3
        return (a.position, v0, c2, c3, 0.0, 0.0)
    a0, a1 = a.acceleration, b.acceleration
    if not span:
        return (a.position, v0, a0 / 2.0, 0.0, 0.0, 0.0)
    c3 = (20.0 * distance - (8.0 * v1 + 12.0 * v0) * span - (3.0 * a0 - a1) * span**2) / (2.0 * span**3)
    c4 = (-30.0 * distance + (14.0 * v1 + 16.0 * v0) * span + (3.0 * a0 - 2.0 * a1) * span**2) / (2.0 * span**4)
    c5 = (12.0 * distance - 6.0 * (v1 + v0) * span + (a1 - a0) * span**2) / (2.0 * span**5)
    return (a.position, v0, a0 / 2.0, c3, c4, c5)


def _evaluate(c: _Coefficients, t: float) -> tuple[float, float, float]:
    position = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))))
    velocity = c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))
    acceleration = 2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))
    return position, velocity, acceleration
