"""Composed transforms, view frustums, crystal cells and point-set alignment."""

import math
from typing import TYPE_CHECKING

import numpy as np

from .euler import euler_matrix
from .quaternions import quaternion_matrix
from .vectors import _EPS, vector_norm

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .vectors import Array, Vector


def concatenate_matrices(*matrices: "ArrayLike") -> "Array":
    """Product of matrices, from the left."""
    product = np.identity(4)
    for matrix in matrices:
        product = np.dot(product, matrix)
    return product


def is_same_transform(matrix0: "ArrayLike", matrix1: "ArrayLike") -> bool:
    """True if two matrices are the same transform up to a factor."""
    first, second = (np.array(matrix, dtype=np.float64) for matrix in (matrix0, matrix1))
    return np.allclose(first / first[3, 3], second / second[3, 3])


def clip_matrix(
    left: float, right: float, bottom: float, top: float, near: float, far: float, perspective: bool = False
) -> "Array":
    """Map a view frustum (or box) to the cube from -1 to 1.

    Raises:
        ValueError: a lower bound is not below its upper bound, or `near` is not positive in perspective.
    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError("not a frustum: left < right, bottom < top and near < far are needed")
    width, height, depth = right - left, top - bottom, far - near
    if not perspective:
        return np.array(
            (
                (2.0 / width, 0.0, 0.0, -(right + left) / width),
                (0.0, 2.0 / height, 0.0, -(top + bottom) / height),
                (0.0, 0.0, 2.0 / depth, -(far + near) / depth),
                (0.0, 0.0, 0.0, 1.0),
            )
        )
    if near <= _EPS:
        raise ValueError("not a frustum: near must be positive")
    return np.array(
        (
            (-2.0 * near / width, 0.0, (right + left) / width, 0.0),
            (0.0, -2.0 * near / height, (top + bottom) / height, 0.0),
            (0.0, 0.0, -(far + near) / depth, 2.0 * far * near / depth),
            (0.0, 0.0, -1.0, 0.0),
        )
    )


def decompose_matrix(matrix: "ArrayLike") -> "tuple[Array, list[float], list[float], Array, Array]":
    """(scale, shear, angles, translate, perspective), as `compose_matrix` takes them.

    Formulas: Spencer W. Thomas, Decomposing a Matrix into Simple Transformations, Graphics Gems II, 1991.

    Raises:
        ValueError: the matrix is singular.
    """
    m = np.array(matrix, dtype=np.float64).T
    if abs(m[3, 3]) < _EPS:
        raise ValueError("the last element is zero")
    m /= m[3, 3]
    affine = m.copy()
    affine[:, 3] = 0.0, 0.0, 0.0, 1.0
    if not np.linalg.det(affine):
        raise ValueError("the matrix is singular")
    if np.any(np.abs(m[:3, 3]) > _EPS):
        perspective = np.dot(m[:, 3], np.linalg.inv(affine.T))
    else:
        perspective = np.array((0.0, 0.0, 0.0, 1.0))
    translate = m[3, :3].copy()
    rows = m[:3, :3].copy()
    scale, shear = _orthogonalize(rows)
    if np.dot(rows[0], np.cross(rows[1], rows[2])) < 0.0:
        scale, rows = -scale, -rows
    middle = math.asin(-rows[0, 2])
    if math.cos(middle):
        angles = [math.atan2(rows[1, 2], rows[2, 2]), middle, math.atan2(rows[0, 1], rows[0, 0])]
    else:
        angles = [math.atan2(-rows[2, 1], rows[1, 1]), middle, 0.0]
    return scale, shear, angles, translate, perspective


def _orthogonalize(rows: "Array") -> "tuple[Array, list[float]]":
    """Gram-Schmidt on three rows in place; returns scale (3,) and the shears [xy, xz, yz]."""
    scale, shear = np.zeros(3), [0.0, 0.0, 0.0]
    scale[0] = vector_norm(rows[0])
    rows[0] /= scale[0]
    shear[0] = np.dot(rows[0], rows[1])
    rows[1] -= rows[0] * shear[0]
    scale[1] = vector_norm(rows[1])
    rows[1] /= scale[1]
    shear[0] /= scale[1]
    shear[1] = np.dot(rows[0], rows[2])
    rows[2] -= rows[0] * shear[1]
    shear[2] = np.dot(rows[1], rows[2])
    rows[2] -= rows[1] * shear[2]
    scale[2] = vector_norm(rows[2])
    rows[2] /= scale[2]
    shear[1] /= scale[2]
    shear[2] /= scale[2]
    return scale, shear


def compose_matrix(
    scale: "Vector | None" = None,
    shear: "Vector | None" = None,
    angles: "Vector | None" = None,
    translate: "Vector | None" = None,
    perspective: "Vector | None" = None,
) -> "Array":
    """Product of perspective (4), translate (3), angles (static x, y, z), shear (xy, xz, yz) and scale (3)."""
    matrix = np.identity(4)
    if perspective is not None:
        matrix[3, :] = perspective[:4]
    if translate is not None:
        shift = np.identity(4)
        shift[:3, 3] = translate[:3]
        matrix = matrix @ shift
    if angles is not None:
        x, y, z = angles[:3]
        matrix = matrix @ euler_matrix(x, y, z, "sxyz")
    if shear is not None:
        skew = np.identity(4)
        skew[0, 1], skew[0, 2], skew[1, 2] = shear[:3]
        matrix = matrix @ skew
    if scale is not None:
        matrix = matrix @ np.diag([*scale[:3], 1.0])
    return matrix / matrix[3, 3]


def orthogonalization_matrix(lengths: "Vector", angles: "Vector") -> "Array":
    """Transform from crystal cell coordinates to Cartesian ones.

    Args:
        lengths: edges a, b, c of the cell.
        angles: angles alpha, beta, gamma between the edges [degrees].
    """
    a, b, c = lengths
    alpha, beta, gamma = np.radians(angles)
    cos_reciprocal = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (math.sin(alpha) * math.sin(beta))
    sin_reciprocal = math.sqrt(1.0 - cos_reciprocal * cos_reciprocal)
    return np.array(
        (
            (a * math.sin(beta) * sin_reciprocal, 0.0, 0.0, 0.0),
            (-a * math.sin(beta) * cos_reciprocal, b * math.sin(alpha), 0.0, 0.0),
            (a * math.cos(beta), b * math.cos(alpha), c, 0.0),
            (0.0, 0.0, 0.0, 1.0),
        )
    )


def superimposition_matrix(v0: "ArrayLike", v1: "ArrayLike", scaling: bool = False, usesvd: bool = True) -> "Array":
    """4×4 transform that maps points `v0` on `v1` with the least squared error.

    Args:
        v0: points, (3, N) or (4, N).
        v1: points of the same shape.
        scaling: allow a uniform scale.
        usesvd: singular value decomposition (Kabsch) in place of the eigenvector of the quaternion matrix (Horn).

    Raises:
        ValueError: the two differ in shape, or there are fewer than three points.
    """
    first, second = np.array(v0, dtype=np.float64)[:3], np.array(v1, dtype=np.float64)[:3]
    if first.shape != second.shape or first.shape[1] < 3:
        raise ValueError("two sets of at least three points each are needed, of the same shape")
    center0, center1 = first.mean(axis=1), second.mean(axis=1)
    first, second = first - center0[:, None], second - center1[:, None]
    matrix = np.identity(4)
    matrix[:3, :3] = (_kabsch if usesvd else _horn)(first, second)
    if scaling:
        matrix[:3, :3] *= math.sqrt(np.sum(second * second) / np.sum(first * first))
    matrix[:3, 3] = center1 - matrix[:3, :3] @ center0
    return matrix


def _kabsch(first: "Array", second: "Array") -> "Array":
    """Best rotation of centered points: Wolfgang Kabsch, Acta Cryst. A32, 1976."""
    u, _, vh = np.linalg.svd(second @ first.T)
    if np.linalg.det(u) * np.linalg.det(vh) < 0.0:  # a reflection: flip the axis of the smallest singular value
        u[:, 2] = -u[:, 2]
    return u @ vh


def _horn(first: "Array", second: "Array") -> "Array":
    """Best rotation of centered points: Berthold K. P. Horn, J. Opt. Soc. Am. A 4(4), 1987."""
    s = first @ second.T
    delta = s - s.T
    quadratic = np.empty((4, 4))
    quadratic[0, 0] = np.trace(s)
    quadratic[0, 1:] = quadratic[1:, 0] = delta[1, 2], delta[2, 0], delta[0, 1]
    quadratic[1:, 1:] = s + s.T - np.trace(s) * np.identity(3)
    values, vectors = np.linalg.eigh(quadratic)
    w, x, y, z = vectors[:, int(np.argmax(values))]
    return quaternion_matrix([x, y, z, w])[:3, :3]
