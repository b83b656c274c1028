"""Geometry and forward kinematics of Orocos' PyKDL."""

from .chain import Chain, Segment
from .delta import Equal, SetToZero, addDelta, diff, dot
from .frame import Frame
from .joint import Joint
from .joint_arrays import Add, Divide, Jacobian, JntArray, Multiply, Subtract
from .rotation import Rotation
from .screws import Twist, Wrench
from .solvers import ChainFkSolverPos_recursive, ChainJntToJacSolver
from .vector import Vector

__all__ = [
    "Add", "Chain", "ChainFkSolverPos_recursive", "ChainJntToJacSolver", "Divide", "Equal", "Frame", "Jacobian",
    "JntArray", "Joint", "Multiply", "Rotation", "Segment", "SetToZero", "Subtract", "Twist", "Vector", "Wrench",
    "addDelta", "diff", "dot",
]  # fmt: skip

for _class in (Chain, Frame, Jacobian, JntArray, Joint, Rotation, Segment, Twist, Vector, Wrench):
    _class.__module__ = __name__


def __getattr__(name: str) -> object:
    if name.startswith("__"):
        raise AttributeError(name)
    raise AttributeError(
        f"PyKDL.{name} is not part of Trundle's PyKDL, which has {', '.join(__all__)}; trees, inverse kinematics and "
        "dynamics need Orocos KDL itself (Debian and Ubuntu: python3-pykdl), which is used where it is installed"
    )
