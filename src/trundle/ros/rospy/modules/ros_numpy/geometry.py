"""Vectors, points, quaternions; poses and transforms as 4×4 matrices."""

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion, Transform, Vector3

from tf import transformations

from .registry import converts_from_numpy, converts_to_numpy


@converts_to_numpy(Vector3)
def vector3_to_numpy(msg, hom=False):
    """(3,), or homogeneous (4,)."""
    return np.array([msg.x, msg.y, msg.z, 0] if hom else [msg.x, msg.y, msg.z])


@converts_from_numpy(Vector3)
def numpy_to_vector3(arr):
    """Vector3 of (3,) or (4,); an array of them of (…, 3)."""
    if arr.shape[-1] == 4:
        assert np.all(arr[..., -1] == 0), "a homogeneous vector ends in 0"
        arr = arr[..., :-1]
    return _each(Vector3, arr)


@converts_to_numpy(Point)
def point_to_numpy(msg, hom=False):
    """(3,), or homogeneous (4,)."""
    return np.array([msg.x, msg.y, msg.z, 1] if hom else [msg.x, msg.y, msg.z])


@converts_from_numpy(Point)
def numpy_to_point(arr):
    """Point of (3,) or (4,); an array of them of (…, 3)."""
    if arr.shape[-1] == 4:
        arr = arr[..., :-1] / arr[..., -1:]
    return _each(Point, arr)


@converts_to_numpy(Quaternion)
def quat_to_numpy(msg):
    """(4,): x, y, z, w."""
    return np.array([msg.x, msg.y, msg.z, msg.w])


@converts_from_numpy(Quaternion)
def numpy_to_quat(arr):
    """Quaternion of (4,); an array of them of (…, 4)."""
    assert arr.shape[-1] == 4
    return _each(Quaternion, arr)


@converts_to_numpy(Transform)
def transform_to_numpy(msg):
    """4×4."""
    return _matrix(msg.translation, msg.rotation)


@converts_from_numpy(Transform)
def numpy_to_transform(arr):
    """Transform of 4×4; an array of them of (…, 4, 4)."""
    return _each_matrix(arr, lambda matrix: Transform(Vector3(*matrix[:3, 3]), _quaternion(matrix)))


@converts_to_numpy(Pose)
def pose_to_numpy(msg):
    """4×4."""
    return _matrix(msg.position, msg.orientation)


@converts_from_numpy(Pose)
def numpy_to_pose(arr):
    """Pose of 4×4; an array of them of (…, 4, 4)."""
    return _each_matrix(arr, lambda matrix: Pose(Point(*matrix[:3, 3]), _quaternion(matrix)))


def _matrix(position, orientation):
    matrix = transformations.quaternion_matrix(quat_to_numpy(orientation))
    matrix[:3, 3] = position.x, position.y, position.z
    return matrix


def _quaternion(matrix):
    return Quaternion(*transformations.quaternion_from_matrix(matrix))


def _each(cls, arr):
    if arr.ndim == 1:
        return cls(*arr)
    return np.apply_along_axis(lambda row: cls(*row), axis=-1, arr=arr)


def _each_matrix(arr, make):
    assert arr.shape[-2:] == (4, 4)
    if arr.ndim == 2:
        return make(arr)
    made = np.empty(arr.shape[:-2], dtype=object)
    for index in np.ndindex(made.shape):
        made[index] = make(arr[index])
    return made
