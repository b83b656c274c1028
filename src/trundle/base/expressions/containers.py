"""Containers of expressions: creation and subscripting."""

from collections.abc import Iterable
from itertools import islice
from typing import Any

from .values import Caller

_KEYS_NAMED = 8
_LONGEST_KEY = 40


class _Sentence(str):
    """Text that a KeyError, which prints the repr of its key, prints as it is."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def known_keys(owner: dict[object, object]) -> str:
    """The first keys of a dictionary, to end the sentence on one that is missing; a long key is left out."""
    first = islice(dict.keys(owner), _KEYS_NAMED)
    named = [repr(key) for key in first if isinstance(key, str) and len(key) <= _LONGEST_KEY]
    rest = ["…"] if len(named) < len(owner) else []
    return f"; it has {', '.join([*named, *rest]) or 'none'}"


def set_of(caller: Caller, items: Iterable[object]) -> set[object]:
    """Make a set."""
    found: set[Any] = set()
    caller.budget.allocate(200)
    for item in items:
        caller.budget.allocate(60)
        found.add(caller.budget.spend_lookup(item, len(found)))
    return found


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
            raise KeyError(_Sentence(f"the dictionary has no key {index!r}{known_keys(owner)}"))
        return owner[index]
    found = owner[index]
    if isinstance(index, slice) and isinstance(found, str):
        caller.budget.allocate_text(found)
    elif isinstance(index, slice):
        caller.budget.spend(len(found) >> 5)
        caller.budget.allocate(60 if isinstance(found, range) else 60 + 8 * len(found))
    return found
