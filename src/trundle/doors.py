"""Front doors of rooms that open on first use: what a command does not ask for, it does not load."""

import sys
from collections.abc import Callable, Mapping
from importlib import import_module


def opened_on_use(room: str, homes: Mapping[str, str]) -> Callable[[str], object]:
    """Make the `__getattr__` of a room.

    Args:
        room: its name.
        homes: what it lets through → the module it is in.
    """

    def find(name: str) -> object:
        if name not in homes:
            raise AttributeError(f"module {room!r} has no attribute {name!r}")
        found = getattr(import_module(f"{room}.{homes[name]}"), name)
        setattr(sys.modules[room], name, found)
        return found

    return find
