"""Vectors of three numbers as tuples."""

import math
from typing import TypeAlias

Vector3: TypeAlias = tuple[float, float, float]

ZERO: Vector3 = (0.0, 0.0, 0.0)


def add(a: Vector3, b: Vector3) -> Vector3:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector3, b: Vector3) -> Vector3:
    """Return a − b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def multiply(a: Vector3, factor: float) -> Vector3:
    """Return a vector times a number."""
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a: Vector3, b: Vector3) -> float:
    """Return the scalar product a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector3, b: Vector3) -> Vector3:
    """Return the cross product a × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(v: Vector3) -> Vector3 | None:
    """Return v with length one, or None if its length is zero or not finite."""
    length = math.hypot(*v)
    if not 0.0 < length < math.inf:
        return None
    return (v[0] / length, v[1] / length, v[2] / length)
