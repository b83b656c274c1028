"""The geometry of Orocos' PyKDL: Vector, Rotation, Frame, Twist, Wrench."""

from .delta import Equal, SetToZero, addDelta, diff, dot
from .frame import Frame
from .rotation import Rotation
from .screws import Twist, Wrench
from .vector import Vector

__all__ = ["Equal", "Frame", "Rotation", "SetToZero", "Twist", "Vector", "Wrench", "addDelta", "diff", "dot"]

for _class in (Frame, Rotation, Twist, Vector, Wrench):
    _class.__module__ = __name__


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    raise AttributeError(
        f"PyKDL.{name} is not part of Trundle's PyKDL, which has {', '.join(__all__)}; chains and solvers need "
        "Orocos KDL itself (Debian and Ubuntu: python3-pykdl), which is used as soon as it is installed"
    )
