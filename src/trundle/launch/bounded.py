"""Python's functions as expressions of launch files may call them: no result grows without bound."""

import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

_MAX_SIZE = 100_000
"""Characters, items or bits of any intermediate value."""
_MOST_DIGITS = 100
_FAR_FORMAT = re.compile(r"%[^a-zA-Z%]*(\d{4}|\*)|\{[^}:!]*[.\[]|\{[^}]*(\d{4}|\{)")
"""Widths of four digits or taken from a value, and `{0.part}`, `{0[part]}`."""


class ExpressionError(Exception):
    """The expression is not one; the text says why."""


def limit(size: int) -> None:
    """Refuse a value of that size if it is too large."""
    if size > _MAX_SIZE:
        raise ExpressionError("the value grows too large")


def limit_all_of(value: object) -> None:
    """Refuse a value of too many values, however few of them are different ones."""
    size, todo = 0, [value]
    while todo:
        match todo.pop():
            case list() | tuple() as items:
                size += len(items)
                todo += items if size <= _MAX_SIZE else []
            case dict() as pairs:
                size += len(pairs)
                todo += [*pairs, *pairs.values()] if size <= _MAX_SIZE else []
            case str() as text:
                size += len(text)
            case _:
                continue
        limit(size)


def check_format(text: str, values: Iterable[object]) -> None:
    """Refuse a format that could reach an attribute or make text of any size."""
    sizes = [len(str(value)) for value in values if isinstance(value, str | int | float)]
    if len(sizes) != len(list(values)):
        raise ExpressionError("only text and numbers can be formatted here")
    if _FAR_FORMAT.search(text):
        raise ExpressionError(f"{text!r} is no format allowed here: no widths of four digits, no parts of values")
    limit((text.count("%") + text.count("{")) * max(sizes, default=0))


def _bounded(function: Callable[..., int]) -> Callable[..., int]:
    def call(*numbers: int) -> int:
        limit(sum(abs(n) * int(n).bit_length() for n in numbers))
        return function(*numbers)

    return call


def _prod(numbers: Iterable[Any]) -> Any:
    listed = list(numbers)
    limit(sum(n.bit_length() if isinstance(n, int) else 1 for n in listed))
    return math.prod(listed)


def _map(function: Callable[..., Any], *sequences: Iterable[Any]) -> list[Any]:
    found: list[Any] = []
    size = 0
    for items in zip(*sequences, strict=False):
        found.append(function(*items))
        size += len(found[-1]) if hasattr(found[-1], "__len__") else 1
        limit(size)
    return found


def _str(value: object = "") -> str:
    limit_all_of(value)
    return str(value)


def _sum(numbers: Iterable[Any]) -> Any:
    return sum(numbers)  # without a start, it adds numbers only


def _round(number: float, digits: int | None = None) -> float:
    if digits is not None and abs(digits) > _MOST_DIGITS:
        raise ExpressionError(f"it rounds to at most {_MOST_DIGITS} digits")
    return round(number, digits)


MATH_NAMES: Mapping[str, Any] = {
    **{name: value for name, value in vars(math).items() if not name.startswith("_")},
    **{function.__name__: _bounded(function) for function in (math.factorial, math.comb, math.perm)},
    "prod": _prod,
}
"""What `from math import *` gives."""

BASE_NAMES: Mapping[str, Any] = {
    "true": True,
    "false": False,
    "map": _map,
    "str": _str,
    **{f.__name__: f for f in (list, dict, float, int)},
    # Not meant by roslaunch to be there, but Python gives them to its expressions, and files use them.
    "round": _round,
    "sum": _sum,
    **{f.__name__: f for f in (abs, all, any, bool, len, max, min, sorted, tuple)},
    **MATH_NAMES,
}
"""The names roslaunch gives every expression, beside the functions that depend on the file."""
