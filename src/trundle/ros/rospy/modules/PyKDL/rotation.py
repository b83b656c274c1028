"""Rotation as a 3×3 matrix. Formulas for angles: John J. Craig, Introduction to Robotics, 1989."""

import math

from .numbers import EPSILON, text
from .vector import Vector

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from typing import Any

_TINY = 1e-12
"""Tolerance of a singularity of Euler angles."""


class Rotation:
    """Matrix of nine numbers, row by row."""

    __slots__ = ("_values",)
    __hash__ = None  # pyright: ignore[reportAssignmentType]

    def __init__(self, *values: "Any") -> None:
        """The identity, nine numbers (row by row), three axes (the columns), or a copy."""
        if not values:
            self._values = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
        elif len(values) == 9:
            self._values = [float(value) for value in values]
        elif len(values) == 3 and all(isinstance(value, Vector) for value in values):
            self._values = [column[row] for row in range(3) for column in values]
        elif len(values) == 1 and isinstance(values[0], Rotation):
            self._values = list(values[0]._values)
        else:
            raise TypeError(f"Rotation takes nothing, nine numbers, three Vectors or a Rotation, not {values!r}")

    @staticmethod
    def Identity() -> "Rotation":
        """No rotation."""
        return Rotation()

    @staticmethod
    def RotX(angle: float) -> "Rotation":
        """About x."""
        s, c = math.sin(angle), math.cos(angle)
        return Rotation(1, 0, 0, 0, c, -s, 0, s, c)

    @staticmethod
    def RotY(angle: float) -> "Rotation":
        """About y."""
        s, c = math.sin(angle), math.cos(angle)
        return Rotation(c, 0, s, 0, 1, 0, -s, 0, c)

    @staticmethod
    def RotZ(angle: float) -> "Rotation":
        """About z."""
        s, c = math.sin(angle), math.cos(angle)
        return Rotation(c, -s, 0, s, c, 0, 0, 0, 1)

    @staticmethod
    def Rot(axis: Vector, angle: float) -> "Rotation":
        """About an axis of any length."""
        unit = Vector(axis)
        unit.Normalize()
        return Rotation.Rot2(unit, angle)

    @staticmethod
    def Rot2(axis: Vector, angle: float) -> "Rotation":
        """About an axis of length 1."""
        x, y, z = axis
        s, c = math.sin(angle), math.cos(angle)
        v = 1.0 - c
        return Rotation(
            c + v * x * x, v * x * y - s * z, v * x * z + s * y,
            v * x * y + s * z, c + v * y * y, v * y * z - s * x,
            v * x * z - s * y, v * y * z + s * x, c + v * z * z,
        )  # fmt: skip

    @staticmethod
    def RPY(roll: float, pitch: float, yaw: float) -> "Rotation":
        """About the fixed axes x, y, z, in this order."""
        return Rotation.RotZ(yaw) * Rotation.RotY(pitch) * Rotation.RotX(roll)

    @staticmethod
    def EulerZYX(Alfa: float, Beta: float, Gamma: float) -> "Rotation":
        """About the turning axes z, y, x."""
        return Rotation.RPY(Gamma, Beta, Alfa)

    @staticmethod
    def EulerZYZ(Alfa: float, Beta: float, Gamma: float) -> "Rotation":
        """About the turning axes z, y, z."""
        return Rotation.RotZ(Alfa) * Rotation.RotY(Beta) * Rotation.RotZ(Gamma)

    @staticmethod
    def Quaternion(x: float, y: float, z: float, w: float) -> "Rotation":
        """Rotation of a quaternion, which should have length 1."""
        return Rotation(
            w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
            2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z,
        )  # fmt: skip

    def __getitem__(self, index: tuple[int, int]) -> float:
        return self._values[_position(index)]

    def __setitem__(self, index: tuple[int, int], value: float) -> None:
        self._values[_position(index)] = float(value)

    def __mul__(self, other: "Any") -> "Any":
        if isinstance(other, Rotation):
            columns = [self * other._column(column) for column in range(3)]
            return Rotation(*columns)
        if isinstance(other, Vector):
            m = self._values
            x, y, z = other
            return Vector(
                m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z
            )
        return other._rotated(self) if hasattr(other, "_rotated") else NotImplemented

    def Inverse(self, argument: "Any" = None) -> "Any":
        """Inverse; or the inverse times a Vector, Twist or Wrench."""
        m = self._values
        inverse = Rotation(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8])
        return inverse if argument is None else inverse * argument

    def SetInverse(self) -> None:
        """Invert in place."""
        self._values = self.Inverse()._values

    def DoRotX(self, angle: float) -> None:
        """Turn about its own x, in place."""
        self._values = (self * Rotation.RotX(angle))._values

    def DoRotY(self, angle: float) -> None:
        """Turn about its own y, in place."""
        self._values = (self * Rotation.RotY(angle))._values

    def DoRotZ(self, angle: float) -> None:
        """Turn about its own z, in place."""
        self._values = (self * Rotation.RotZ(angle))._values

    def UnitX(self, axis: Vector | None = None) -> Vector | None:
        """The x axis; with an argument: set it."""
        return self._axis(0, axis)

    def UnitY(self, axis: Vector | None = None) -> Vector | None:
        """The y axis; with an argument: set it."""
        return self._axis(1, axis)

    def UnitZ(self, axis: Vector | None = None) -> Vector | None:
        """The z axis; with an argument: set it."""
        return self._axis(2, axis)

    def GetRPY(self) -> tuple[float, float, float]:
        """(roll, pitch, yaw); roll is 0 where pitch is ±90°."""
        m = self._values
        pitch = math.atan2(-m[6], math.hypot(m[0], m[3]))
        if abs(pitch) > math.pi / 2 - _TINY:
            return 0.0, pitch, math.atan2(-m[1], m[4])
        return math.atan2(m[7], m[8]), pitch, math.atan2(m[3], m[0])

    def GetEulerZYX(self) -> tuple[float, float, float]:
        """Angles about the turning axes z, y, x."""
        roll, pitch, yaw = self.GetRPY()
        return yaw, pitch, roll

    def GetEulerZYZ(self) -> tuple[float, float, float]:
        """Angles about the turning axes z, y, z."""
        m = self._values
        if abs(m[8]) > 1.0 - _TINY:
            return (math.atan2(m[3], m[0]), 0.0, 0.0) if m[8] > 0 else (math.atan2(-m[3], -m[0]), math.pi, 0.0)
        return math.atan2(m[5], m[2]), math.atan2(math.hypot(m[6], m[7]), m[8]), math.atan2(m[7], -m[6])

    def GetQuaternion(self) -> tuple[float, float, float, float]:
        """(x, y, z, w)."""
        m = self._values
        trace = m[0] + m[4] + m[8]
        if trace > _TINY:
            s = 0.5 / math.sqrt(trace + 1.0)
            return (m[7] - m[5]) * s, (m[2] - m[6]) * s, (m[3] - m[1]) * s, 0.25 / s
        i = 0 if m[0] > m[4] and m[0] > m[8] else 1 if m[4] > m[8] else 2
        j, k = (i + 1) % 3, (i + 2) % 3
        s = 2.0 * math.sqrt(1.0 + self[i, i] - self[j, j] - self[k, k])
        q = [0.0, 0.0, 0.0, (self[k, j] - self[j, k]) / s]
        q[i], q[j], q[k] = 0.25 * s, (self[i, j] + self[j, i]) / s, (self[i, k] + self[k, i]) / s
        return q[0], q[1], q[2], q[3]

    def GetRotAngle(self, eps: float = EPSILON) -> tuple[float, Vector]:
        """(angle, axis); the angle is 0 to π, the axis z if the angle is below `eps`."""
        m = self._values
        skew = Vector(m[7] - m[5], m[2] - m[6], m[3] - m[1])
        if any(abs(value) >= eps for value in skew):
            length = skew.Norm()
            return math.atan2(length / 2.0, (m[0] + m[4] + m[8] - 1.0) / 2.0), skew / length
        if abs(m[0] + m[4] + m[8] - 3.0) < 3 * eps:
            return 0.0, Vector(0, 0, 1)
        i = max(range(3), key=lambda axis: self[axis, axis])  # a half turn: the symmetric part is 2·axis·axisᵀ − 1
        size = math.sqrt((self[i, i] + 1.0) / 2.0)
        axis = [(self[i, j] + self[j, i]) / 4.0 / size for j in range(3)]
        axis[i] = size
        return math.pi, Vector(*axis)

    def GetRot(self) -> Vector:
        """Axis times angle."""
        angle, axis = self.GetRotAngle()
        return axis * angle

    def is_close(self, other: "Rotation", eps: float) -> bool:
        """True if no two numbers differ by `eps` or more."""
        return all(abs(a - b) < eps for a, b in zip(self._values, other._values, strict=True))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Rotation) and self.is_close(other, EPSILON)

    def __copy__(self) -> "Rotation":
        return Rotation(self)

    def __deepcopy__(self, memo: object) -> "Rotation":
        return Rotation(self)

    def __reduce__(self) -> tuple[object, ...]:
        return Rotation, tuple(self._values)

    def __repr__(self) -> str:
        rows = [",".join(text(value) for value in self._values[row : row + 3]) for row in (0, 3, 6)]
        return "[" + ";\n ".join(rows) + "]"

    def _column(self, column: int) -> Vector:
        return Vector(*self._values[column::3])

    def _axis(self, column: int, axis: Vector | None) -> Vector | None:
        if axis is None:
            return self._column(column)
        self._values[column::3] = list(axis)
        return None


def _position(index: tuple[int, int]) -> int:
    row, column = index
    if not (0 <= row < 3 and 0 <= column < 3):
        raise IndexError("Rotation index out of range")
    return 3 * row + column
