"""Containers of expressions: creation and subscripting."""

from collections.abc import Iterable
from typing import Any

from .values import Caller


def set_of(caller: Caller, items: Iterable[object]) -> set[object]:
    """Make a set."""
    found: set[Any] = set()
    caller.budget.allocate(200)
    for item in items:
        caller.budget.allocate(60)
        found.add(caller.budget.spend_lookup(item, len(found)))
    return found


def mapping_of(caller: Caller, value: Any) -> dict[str, Any]:
    """Return the arguments of `**value`."""
    if not isinstance(value, dict):
        raise TypeError(f"argument after ** must be a mapping, not {type(value).__name__}")
    caller.budget.spend(len(value))
    caller.budget.allocate(100 * len(value))
    return {caller.budget.spend_lookup(key, 0): each for key, each in dict.items(value)}


def item_of(caller: Caller, owner: Any, index: Any) -> Any:
    """Return `owner[index]`."""
    if not isinstance(owner, str | list | tuple | dict | range):
        raise TypeError(f"{type(owner).__name__!r} object is not subscriptable")
    if isinstance(owner, dict):
        return owner[caller.budget.spend_lookup(index, len(owner))]
    found = owner[index]
    if isinstance(index, slice) and isinstance(found, str):
        caller.budget.allocate_text(found)
    elif isinstance(index, slice):
        caller.budget.spend(len(found) >> 5)
        caller.budget.allocate(60 if isinstance(found, range) else 60 + 8 * len(found))
    return found
