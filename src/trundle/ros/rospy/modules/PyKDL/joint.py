"""Joint of a chain: one degree of freedom, or none."""

from enum import IntEnum

from .frame import Frame
from .rotation import Rotation
from .screws import Twist
from .vector import Vector

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from typing import Any

NO_NAME = "NoName"


class JointType(IntEnum):
    """Kinds of joints."""

    RotAxis = 0
    RotX = 1
    RotY = 2
    RotZ = 3
    TransAxis = 4
    TransX = 5
    TransY = 6
    TransZ = 7
    Fixed = 8


_AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}


class Joint:
    """Rotation about an axis [rad], or translation along it [m]; the value is scaled, then offset."""

    JointType = JointType
    RotAxis, RotX, RotY, RotZ = JointType.RotAxis, JointType.RotX, JointType.RotY, JointType.RotZ
    TransAxis, TransX, TransY, TransZ = JointType.TransAxis, JointType.TransX, JointType.TransY, JointType.TransZ
    Fixed = JointType.Fixed

    def __init__(self, *arguments: "Any", **keywords: "Any") -> None:
        """A copy, or [name], [origin, axis], type, scale, offset; inertia, damping and stiffness have no effect."""
        if len(arguments) == 1 and isinstance(arguments[0], Joint):
            vars(self).update(vars(arguments[0]))
            return
        remaining = list(arguments)
        self._name = remaining.pop(0) if remaining and isinstance(remaining[0], str) else keywords.pop("name", NO_NAME)
        self._origin, axis = Vector(), None
        if remaining and isinstance(remaining[0], Vector):
            self._origin, axis = Vector(remaining.pop(0)), Vector(remaining.pop(0))
            axis.Normalize()
        names = ("type", "scale", "offset", "inertia", "damping", "stiffness")
        values = {**dict(zip(names, remaining, strict=False)), **keywords}
        if len(remaining) > len(names) or set(values) - set(names):
            raise TypeError(
                f"Joint takes [name], [origin, axis] and {', '.join(names)}, not {arguments!r}, {keywords!r}"
            )
        self._type = JointType(values.get("type", JointType.Fixed))
        self._scale, self._offset = float(values.get("scale", 1.0)), float(values.get("offset", 0.0))
        self._axis = axis or Vector(*_AXES.get(self._type.name[-1], (0, 0, 0)))

    def getName(self) -> str:
        """Name."""
        return self._name

    def getType(self) -> JointType:
        """Kind."""
        return self._type

    def getTypeName(self) -> str:
        """Name of the kind."""
        return self._type.name

    def JointAxis(self) -> Vector:
        """Axis, of length 1; zero of a fixed joint."""
        return Vector(self._axis)

    def JointOrigin(self) -> Vector:
        """Point on the axis."""
        return Vector(self._origin)

    def pose(self, q: float) -> Frame:
        """Pose after the joint, at the value q."""
        value = self._scale * q + self._offset
        if self._type == JointType.Fixed:
            return Frame()
        if self._type.name.startswith("Rot"):
            return Frame(Rotation.Rot2(self._axis, value), self._origin)
        return Frame(self._origin + self._axis * value)

    def twist(self, qdot: float) -> Twist:
        """Velocity at the origin, at the rate qdot."""
        velocity = self._axis * (self._scale * qdot)
        return Twist(Vector(), velocity) if self._type.name.startswith("Rot") else Twist(velocity, Vector())

    def __repr__(self) -> str:
        return f"{self._name}:[{self.getTypeName()}, axis: {self._axis}, origin{self._origin}]"
