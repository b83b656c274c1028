"""Lengths and directions of vectors."""

import numpy as np

_EPS = np.finfo(float).eps * 4.0
"""Numbers smaller than this count as zero."""


def vector_norm(data, axis=None, out=None):
    """Euclidean length along an axis, or of all elements: a float if `data` is a vector, else an array."""
    squares = np.square(np.array(data, dtype=np.float64))
    if out is None:
        length = np.sqrt(squares.sum(axis=axis))
        return length if squares.ndim == 1 else np.atleast_1d(length)
    np.sqrt(squares.sum(axis=axis), out=out)
    return None


def unit_vector(data, axis=None, out=None):
    """`data` divided by its length along an axis; written to `out` if that is given."""
    vectors = np.array(data, dtype=np.float64) if out is None else np.asarray(data, dtype=np.float64)
    length = np.sqrt(np.square(vectors).sum(axis=axis))
    if axis is not None:
        length = np.expand_dims(length, axis)
    if out is None:
        return vectors / length
    np.divide(vectors, length, out=out)
    return None


def random_vector(size):
    """Uniformly distributed numbers in [0, 1), of the given shape."""
    return np.random.random(size)


def eigenvector_for(matrix, eigenvalue):
    """Last real eigenvector of a matrix for an eigenvalue, or None."""
    values, vectors = np.linalg.eig(matrix)
    found = np.flatnonzero(np.abs(values.real - eigenvalue) < 1e-8)
    return vectors[:, found[-1]].real if len(found) else None


def fixed_point(matrix):
    """Homogeneous point [x, y, z, 1] that a 4×4 transform leaves in place, or None."""
    point = eigenvector_for(matrix, 1.0)
    return None if point is None else point / point[3]
