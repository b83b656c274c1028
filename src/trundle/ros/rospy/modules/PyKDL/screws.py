"""Twist and Wrench: pairs of vectors at a point."""

from collections.abc import Iterable

from .numbers import Numbers
from .rotation import Rotation
from .vector import Vector

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from typing import Any, Self


def _part(start: int) -> property:
    def read(self: "_Screw") -> "Part":
        return Part(self, start)

    def write(self: "_Screw", vector: Iterable[float]) -> None:
        self._values[start : start + 3] = list(vector)

    return property(read, write)


class Part(Vector):
    """View of a Vector in a Twist or Wrench: changes are written through."""

    __slots__ = ("_start", "_whole")

    def __init__(self, whole: "_Screw", start: int) -> None:
        super().__init__(*whole._values[start : start + 3])
        self._whole, self._start = whole, start

    @classmethod
    def _of(cls, values: Iterable[float]) -> "Any":
        return Vector(*values)

    def __setitem__(self, index: int, value: float) -> None:
        super().__setitem__(index, value)
        self._whole._values[self._start + index] = float(value)

    def __add__(self, other: "Any") -> "Any":
        return Vector(self) + Vector(other)

    def __sub__(self, other: "Any") -> "Any":
        return Vector(self) - Vector(other)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Vector) and Vector(self) == Vector(other)

    __hash__ = None


class _Screw(Numbers):
    __slots__ = ()
    size = 6

    def __init__(self, first: object = None, second: object = None) -> None:
        if first is None and second is None:
            self._values = [0.0] * 6
        elif isinstance(first, type(self)) and second is None:
            self._values = list(first._values)
        elif isinstance(first, Vector) and isinstance(second, Vector):
            self._values = [*first, *second]
        else:
            raise TypeError(f"{type(self).__name__} takes nothing, two Vectors or a copy, not ({first!r}, {second!r})")

    def _vectors(self) -> tuple[Vector, Vector]:
        return Vector(*self._values[:3]), Vector(*self._values[3:])

    def _rotated(self, rotation: Rotation) -> "Self":
        first, second = self._vectors()
        return type(self)(rotation * first, rotation * second)


class Twist(_Screw):
    """Velocity `vel` of a point [m/s], angular velocity `rot` [rad/s]."""

    __slots__ = ()
    vel = _part(0)
    rot = _part(3)

    def RefPoint(self, v_base_AB: Vector) -> "Twist":
        """The same motion, at a point shifted by a vector."""
        vel, rot = self._vectors()
        return Twist(vel + rot * v_base_AB, rot)

    def _moved(self, rotation: Rotation, origin: Vector) -> "Twist":
        """In a frame's parent, at the parent's origin."""
        vel, rot = self._rotated(rotation)._vectors()
        return Twist(vel + origin * rot, rot)


class Wrench(_Screw):
    """Force [N], and torque at a point [N·m]."""

    __slots__ = ()
    force = _part(0)
    torque = _part(3)

    def RefPoint(self, v_base_AB: Vector) -> "Wrench":
        """The same load, at a point shifted by a vector."""
        force, torque = self._vectors()
        return Wrench(force, torque + force * v_base_AB)

    def _moved(self, rotation: Rotation, origin: Vector) -> "Wrench":
        """In a frame's parent, at the parent's origin."""
        force, torque = self._rotated(rotation)._vectors()
        return Wrench(force, torque + origin * force)
