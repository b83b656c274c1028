"""Poses as PyKDL.Frame, from and to other types."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy
from geometry_msgs.msg import Point, Pose, Quaternion

from PyKDL import Frame, Rotation, Vector

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def fromTf(tf: tuple[Sequence[float], Sequence[float]]) -> Frame:
    """Frame of the pair (x, y, z), (x, y, z, w) that tf lookups return."""
    position, quaternion = tf
    return Frame(Rotation.Quaternion(*quaternion[:4]), Vector(*position[:3]))


def toTf(f: Frame) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
    """The pair (x, y, z), (x, y, z, w)."""
    return (f.p[0], f.p[1], f.p[2]), f.M.GetQuaternion()


def fromMsg(p: Any) -> Frame:
    """Frame of a geometry_msgs Pose."""
    position, orientation = p.position, p.orientation
    return Frame(
        Rotation.Quaternion(orientation.x, orientation.y, orientation.z, orientation.w),
        Vector(position.x, position.y, position.z),
    )


def toMsg(f: Frame) -> Any:
    """geometry_msgs Pose of a Frame."""
    return Pose(Point(f.p[0], f.p[1], f.p[2]), Quaternion(*f.M.GetQuaternion()))


def fromMatrix(m: "NDArray[numpy.float64]") -> Frame:
    """Frame of a 4×4 matrix."""
    return Frame(Rotation(*(m[row, column] for row in range(3) for column in range(3))), Vector(*m[:3, 3]))


def toMatrix(f: Frame) -> "NDArray[numpy.float64]":
    """4×4 matrix of a Frame."""
    rows = [[f.M[row, column] for column in range(3)] + [f.p[row]] for row in range(3)]
    return numpy.array([*rows, [0.0, 0.0, 0.0, 1.0]])


def fromCameraParams(cv: object, rvec: "ArrayLike", tvec: "ArrayLike") -> Frame:
    """Frame of OpenCV's rotation vector and translation; `cv` is not used."""
    del cv
    rotation, translation = (numpy.asarray(vector, dtype=float).ravel() for vector in (rvec, tvec))
    angle = math.sqrt(float(rotation @ rotation))
    axis = Vector(*rotation.tolist())
    turn = Rotation.Rot(axis, angle) if angle > 0.0 else Rotation()
    return Frame(turn, Vector(*translation.tolist()))
