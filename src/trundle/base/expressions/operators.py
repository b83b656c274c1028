"""Operators of expressions, with results bounded before they are created."""

import ast
import operator
from collections.abc import Callable
from typing import Any, cast

from .budget import VIEWS, Budget, bound_bits, bound_length
from .formatting import percent_text

Operation = Callable[[Budget, object, object], Any]

_MACHINE_WORD = 1 << 62
_SEQUENCES: Any = (str, list, tuple)
_KEYED: Any = (dict, set, frozenset, *VIEWS)
_CONTAINERS: Any = (list, tuple, *_KEYED)


def is_short(number: int) -> bool:
    """True if an integer is small enough to cost nothing."""
    return -_MACHINE_WORD < number < _MACHINE_WORD


def allocate_integer(budget: Budget, value: Any) -> Any:
    """Use the memory of an integer; refuse one that is too long."""
    if isinstance(value, int) and not is_short(value):
        bits = value.bit_length()
        bound_bits(bits)
        budget.allocate(bits >> 3)
        budget.spend(bits >> 10)
    return value


def _add(budget: Budget, left: Any, right: Any) -> Any:
    if isinstance(left, _SEQUENCES) and isinstance(right, _SEQUENCES):
        wider = right if isinstance(left, str) and left.isascii() else left
        _hold_sequence(budget, wider, len(left) + len(right))
    return allocate_integer(budget, left + right)


def _multiply(budget: Budget, left: Any, right: Any) -> Any:
    for sequence, number in ((left, right), (right, left)):
        if isinstance(number, int) and isinstance(sequence, _SEQUENCES):
            _hold_sequence(budget, sequence, len(sequence) * max(number, 0))
    if isinstance(left, int) and isinstance(right, int):
        bound_bits(left.bit_length() + right.bit_length())
        spend_product(budget, left, right)
    return left * right


def _hold_sequence(budget: Budget, example: Any, length: int) -> None:
    """Use the memory of a text, list or tuple of the same type with `length` items."""
    bound_length(length)
    octets = (1 if example.isascii() else 4) if isinstance(example, str) else 8
    budget.allocate(56 + octets * length)
    budget.spend(length >> 5)


def spend_product(budget: Budget, left: int, right: int) -> None:
    """Use the steps of multiplying or dividing two integers."""
    if not (is_short(left) and is_short(right)):
        budget.spend(left.bit_length() * right.bit_length() >> 16)
        budget.allocate((left.bit_length() + right.bit_length()) >> 3)


def _power(budget: Budget, base: Any, exponent: Any) -> Any:
    if isinstance(base, int) and isinstance(exponent, int) and base not in (-1, 0, 1):
        bits = base.bit_length() * abs(exponent)
        bound_bits(bits)
        budget.spend(bits * bits >> 16)
        budget.allocate(bits >> 3)
    return base**exponent


def _shift_right(budget: Budget, a: Any, b: Any) -> Any:
    return allocate_integer(budget, a >> b)


def _shift(budget: Budget, left: Any, right: Any) -> Any:
    if isinstance(left, int) and isinstance(right, int):
        bound_bits(left.bit_length() + right)
        budget.allocate(max(right, 0) >> 3)
    return left << right


def _modulo(budget: Budget, left: Any, right: Any) -> Any:
    if isinstance(left, str):
        return percent_text(budget, left, right)
    return _division(operator.mod)(budget, left, right)


def _division(function: Callable[[Any, Any], Any]) -> Operation:
    def divide(budget: Budget, left: Any, right: Any) -> Any:
        if isinstance(left, int) and isinstance(right, int):
            spend_product(budget, left, right)
        return function(left, right)

    return divide


def _spend_merge(budget: Budget, left: Any, right: Any) -> None:
    """Use the steps and memory of combining dictionaries, sets and views."""
    for operand in (left, right):
        if not isinstance(operand, _CONTAINERS):
            raise TypeError(f"a set or dictionary cannot be combined with a {type(operand).__name__!r} object")
        budget.allocate(100 * len(operand))
    budget.spend_keys(left, right)


def _merging(function: Callable[[Any, Any], Any]) -> Operation:
    def merge(budget: Budget, left: Any, right: Any) -> Any:
        if isinstance(left, _KEYED) or isinstance(right, _KEYED):
            _spend_merge(budget, left, right)
        value = function(left, right)
        if isinstance(value, dict | set | frozenset):
            bound_length(len(value))
        return allocate_integer(budget, value)

    return merge


BINARY: dict[type[ast.operator], Operation] = {
    ast.Add: _add,
    ast.Sub: _merging(operator.sub),
    ast.Mult: _multiply,
    ast.Div: _division(operator.truediv),
    ast.FloorDiv: _division(operator.floordiv),
    ast.Mod: _modulo,
    ast.Pow: _power,
    ast.LShift: _shift,
    ast.RShift: _shift_right,
    ast.BitAnd: _merging(operator.and_),
    ast.BitOr: _merging(operator.or_),
    ast.BitXor: _merging(operator.xor),
}
"""All operators except the matrix product."""
FLOAT_OPERATORS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
"""Operators applied without a check where one operand is a float."""

UNARY: dict[type[ast.unaryop], Callable[[Budget, Any], Any]] = {
    ast.Not: lambda _, a: not a,
    ast.USub: lambda budget, a: allocate_integer(budget, -a),
    ast.UAdd: lambda budget, a: allocate_integer(budget, +a),
    ast.Invert: lambda budget, a: allocate_integer(budget, ~a),
}


def _ordered(function: Callable[[Any, Any], Any]) -> Operation:
    def compare(budget: Budget, left: Any, right: Any) -> Any:
        spend_comparison(budget, left, right)
        return function(left, right)

    return compare


def spend_comparison(budget: Budget, left: object, right: object) -> None:
    """Use the steps of comparing two values."""
    if isinstance(left, _CONTAINERS):
        if isinstance(right, _CONTAINERS):
            budget.spend_traversal(left)
            budget.spend_traversal(right)
    elif isinstance(left, str):
        budget.spend(len(left) >> 6)


def contains(budget: Budget, item: Any, container: Any) -> bool:
    """True if a value is in a container."""
    if isinstance(container, str):
        budget.spend(len(container) >> 4)
    elif isinstance(container, dict | set | frozenset):
        budget.spend_lookup(item, len(cast("set[object]", container)))
    elif isinstance(container, list | tuple):
        spend_comparison(budget, item, container)
        budget.spend_traversal(cast(object, container))
    elif not isinstance(container, range) or not isinstance(item, int):
        return any(item is element or equal(budget, element, item) for element in budget.iterate(container, 3))
    return operator.contains(container, item)


def equal(budget: Budget, left: object, right: object) -> bool:
    """True if two values are equal."""
    spend_comparison(budget, left, right)
    return bool(left == right)


COMPARISONS: dict[type[ast.cmpop], Operation] = {
    ast.Eq: _ordered(operator.eq),
    ast.NotEq: _ordered(operator.ne),
    ast.Lt: _ordered(operator.lt),
    ast.LtE: _ordered(operator.le),
    ast.Gt: _ordered(operator.gt),
    ast.GtE: _ordered(operator.ge),
    ast.Is: lambda _, a, b: a is b,
    ast.IsNot: lambda _, a, b: a is not b,
    ast.In: contains,
    ast.NotIn: lambda budget, a, b: not contains(budget, a, b),
}
