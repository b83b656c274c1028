"""Translation, rotation, reflection, scaling, projection and shear, as matrices and back."""

import math
from typing import TYPE_CHECKING

import numpy as np

from .vectors import _EPS, eigenvector_for, fixed_point, unit_vector, vector_norm

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .vectors import Array, Vector


def identity_matrix() -> "Array":
    """4×4 identity."""
    return np.identity(4)


def inverse_matrix(matrix: "ArrayLike") -> "Array":
    """Inverse of a square matrix."""
    return np.linalg.inv(np.asarray(matrix))


def translation_matrix(direction: "Vector") -> "Array":
    """Translation by a vector."""
    matrix = np.identity(4)
    matrix[:3, 3] = direction[:3]
    return matrix


def translation_from_matrix(matrix: "ArrayLike") -> "Array":
    """Translation part of a matrix, (3,)."""
    return np.array(matrix)[:3, 3].copy()


def reflection_matrix(point: "Vector", normal: "Vector") -> "Array":
    """Reflection at the plane through `point` perpendicular to `normal`."""
    n = unit_vector(normal[:3])
    matrix = np.identity(4)
    matrix[:3, :3] -= 2.0 * np.outer(n, n)
    matrix[:3, 3] = 2.0 * np.dot(point[:3], n) * n
    return matrix


def reflection_from_matrix(matrix: "ArrayLike") -> "tuple[Array, Array]":
    """Plane (point, normal) of a reflection matrix.

    Raises:
        ValueError: the matrix is no reflection.
    """
    m = np.asarray(matrix, dtype=np.float64)
    normal = eigenvector_for(m[:3, :3], -1.0)
    if normal is None:
        raise ValueError("not a reflection: no eigenvalue is -1")
    point = fixed_point(m)
    if point is None:
        raise ValueError("not a reflection: no eigenvalue is 1")
    return point, normal


def rotation_matrix(angle: float, direction: "Vector", point: "Vector | None" = None) -> "Array":
    """Rotation by `angle` about the axis `direction`, which passes through `point` (default: the origin)."""
    axis = unit_vector(direction[:3])
    sin, cos = math.sin(angle), math.cos(angle)
    x, y, z = axis * sin
    rotation = np.diag([cos] * 3) + (1.0 - cos) * np.outer(axis, axis)
    rotation += [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    matrix = np.identity(4)
    matrix[:3, :3] = rotation
    if point is not None:
        center = np.asarray(point[:3], dtype=np.float64)
        matrix[:3, 3] = center - rotation @ center
    return matrix


def rotation_from_matrix(matrix: "ArrayLike") -> "tuple[float, Array, Array]":
    """Angle, axis (3,) and a homogeneous point on the axis of a rotation matrix.

    Raises:
        ValueError: the matrix is no rotation.
    """
    m = np.asarray(matrix, dtype=np.float64)
    rotation = m[:3, :3]
    axis = eigenvector_for(rotation.T, 1.0)
    point = fixed_point(m)
    if axis is None or point is None:
        raise ValueError("not a rotation: no eigenvalue is 1")
    cos = (np.trace(rotation) - 1.0) / 2.0
    # sin × axis is the skew-symmetric part; the largest component of the axis divides with the least error.
    skew = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    largest = int(np.argmax(np.abs(axis)))
    return math.atan2(skew[largest] / 2.0 / axis[largest], cos), axis, point


def scale_matrix(factor: float, origin: "Vector | None" = None, direction: "Vector | None" = None) -> "Array":
    """Scaling by `factor` about `origin`, in all directions or along `direction` only."""
    matrix = np.identity(4)
    if direction is None:
        matrix[:3, :3] *= factor
    else:
        axis = unit_vector(direction[:3])
        matrix[:3, :3] -= (1.0 - factor) * np.outer(axis, axis)
    if origin is not None:
        center = np.asarray(origin[:3], dtype=np.float64)
        matrix[:3, 3] = center - matrix[:3, :3] @ center
    return matrix


def scale_from_matrix(matrix: "ArrayLike") -> "tuple[float, Array, Array | None]":
    """Factor, homogeneous origin, and direction of a scaling; direction is None if uniform.

    Raises:
        ValueError: the matrix has no fixed point.
    """
    m = np.asarray(matrix, dtype=np.float64)
    factor = np.trace(m[:3, :3]) - 2.0
    direction = eigenvector_for(m[:3, :3], factor)
    if direction is None:
        factor = (factor + 2.0) / 3.0
    else:
        direction = direction / vector_norm(direction)
    origin = fixed_point(m)
    if origin is None:
        raise ValueError("not a scaling: no eigenvalue is 1")
    return factor, origin, direction


def projection_matrix(
    point: "Vector",
    normal: "Vector",
    direction: "Vector | None" = None,
    perspective: "Vector | None" = None,
    pseudo: bool = False,
) -> "Array":
    """Projection on the plane through `point` perpendicular to `normal`.

    Args:
        point: a point of the plane.
        normal: normal of the plane.
        direction: direction of a parallel projection; default: along the normal.
        perspective: center of a perspective projection, instead of `direction`.
        pseudo: keep the relative depth of points, in a perspective projection.
    """
    matrix = np.identity(4)
    p = np.array(point[:3], dtype=np.float64)
    n = unit_vector(normal[:3])
    if perspective is not None:
        eye = np.array(perspective[:3], dtype=np.float64)
        depth = np.dot(eye - p, n)
        matrix[:3, :3] = depth * np.identity(3) - np.outer(eye, n)
        matrix[:3, 3] = np.dot(p, n) * eye
        if pseudo:
            matrix[:3, :3] -= np.outer(n, n)
            matrix[:3, 3] = np.dot(p, n) * (eye + n)
        matrix[3, :3] = -n
        matrix[3, 3] = np.dot(eye, n)
        return matrix
    along = n if direction is None else np.array(direction[:3], dtype=np.float64)
    along = along / np.dot(along, n)
    matrix[:3, :3] -= np.outer(along, n)
    matrix[:3, 3] = along * np.dot(p, n)
    return matrix


def projection_from_matrix(
    matrix: "ArrayLike", pseudo: bool = False
) -> "tuple[Array, Array, Array | None, Array | None, bool]":
    """(point, normal, direction, perspective, pseudo): the arguments of `projection_matrix`; unused ones are None.

    Raises:
        ValueError: the matrix is no projection.
    """
    m = np.asarray(matrix, dtype=np.float64)
    point = fixed_point(m)
    if not pseudo and point is not None:
        direction = eigenvector_for(m[:3, :3], 0.0)
        normal = eigenvector_for(m[:3, :3].T, 0.0)
        if direction is None or normal is None:
            raise ValueError("not a projection: no eigenvalue is 0")
        return point, normal / vector_norm(normal), direction / vector_norm(direction), None, False
    values, vectors = np.linalg.eig(m)
    moving = np.flatnonzero(np.abs(np.real(values)) > 1e-8)
    if not len(moving):
        raise ValueError("not a projection: every eigenvalue is 0")
    point = np.real(vectors[:, moving[-1]])
    point = point / point[3]
    normal = -m[3, :3]
    perspective = m[:3, 3] / np.dot(point[:3], normal)
    if pseudo:
        perspective = perspective - normal
    return point, normal, None, perspective, pseudo


def shear_matrix(angle: float, direction: "Vector", point: "Vector", normal: "Vector") -> "Array":
    """Shear by `angle` along `direction`, which lies in the fixed plane through `point` with `normal`.

    Raises:
        ValueError: direction and normal are not perpendicular.
    """
    n = unit_vector(normal[:3])
    along = unit_vector(direction[:3])
    if abs(np.dot(n, along)) > 1e-6:
        raise ValueError("direction and normal are not perpendicular")
    slope = math.tan(angle)
    matrix = np.identity(4)
    matrix[:3, :3] += slope * np.outer(along, n)
    matrix[:3, 3] = -slope * np.dot(point[:3], n) * along
    return matrix


def shear_from_matrix(matrix: "ArrayLike") -> "tuple[float, Array, Array, Array]":
    """(angle, direction, point, normal): the arguments of `shear_matrix`.

    Raises:
        ValueError: the matrix is no shear.
    """
    m = np.asarray(matrix, dtype=np.float64)
    change = m[:3, :3] - np.identity(3)  # slope · direction · normalᵀ, of rank 1
    left, singular_values, right = np.linalg.svd(change)
    slope, direction, normal = singular_values[0], left[:, 0], right[0]
    if singular_values[1] > 1e-4 * max(slope, _EPS) or slope < _EPS or abs(np.dot(direction, normal)) > 1e-4:
        raise ValueError("not a shear: the matrix has no fixed plane")
    nearest = np.linalg.lstsq(change, -m[:3, 3], rcond=1e-8)[0]
    return math.atan(slope), direction, np.append(nearest, 1.0), normal
