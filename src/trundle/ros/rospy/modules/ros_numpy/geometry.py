"""Vectors, points, quaternions; poses and transforms as 4×4 matrices."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion, Transform, Vector3

from tf import transformations

from .registry import converts_from_numpy, converts_to_numpy

if TYPE_CHECKING:
    from numpy.typing import NDArray


@converts_to_numpy(Vector3)
def vector3_to_numpy(msg: Any, hom: bool = False) -> "NDArray[Any]":
    """(3,), or homogeneous (4,)."""
    return np.array([msg.x, msg.y, msg.z, 0] if hom else [msg.x, msg.y, msg.z])


@converts_from_numpy(Vector3)
def numpy_to_vector3(arr: "NDArray[Any]") -> Any:
    """Vector3 from (3,) or (4,); an array of Vector3 from (…, 3) or (…, 4)."""
    if arr.shape[-1] == 4:
        assert np.all(arr[..., -1] == 0), "a homogeneous vector ends in 0"
        arr = arr[..., :-1]
    return _from_rows(Vector3, arr)


@converts_to_numpy(Point)
def point_to_numpy(msg: Any, hom: bool = False) -> "NDArray[Any]":
    """(3,), or homogeneous (4,)."""
    return np.array([msg.x, msg.y, msg.z, 1] if hom else [msg.x, msg.y, msg.z])


@converts_from_numpy(Point)
def numpy_to_point(arr: "NDArray[Any]") -> Any:
    """Point from (3,) or (4,); an array of Points from (…, 3) or (…, 4)."""
    if arr.shape[-1] == 4:
        arr = arr[..., :-1] / arr[..., -1:]
    return _from_rows(Point, arr)


@converts_to_numpy(Quaternion)
def quat_to_numpy(msg: Any) -> "NDArray[Any]":
    """(4,): x, y, z, w."""
    return np.array([msg.x, msg.y, msg.z, msg.w])


@converts_from_numpy(Quaternion)
def numpy_to_quat(arr: "NDArray[Any]") -> Any:
    """Quaternion from (4,); an array of Quaternions from (…, 4)."""
    assert arr.shape[-1] == 4
    return _from_rows(Quaternion, arr)


@converts_to_numpy(Transform)
def transform_to_numpy(msg: Any) -> "NDArray[np.float64]":
    """4×4."""
    return _matrix(msg.translation, msg.rotation)


@converts_from_numpy(Transform)
def numpy_to_transform(arr: "NDArray[Any]") -> Any:
    """Transform from 4×4; an array of Transforms from (…, 4, 4)."""

    def create(matrix: "NDArray[np.float64]") -> Any:
        return Transform(Vector3(*matrix[:3, 3]), _quaternion(matrix))

    return _from_matrices(arr, create)


@converts_to_numpy(Pose)
def pose_to_numpy(msg: Any) -> "NDArray[np.float64]":
    """4×4."""
    return _matrix(msg.position, msg.orientation)


@converts_from_numpy(Pose)
def numpy_to_pose(arr: "NDArray[Any]") -> Any:
    """Pose from 4×4; an array of Poses from (…, 4, 4)."""

    def create(matrix: "NDArray[np.float64]") -> Any:
        return Pose(Point(*matrix[:3, 3]), _quaternion(matrix))

    return _from_matrices(arr, create)


def _matrix(position: Any, orientation: Any) -> "NDArray[np.float64]":
    matrix = transformations.quaternion_matrix(quat_to_numpy(orientation))
    matrix[:3, 3] = position.x, position.y, position.z
    return matrix


def _quaternion(matrix: "NDArray[np.float64]") -> Any:
    return Quaternion(*transformations.quaternion_from_matrix(matrix))


def _from_rows(cls: Callable[..., Any], arr: "NDArray[Any]") -> Any:
    if arr.ndim == 1:
        return cls(*arr)
    return np.apply_along_axis(lambda row: cls(*row), axis=-1, arr=arr)


def _from_matrices(arr: "NDArray[Any]", create: "Callable[[NDArray[Any]], Any]") -> Any:
    assert arr.shape[-2:] == (4, 4)
    if arr.ndim == 2:
        return create(arr)
    messages = np.empty(arr.shape[:-2], dtype=object)
    for index in np.ndindex(messages.shape):
        messages[index] = create(arr[index])
    return messages
