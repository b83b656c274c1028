"""Vectors of three numbers as tuples."""

import math
from typing import Any, TypeAlias

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


def numbers_of(values: Any, counts: tuple[int, ...], problem: str) -> tuple[float, ...]:
    """Return the numbers of a sequence or array (N,), N being one of `counts`.

    Raises:
        ValueError: they are something else; the message is `problem`, and what they are.
    """
    try:
        numbers = tuple(float(value + 0.0) for value in values)  # text plus a number is a TypeError
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) not in counts:
        raise ValueError(f"{problem}, got {values!r}") from None
    return numbers
