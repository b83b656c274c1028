"""Methods and attributes available to expressions, by object type."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from .budget import bound_length
from .containers import copied, known_keys
from .formatting import format_text
from .functions import sort
from .values import Callee, Caller, Function

_Guarded = Callable[[Caller, Any, Sequence[Any], Mapping[str, Any]], Any]
"""Calls a method of the object in the second argument."""


class Method(Callee):
    """Bound method."""

    __slots__ = ("_guard", "_owner", "name")

    def __init__(self, name: str, owner: object, guard: _Guarded) -> None:
        self.name = name
        self._owner = owner
        self._guard = guard

    def call(self, caller: Caller, values: Sequence[object], named: Mapping[str, object], /) -> object:
        return self._guard(caller, self._owner, values, named)

    def __repr__(self) -> str:
        return f"<method {self.name}>"


def attribute(owner: object, name: str) -> object:
    """Return an attribute.

    Raises:
        AttributeError: it does not exist or is not allowed.
    """
    if isinstance(owner, type):
        if name in METHODS_OF.get(owner, ()):
            return Function(name, _of_first(owner, name))
        subject = f"type object {owner.__name__!r}"
    else:
        kind = next((kind for kind in type(owner).__mro__ if kind in METHODS_OF), object)
        if name in METHODS_OF.get(kind, ()):
            return Method(name, owner, METHODS_OF[kind][name])
        if name in _DATA_OF.get(kind, ()):
            return getattr(owner, name)
        subject = f"{type(owner).__name__!r} object"
    restriction = " that an expression may use" if name.startswith("_") or hasattr(type(owner), name) else ""
    raise AttributeError(f"{subject} has no attribute {name!r}{restriction}{_instead(owner, name)}")


def _instead(owner: object, name: str) -> str:
    """End of the message on a missing attribute: a dictionary's keys, which are attributes in xacro's dictionaries."""
    if not isinstance(owner, dict):
        return ""
    keys: dict[object, object] = owner
    return f"; its key is written [{name!r}]" if name in keys else f", nor such a key{known_keys(keys)}"


def _of_first(kind: type, name: str) -> Callable[..., Any]:
    """Return an unbound method, as in `map(str.upper, texts)`."""

    def body(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        if not values or not isinstance(values[0], kind):
            raise TypeError(f"{kind.__name__}.{name}() needs a {kind.__name__} first")
        return METHODS_OF[kind][name](caller, values[0], values[1:], named)

    return body


def is_method(kind: type, name: str) -> bool:
    """True if a type has this method and expressions may use it."""
    return name in METHODS_OF.get(kind, ())


def _linear_size(name: str, *, product: bool = False, cost_of_keys: bool = False, deep: bool = False) -> _Guarded:
    """Guard a method whose result is at most about three times as long as its input.

    Args:
        name: method's name.
        product: True: it may traverse its arguments once per character of the text.
        cost_of_keys: True: it looks up its first argument as a key.
        deep: True: it compares its arguments with the items.
    """

    def call(caller: Caller, owner: Any, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        budget = caller.budget
        if isinstance(owner, str):
            length = budget.spend_traversal(values)
            budget.spend(1 + (len(owner) + length >> 4))
            if product:
                budget.spend(len(owner) * length >> 8)
        elif isinstance(owner, dict | set | frozenset) and name == "copy":
            budget.spend_keys(owner)
        elif hasattr(type(owner), "__len__"):
            budget.spend(1 + (len(owner) >> 5))
        if cost_of_keys and values:
            budget.spend_lookup(values[0], len(owner))
        if deep:
            budget.spend_traversal(owner)
            budget.spend_traversal(values)
        result = getattr(owner, name)(*values, **named)
        if isinstance(result, str):
            budget.allocate_text(result)
        elif isinstance(result, list | tuple | dict | set | frozenset):
            budget.spend(len(result))
            budget.allocate(sum(50 + len(item) if isinstance(item, str) else 50 for item in result))
        return result

    return call


def _padded(name: str) -> _Guarded:
    def call(caller: Caller, owner: str, values: Sequence[Any], named: Mapping[str, Any]) -> str:
        width = max((value for value in (*values, *named.values()) if isinstance(value, int)), default=8)
        bound_length(width * (owner.count("\t") if name == "expandtabs" else 1))
        return caller.budget.allocate_text(getattr(owner, name)(*values, **named))

    return call


def _replace(caller: Caller, owner: str, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    old, new = ([*values, "", ""])[:2]
    if isinstance(old, str) and isinstance(new, str):
        caller.budget.spend(len(owner) + len(old) >> 4)
        count = owner.count(old) if old else len(owner) + 1
        bound_length(len(owner) + count * max(len(new) - len(old), 0))
    return caller.budget.allocate_text(owner.replace(*values, **named))


def _join(caller: Caller, owner: str, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    if len(values) != 1 or named:
        raise TypeError(f"str.join() takes exactly one argument ({len(values) + len(named)} given)")
    items = caller.budget.collect(values[0])
    bound_length(sum(len(item) + len(owner) for item in items if isinstance(item, str)))
    return caller.budget.allocate_text(owner.join(items))


def _translate(caller: Caller, owner: str, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    table = values[0] if len(values) == 1 and isinstance(values[0], dict) else None
    if table is None or named:
        raise TypeError("str.translate() takes one argument, a dictionary")
    plain = copied(caller, table)
    chosen = sum(key.__class__ is not str for key in plain)
    caller.budget.spend(len(owner) + (len(owner) * chosen >> 5))
    bound_length(len(owner) * max((len(value) for value in plain.values() if isinstance(value, str)), default=1))
    return caller.budget.allocate_text(owner.translate(plain))


def _format(caller: Caller, owner: str, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    return format_text(caller.budget, owner, values, named)


def _format_map(caller: Caller, owner: str, values: Sequence[Any], named: Mapping[str, Any]) -> str:
    if len(values) != 1 or named or not isinstance(values[0], dict):
        raise TypeError("str.format_map() takes one argument, a dictionary")
    return format_text(caller.budget, owner, (), values[0])


def _growing(name: str) -> _Guarded:
    """Guard a method that extends a list, dictionary or set by its arguments."""

    def call(caller: Caller, owner: Any, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        budget = caller.budget
        takes_several = name in ("extend", "update")
        arguments: list[Any] = [_copied(caller, value) for value in values] if takes_several else list(values)
        length = sum(map(len, arguments)) + len(named) if takes_several else 1
        if not isinstance(owner, list):
            keys = [key for argument in arguments for key in argument] if takes_several else arguments[:1]
            pairs = takes_several and isinstance(owner, dict)
            for count, key in enumerate(keys, len(owner)):
                budget.spend_lookup(key[0] if pairs and isinstance(key, list | tuple) and key else key, count)
        bound_length(len(owner) + length)
        budget.spend(len(owner) >> 8)
        budget.allocate(100 * length)
        return getattr(owner, name)(*arguments, **named)

    return call


def _copied(caller: Caller, items: Any) -> Any:
    return copied(caller, items) if isinstance(items, dict) else caller.budget.collect(items)


def _sort(caller: Caller, owner: list[Any], values: Sequence[Any], named: Mapping[str, Any]) -> None:
    owner[:] = sort(caller, [owner, *values], named)


def _combined(name: str) -> _Guarded:
    """Guard a set method with sets as arguments."""

    def call(caller: Caller, owner: Any, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        sets: list[set[Any]] = [_set_of(caller, value) for value in values]
        caller.budget.spend_keys(owner, *sets)
        caller.budget.spend(len(owner))
        caller.budget.allocate(60 * len(owner))
        return getattr(owner, name)(*sets, **named)

    return call


def _set_of(caller: Caller, items: Iterable[Any]) -> set[Any]:
    result: set[Any] = set()
    for item in caller.budget.collect(items):
        result.add(caller.budget.spend_lookup(item, len(result)))
    caller.budget.allocate(60 * len(result))
    return result


def _named(names: str, make: Callable[[str], _Guarded]) -> dict[str, _Guarded]:
    return {name: make(name) for name in names.split()}


_LENGTH = _named("__len__", _linear_size)
"""Methods that xacro before 1.13.13 allowed: xArm's description has robot_sn.__len__()."""
_SET = {
    **_LENGTH,
    **_named("difference intersection isdisjoint issubset issuperset symmetric_difference union", _combined),
    "copy": _linear_size("copy"),
}
METHODS_OF: dict[type, dict[str, _Guarded]] = {
    str: {
        **_LENGTH,
        **_named(
            "capitalize casefold count endswith find index isalnum isalpha isascii isdecimal isdigit", _linear_size
        ),
        **_named("isidentifier islower isnumeric isprintable isspace istitle isupper lower partition", _linear_size),
        **_named("removeprefix removesuffix split splitlines startswith swapcase title upper", _linear_size),
        **_named(
            "lstrip rfind rindex rpartition rsplit rstrip strip",  # quadratic: searches from the end use no table
            lambda name: _linear_size(name, product=True),
        ),
        **_named("center expandtabs ljust rjust zfill", _padded),
        "format": _format,
        "format_map": _format_map,
        "join": _join,
        "replace": _replace,
        "translate": _translate,
    },
    list: {
        **_LENGTH,
        **_named("count index remove", lambda name: _linear_size(name, deep=True)),
        **_named("clear copy pop reverse", _linear_size),
        **_named("append extend insert", _growing),
        "sort": _sort,
    },
    tuple: {**_LENGTH, **_named("count index", lambda name: _linear_size(name, deep=True))},
    dict: {
        **_LENGTH,
        **_named("clear copy items keys popitem values", _linear_size),
        **_named("get pop", lambda name: _linear_size(name, cost_of_keys=True)),
        **_named("setdefault update", _growing),
    },
    set: {
        **_SET,
        **_named("clear pop", _linear_size),
        **_named("discard remove", lambda name: _linear_size(name, cost_of_keys=True)),
        **_named("add update", _growing),
    },
    frozenset: _SET,
    range: {**_LENGTH, **_named("count index", _linear_size)},
    int: _named("as_integer_ratio bit_length conjugate is_integer", _linear_size),
    float: _named("as_integer_ratio conjugate hex is_integer", _linear_size),
    complex: _named("conjugate", _linear_size),
}
_DATA_OF: dict[type, frozenset[str]] = {
    range: frozenset({"start", "stop", "step"}),
    int: frozenset({"real", "imag", "numerator", "denominator"}),
    float: frozenset({"real", "imag"}),
    complex: frozenset({"real", "imag"}),
}
