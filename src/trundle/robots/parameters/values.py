"""Values of settings: typed already, as ROS' parameters are, or text, as SDF's are.

Each function raises ValueError for a value of no use; its text goes on where the setting's name ends.
"""

import math
import re
from typing import SupportsFloat

from trundle.base.xmlnode import MAX_NUMBER, is_within

_TRUTHS = {"true": True, "1": True, "false": False, "0": False}
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")
_LONGEST = 40


def number(value: object) -> float:
    """A finite number."""
    try:
        found = float(value) if isinstance(value, str | SupportsFloat) else None
    except (TypeError, ValueError):
        found = None
    if found is None or isinstance(value, bool):
        raise ValueError(f": {_shorten(value)} is not a number")
    if not math.isfinite(found):
        raise ValueError(f": {_shorten(value)} is not a finite number")
    if not is_within([found], MAX_NUMBER):
        raise ValueError(f": {_shorten(value)} is not within ±{MAX_NUMBER:g}")
    return found


def integer(value: object) -> float:
    """A whole number, or one whose fraction is to be cut off."""
    if isinstance(value, str) and _HEXADECIMAL.fullmatch(value):
        return int(value, 16)
    return number(value)


def in_bounds(value: float, minimum: float, above: float) -> float:
    """The value, if it is not less than one bound and greater than the other."""
    if value < minimum:
        raise ValueError(f" must be ≥ {minimum:g}, got {value:g}")
    if not value > above:
        raise ValueError(f" must be > {above:g}, got {value:g}")
    return value


def flag(value: object) -> bool:
    """A truth value; numbers count as Python counts them."""
    found = _TRUTHS.get(value.lower()) if isinstance(value, str) else value
    if not isinstance(found, bool | int | float):
        raise ValueError(f": {_shorten(value)} is neither true nor false")
    return bool(found)


def text(value: object) -> str:
    """A text."""
    if not isinstance(value, str):
        raise ValueError(f": {_shorten(value)} is not a text")
    return value


def numbers(value: object, count: int) -> tuple[float, ...]:
    """So many finite numbers, of a list or of a text with white space between them."""
    parts = value.split() if isinstance(value, str) else value
    if not isinstance(parts, list) or len(parts) != count:
        raise ValueError(f": {_shorten(value)} is not {count} numbers")
    return tuple(number(part) for part in parts)


def _shorten(value: object) -> str:
    shown = repr(value)
    return shown if len(shown) <= _LONGEST else f"{shown[: _LONGEST - 3]}..."
