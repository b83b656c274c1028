"""Text formatting: str(), %, str.format and f-strings, without access to attributes or items of values."""

import re
from collections.abc import Mapping, Sequence
from string import Formatter
from typing import Any, cast

from .budget import Budget, ExpressionError, bound_length

_NUMBER = re.compile(r"\d+")
_MAX_WIDTH = 9999
"""Largest width or precision of a format."""


def text_of(budget: Budget, value: object) -> str:
    """Convert a value as str() does."""
    if isinstance(value, str):
        return value
    budget.spend_traversal(value)
    return budget.allocate_text(str(value))


def repr_of(budget: Budget, value: object) -> str:
    """Convert a value as repr() does."""
    budget.spend_traversal(value)
    return budget.allocate_text(repr(value))


def ascii_of(budget: Budget, value: object) -> str:
    """Convert a value as ascii() does."""
    budget.spend_traversal(value)
    return budget.allocate_text(ascii(value))


def percent_text(budget: Budget, text: str, values: object) -> str:
    """Format as `text % values` does."""
    if "*" in text and re.search(r"%[^a-zA-Z%]*\*", text):
        raise _unsupported(text)
    count = text.count("%") if isinstance(values, dict) else 1
    bound_length(len(text) + _sum_of_widths(text) + count * budget.spend_traversal(values))
    values = dict(cast("dict[str, object]", values)) if isinstance(values, dict) else values  # a plain copy
    return budget.allocate_text(text % values)


def formatted(budget: Budget, value: object, spec: str) -> str:
    """Format as `format(value, spec)` does."""
    if not spec:
        return text_of(budget, value)
    if not isinstance(value, str | int | float | complex):
        raise TypeError(f"unsupported format string passed to {type(value).__name__}.__format__")
    bound_length(len(spec) + _sum_of_widths(spec) + budget.spend_traversal(value))
    return budget.allocate_text(format(value, spec))


def format_text(budget: Budget, text: str, values: Sequence[object], named: Mapping[str, object]) -> str:
    """Format as `text.format(*values, **named)` does."""
    budget.spend(len(text) >> 2)
    return budget.allocate_text(_Formatter(budget).vformat(text, values, named))


def _sum_of_widths(spec: str) -> int:
    widths = [int(digits[:12]) for digits in _NUMBER.findall(spec)]
    if widths and max(widths) > _MAX_WIDTH:
        raise _unsupported(spec)
    return sum(widths)


def _unsupported(spec: str) -> ExpressionError:
    return ExpressionError(f"the format {spec[:50]!r} is not supported")


class _Formatter(Formatter):
    """Python's formatter with whole values as fields: `{0.part}` and `{0[part]}` are refused."""

    def __init__(self, budget: Budget) -> None:
        self._budget = budget
        self._length = 0

    def get_field(self, field_name: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        if not (field_name.isdecimal() or field_name.isidentifier()):
            raise ExpressionError(f"the format field {field_name[:50]!r} is not supported: a field is a whole value")
        key = int(field_name) if field_name.isdecimal() else field_name
        return self.get_value(key, args, kwargs), key

    def get_value(self, key: int | str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        if isinstance(key, int) and key >= len(args):
            raise IndexError(f"Replacement index {key} out of range for positional args tuple")
        return args[key] if isinstance(key, int) else kwargs[key]

    def convert_field(self, value: Any, conversion: str | None) -> Any:
        return converted(self._budget, value, conversion)

    def format_field(self, value: Any, format_spec: str) -> str:
        text = formatted(self._budget, value, format_spec)
        self._length += len(text)
        bound_length(self._length)
        self._budget.spend(10)
        return text


def converted(budget: Budget, value: object, conversion: str | None) -> object:
    """Apply the `!s`, `!r` or `!a` of a field."""
    match conversion:
        case None:
            return value
        case "s":
            return text_of(budget, value)
        case "r":
            return repr_of(budget, value)
        case "a":
            return ascii_of(budget, value)
        case _:
            raise ValueError(f"Unknown conversion specifier {conversion!r}")
