"""Containers of expressions: creation and subscripting."""

from collections.abc import Iterable
from itertools import islice
from typing import Any

from .values import Caller

_MAX_LISTED_KEYS = 8
_MAX_KEY_LENGTH = 40


class _Message(str):
    """Message of a KeyError, which prints the repr of its key."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def known_keys(owner: dict[object, object]) -> str:
    """List the first keys of a dictionary for the message on a missing key; long keys are left out."""
    first = islice(dict.keys(owner), _MAX_LISTED_KEYS)
    listed = [repr(key) for key in first if isinstance(key, str) and len(key) <= _MAX_KEY_LENGTH]
    rest = ["…"] if len(listed) < len(owner) else []
    return f"; it has {', '.join([*listed, *rest]) or 'none'}"


def set_of(caller: Caller, items: Iterable[object]) -> set[object]:
    """Make a set."""
    result: set[Any] = set()
    caller.budget.allocate(200)
    for item in items:
        caller.budget.allocate(60)
        result.add(caller.budget.spend_lookup(item, len(result)))
    return result


def mapping_of(caller: Caller, value: object) -> dict[str, object]:
    """Return the arguments of `**value`."""
    if not isinstance(value, dict):
        raise TypeError(f"argument after ** must be a mapping, not {type(value).__name__}")
    return copied(caller, value)


def copied(caller: Caller, value: dict[Any, Any]) -> dict[Any, Any]:
    """Copy a dictionary as a plain one."""
    caller.budget.spend_keys(dict.keys(value))
    caller.budget.spend(len(value))
    caller.budget.allocate(100 * len(value))
    return dict(dict.items(value))


def item_of(caller: Caller, owner: Any, index: Any) -> Any:
    """Return `owner[index]`."""
    if not isinstance(owner, str | list | tuple | dict | range):
        raise TypeError(f"{type(owner).__name__!r} object is not subscriptable")
    if isinstance(owner, dict):
        caller.budget.spend_lookup(index, len(owner))
        if index not in owner:
            raise KeyError(_Message(f"the dictionary has no key {index!r}{known_keys(owner)}"))
        return owner[index]
    result = owner[index]
    if isinstance(index, slice) and isinstance(result, str):
        caller.budget.allocate_text(result)
    elif isinstance(index, slice):
        caller.budget.spend(len(result) >> 5)
        caller.budget.allocate(60 if isinstance(result, range) else 60 + 8 * len(result))
    return result
