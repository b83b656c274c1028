"""Lengths and directions of vectors."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]
    Vector = Sequence[float] | Array

_EPS = np.finfo(float).eps * 4.0
"""Tolerance below which numbers count as zero."""


def vector_norm(data: "ArrayLike", axis: int | None = None, out: "Array | None" = None) -> Any:
    """Euclidean length along an axis, or of all elements: a float if `data` is a vector, else an array."""
    squares = np.square(np.array(data, dtype=np.float64))
    if out is None:
        length = np.sqrt(squares.sum(axis=axis))
        return length if squares.ndim == 1 else np.atleast_1d(length)
    np.sqrt(squares.sum(axis=axis), out=out)
    return None


@overload
def unit_vector(data: "ArrayLike", axis: int | None = None, out: None = None) -> "Array": ...


@overload
def unit_vector(data: "ArrayLike", axis: int | None = None, *, out: "Array") -> None: ...


def unit_vector(data: "ArrayLike", axis: int | None = None, out: "Array | None" = None) -> "Array | None":
    """`data` divided by its length along an axis; written to `out` if that is given."""
    vectors = np.array(data, dtype=np.float64) if out is None else np.asarray(data, dtype=np.float64)
    length = np.sqrt(np.square(vectors).sum(axis=axis))
    if axis is not None:
        length = np.expand_dims(length, axis)
    if out is None:
        return vectors / length
    np.divide(vectors, length, out=out)
    return None


def random_vector(size: int | tuple[int, ...]) -> "Array":
    """Uniformly distributed numbers in [0, 1), of the given shape."""
    return np.random.random(size)


def eigenvector_for(matrix: "Array", eigenvalue: float) -> "Array | None":
    """Last real eigenvector of a matrix for an eigenvalue, or None."""
    values, vectors = np.linalg.eig(matrix)
    indices = np.flatnonzero(np.abs(np.real(values) - eigenvalue) < 1e-8)
    return np.real(vectors[:, indices[-1]]) if len(indices) else None


def fixed_point(matrix: "Array") -> "Array | None":
    """Homogeneous point [x, y, z, 1] that a 4×4 transform leaves in place, or None."""
    point = eigenvector_for(matrix, 1.0)
    return None if point is None else point / point[3]
