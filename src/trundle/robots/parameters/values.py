"""Conversion of parameter values, which are typed in ROS and text in SDF.

Each function raises ValueError for an invalid value; its message follows the parameter's name.
"""

import math
import re
from typing import SupportsFloat

from trundle.base.xmlnode import MAX_NUMBER, is_within

_TRUTHS = {"true": True, "1": True, "false": False, "0": False}
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")
_MAX_SHOWN = 40


def number(value: object) -> float:
    """Return a finite number."""
    try:
        result = float(value) if isinstance(value, str | SupportsFloat) else None
    except (OverflowError, TypeError, ValueError):
        result = None
    if result is None or isinstance(value, bool):
        raise ValueError(f": {_shorten(value)} is not a number")
    if not math.isfinite(result):
        raise ValueError(f": {_shorten(value)} is not a finite number")
    if not is_within([result], MAX_NUMBER):
        raise ValueError(f": {_shorten(value)} is not within ±{MAX_NUMBER:g}")
    return result


def integer(value: object) -> float:
    """Return a number to be truncated to an integer; hexadecimal text is accepted."""
    if isinstance(value, str) and _HEXADECIMAL.fullmatch(value):
        return int(value, 16)
    return number(value)


def in_bounds(value: float, minimum: float, above: float) -> float:
    """Return the value if it is ≥ `minimum` and > `above`."""
    if value < minimum:
        raise ValueError(f" must be ≥ {minimum:g}, got {value:g}")
    if not value > above:
        raise ValueError(f" must be > {above:g}, got {value:g}")
    return value


def flag(value: object) -> bool:
    """Return a boolean; numbers are true unless 0."""
    result = _TRUTHS.get(value.lower()) if isinstance(value, str) else value
    if not isinstance(result, bool | int | float):
        raise ValueError(f": {_shorten(value)} is neither true nor false")
    return bool(result)


def text(value: object) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise ValueError(f": {_shorten(value)} is not a text")
    return value


def numbers(value: object, count: int) -> tuple[float, ...]:
    """Return `count` finite numbers from a list, or from a text separated by white space."""
    parts = value.split() if isinstance(value, str) else value
    if not isinstance(parts, list) or len(parts) != count:
        raise ValueError(f": {_shorten(value)} is not {count} numbers")
    return tuple(number(part) for part in parts)


def _shorten(value: object) -> str:
    shown = repr(value)
    return shown if len(shown) <= _MAX_SHOWN else f"{shown[: _MAX_SHOWN - 3]}..."
