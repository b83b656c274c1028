"""Builtins and `math` functions for expressions, with bounded results."""

import ast
import builtins
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import reduce
from typing import Any

from .budget import Budget, bound_bits, bound_length
from .formatting import repr_of, text_of
from .operators import BINARY, allocate_integer, is_short, spend_product
from .values import Caller, Guarded

_MAX_DIGITS = 100
"""Largest number of digits for round()."""


def _linear_time(function: Callable[..., Any]) -> Guarded:
    """Guard a function whose cost is linear in the length of its arguments, after expanding lazy iterators."""

    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        arguments = [item if item.__class__ is float else _iterable(caller.budget, item) for item in values]
        return allocate_integer(caller.budget, function(*arguments, **named))

    return call


def _iterable(budget: Budget, value: Any) -> Any:
    """Return the value with all lazy iterators expanded."""
    match value:
        case str():
            budget.spend(len(value) >> 4)
        case int():
            spend_product(budget, value, value)
        case list() | tuple() | set() | frozenset() | dict() | range() | Iterator():
            return [_iterable(budget, item) for item in budget.collect(value)]
        case _:
            pass
    return value


def _constant_time(function: Callable[..., Any]) -> Guarded:
    """Guard a function of constant cost."""
    return lambda _caller, values, named: function(*values, **named)


def _converted(kind: type) -> Guarded:
    """Guard the conversion of a text or number to a number."""

    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        for item in values:
            if isinstance(item, str):
                caller.budget.spend(len(item) >> 2)
        return allocate_integer(caller.budget, kind(*values, **named))

    return call


def _text(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    if len(values) > 1 or named:
        raise TypeError("str() takes one value here")
    return text_of(caller.budget, values[0]) if values else ""


def _repr(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    (value,) = _only(values, named, "repr", 1)
    return repr_of(caller.budget, value)


def _only(values: Sequence[Any], named: Mapping[str, Any], name: str, count: int) -> Sequence[Any]:
    if named or len(values) != count:
        raise TypeError(f"{name}() takes {count} argument(s) here ({len(values) + len(named)} given)")
    return values


def _sequence(kind: type) -> Guarded:
    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        if not values and not named:
            return kind()
        (items,) = _only(values, named, kind.__name__, 1)
        result = caller.budget.collect(items)
        return result if kind is list else kind(result)

    return call


def _set(kind: type) -> Guarded:
    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        result: set[Any] = set()
        for item in caller.budget.collect(_only(values, named, kind.__name__, 1)[0]) if values else ():
            result.add(caller.budget.spend_lookup(item, len(result)))
            caller.budget.allocate(60)
        caller.budget.allocate(200)
        return result if kind is set else frozenset(result)

    return call


def dictionary(caller: Caller, values: Sequence[object], named: Mapping[str, object]) -> dict[object, object]:
    """Create a dictionary from another, or from pairs."""
    result: dict[Any, Any] = {}
    pairs: Iterable[Any] = ()
    if values:
        (source,) = _only(values, {}, "dict", 1)
        pairs = dict.items(source) if isinstance(source, dict) else caller.budget.collect(source)
    for pair in (*pairs, *named.items()):
        key, value = caller.budget.collect(pair)
        result[caller.budget.spend_lookup(key, len(result))] = value
        caller.budget.allocate(100)
    caller.budget.allocate(64)
    return result


def _kind(_caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> type:
    (value,) = _only(values, named, "type", 1)
    return type(value)


def _is_kind(function: Callable[[Any, Any], bool]) -> Guarded:
    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> bool:
        value, kinds = _only(values, named, function.__name__, 2)
        caller.budget.spend_traversal(kinds)
        return function(value, kinds)

    return call


def _range(_caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> range:
    limits = _only(values, named, "range", max(len(values), 1))
    if not all(is_short(item) for item in limits if isinstance(item, int)):
        bound_length(math.inf)
    result = range(*limits)
    bound_length(len(result))
    return result


def _map(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Iterator[Any]:
    if len(values) < 2 or named:
        raise TypeError("map() must have at least two arguments.")
    function, *sequences = values
    _hold_iterators(caller.budget, sequences)
    tuples = zip(*map(iter, sequences), strict=False)
    return caller.budget.lazy(
        caller.call(function, items, {}) for items in _charged_tuples(caller.budget, tuples, len(sequences))
    )


def _filter(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Iterator[Any]:
    function, items = _only(values, named, "filter", 2)
    charged = caller.budget.iterate(iter(items))
    return caller.budget.lazy(
        item for item in charged if (item if function is None else caller.call(function, [item], {}))
    )


def _iterating(function: Callable[..., Iterable[Any]]) -> Guarded:
    """Guard a function that yields the items of other iterables."""

    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Iterator[Any]:
        _hold_iterators(caller.budget, values)
        return caller.budget.lazy(_charged_tuples(caller.budget, function(*values, **named), len(values) + 1))

    return call


def _hold_iterators(budget: Budget, values: Sequence[object]) -> None:
    budget.spend(len(values))
    budget.allocate(64 * len(values))


def _charged_tuples(budget: Budget, items: Iterable[Any], width: int) -> Iterator[Any]:
    """Iterate over tuples of `width` values, charging each."""
    for item in items:
        budget.spend(width)
        budget.allocate(40 + 8 * width)
        yield item


def sort(caller: Caller, values: Sequence[object], named: Mapping[str, object]) -> list[object]:
    """Sort as sorted() does."""
    (items,) = _only(values, {}, "sorted", 1)
    collected = caller.budget.collect(items)
    key, rest = _key_and_rest(named, ("reverse",))
    keys = collected if key is None else [caller.call(key, [item], {}) for item in collected]
    _spend_comparisons(caller.budget, keys)
    order = sorted(range(len(collected)), key=keys.__getitem__, **rest)
    return [collected[index] for index in order]


def _spend_comparisons(budget: Budget, keys: list[Any]) -> None:
    before, _ = budget.spent
    size = budget.spend_traversal(keys)
    traversal = budget.spent[0] - before
    budget.allocate(size)
    budget.spend(((traversal >> 1) + (size >> 4)) * len(keys).bit_length())


def _key_and_rest(named: Mapping[str, Any], known: Sequence[str]) -> tuple[Any, dict[str, Any]]:
    unknown = [name for name in named if name not in ("key", *known)]
    if unknown:
        raise TypeError(f"{unknown[0]!r} is an invalid keyword argument")
    return named.get("key"), {name: value for name, value in named.items() if name != "key"}


def _extreme(function: Callable[..., Any]) -> Guarded:
    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        if not named and len(values) == 2 and all(isinstance(item, int | float) for item in values):
            return function(*values)
        key, rest = _key_and_rest(named, ("default",))
        collected = caller.budget.collect(values[0]) if len(values) == 1 else list(values)
        if not collected or (rest and len(values) > 1):
            return function(*([collected] if len(values) == 1 else values), **rest)
        keys = collected if key is None else [caller.call(key, [item], {}) for item in collected]
        caller.budget.spend_traversal(keys)
        return collected[function(range(len(collected)), key=keys.__getitem__)]

    return call


def _sum(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
    items, *more = values
    start = more[0] if more else named.get("start", 0)
    if len(more) > 1 or named.keys() - {"start"}:
        raise TypeError("sum() takes a sequence and a start")
    if isinstance(start, str):
        raise TypeError("sum() can't sum strings [use ''.join(seq) instead]")
    collected = caller.budget.collect(items)
    caller.budget.spend_traversal(collected)
    if all(isinstance(item, float | int) for item in collected) and isinstance(start, int | float):
        return allocate_integer(caller.budget, sum(collected, start))  # Python 3.12 and newer compensate rounding
    return reduce(lambda a, b: _add(caller.budget, a, b), collected, start)


_add, _multiply = BINARY[ast.Add], BINARY[ast.Mult]


def _round(_caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
    digits = values[1] if len(values) > 1 else named.get("ndigits")
    if isinstance(digits, int) and abs(digits) > _MAX_DIGITS:
        raise ValueError(f"round() takes at most {_MAX_DIGITS} digits")
    return round(*values, **named)


def _truth(function: Callable[[Iterable[Any]], bool]) -> Guarded:
    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> bool:
        (items,) = _only(values, named, function.__name__, 1)
        return function(caller.budget.iterate(items))

    return call


def _of_small_integers(function: Callable[..., int]) -> Guarded:
    """Guard a function whose result has about sixteen bits for each unit of its arguments."""

    def call(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> int:
        bits = max((abs(item) * 16 for item in values if isinstance(item, int)), default=0)
        bound_bits(bits)
        caller.budget.spend(bits * bits >> 18)
        return allocate_integer(caller.budget, function(*values, **named))

    return call


def _common_multiple(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> int:
    bound_bits(sum(item.bit_length() for item in values if isinstance(item, int)))
    return _linear_time(math.lcm)(caller, values, named)


def _product(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
    items = caller.budget.collect(*values)
    if set(named) - {"start"}:
        raise TypeError("prod() takes a sequence and a start")
    return reduce(lambda a, b: _multiply(caller.budget, a, b), items, named.get("start", 1))


MATH_NAMES: Mapping[str, object] = {name: value for name, value in vars(math).items() if not name.startswith("_")}
"""Names of `from math import *`."""

GUARDED: Mapping[Callable[..., object], Guarded] = {
    **{function: _linear_time(function) for function in MATH_NAMES.values() if callable(function)},
    **{function: _of_small_integers(function) for function in (math.factorial, math.comb, math.perm)},
    math.lcm: _common_multiple,
    math.prod: _product,
    **{function: _linear_time(function) for function in (abs, divmod)},
    **{function: _constant_time(function) for function in (bool, len, ord, slice)},
    **{kind: _converted(kind) for kind in (int, float, complex)},
    **{kind: _sequence(kind) for kind in (list, tuple)},
    **{kind: _set(kind) for kind in (set, frozenset)},
    **{function: _iterating(function) for function in (enumerate, reversed, zip)},
    **{function: _extreme(function) for function in (min, max)},
    **{function: _truth(function) for function in (all, any)},
    **{function: _is_kind(function) for function in (isinstance, issubclass)},
    str: _text,
    repr: _repr,
    dict: dictionary,
    type: _kind,
    range: _range,
    map: _map,
    filter: _filter,
    sorted: sort,
    sum: _sum,
    round: _round,
}
"""Function → guarded replacement."""

_PLAIN = "abs all any bool dict float int len list map max min round sorted str sum tuple"
PYTHON_NAMES: Mapping[str, object] = {name: getattr(builtins, name) for name in _PLAIN.split()}
"""Builtins available without a prefix."""
