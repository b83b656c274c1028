"""Contents of Python objects, to be put back in place.

What plugins, controllers and sensors remember lies in objects of their own, which know nothing of this. All that can be
reached from some roots is saved: attributes, containers, arrays, random generators, variables of closures. Identities
stay, so a reference to an object leads to its old contents after a restore.
"""

import random
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from types import CellType, FunctionType, GeneratorType, MethodType
from typing import Any, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

_Restore: TypeAlias = Callable[[], None]
_ATOMS = (type(None), bool, int, float, complex, str, bytes, type)
_MISSING = object()
_BYTES_EACH = 200
"""Estimate of what is kept of an object without its arrays."""


class SavedObjects:
    """Contents of every mutable object that some roots lead to."""

    def __init__(
        self,
        roots: Iterable[object],
        *,
        is_outside: Callable[[object], bool],
        is_shared: Callable[[object], bool] = lambda _: False,
    ) -> None:
        """Save.

        Args:
            roots: where to begin.
            is_outside: True of an object that is not looked into; one with a `checkpoint()` that returns a function
                to restore it is saved by that.
            is_shared: True of an object that is left as it is, whatever it has.
        """
        self._restores: list[_Restore] = []
        self.size = 0
        """Bytes of arrays that were copied."""
        self.lost: set[type] = set()
        """Types of objects whose progress cannot be saved, such as generators."""
        self._seen: dict[int, object] = {}  # keeps the objects, so that no id is used twice
        waiting = list(roots)
        while waiting:
            each = waiting.pop()
            if isinstance(each, _ATOMS) or id(each) in self._seen or is_shared(each):
                continue
            self._seen[id(each)] = each
            if (checkpoint := getattr(type(each), "checkpoint", None)) is not None:
                self._restores.append(checkpoint(each))
            elif not is_outside(each):
                waiting.extend(self._save(each))
        self.size += _BYTES_EACH * len(self._seen)

    def restore(self) -> None:
        """Put all contents back."""
        for restore in self._restores:
            restore()

    def _save(self, each: Any) -> Iterable[object]:
        """Save one object; return what it refers to."""
        match each:
            case list() | deque():
                return self._save_sequence(each)
            case dict():
                return self._save_dict(each)
            case set():
                members = set(each)
                self._restores.append(partial(_refill_set, each, members))
                return members
            case tuple() | frozenset():
                return each
            case bytearray():
                data = bytes(each)
                self._restores.append(partial(each.__setitem__, slice(None), data))
                return ()
            case np.ndarray():
                return self._save_array(each)
            case random.Random():
                self._restores.append(partial(each.setstate, each.getstate()))
                return ()
            case np.random.Generator():
                bits = each.bit_generator
                self._restores.append(partial(setattr, bits, "state", bits.state))
                return ()
            case MethodType():
                return (each.__self__,)
            case partial():
                return (each.func, *each.args, *each.keywords.values())
            case FunctionType():
                return [*(each.__closure__ or ()), *(each.__defaults__ or ())]
            case CellType():
                return self._save_cell(each)
            case GeneratorType():
                self.lost.add(type(each))
                return ()
            case _:
                return self._save_attributes(each)

    def _save_sequence(self, each: list[object] | deque[object]) -> Iterable[object]:
        members = tuple(each)

        def restore() -> None:
            each.clear()
            each.extend(members)

        self._restores.append(restore)
        return members

    def _save_dict(self, each: dict[object, object]) -> Iterable[object]:
        items = dict(each)

        def restore() -> None:
            if each.keys() != items.keys() or list(each) != list(items):
                each.clear()
            each.update(items)

        self._restores.append(restore)
        return [*items, *items.values()]

    def _save_array(self, each: NDArray[Any]) -> Iterable[object]:
        if each.dtype.hasobject:
            return list(each.flat)
        if each.flags.writeable:
            contents = each.copy()
            self.size += contents.nbytes
            self._restores.append(partial(np.copyto, each, contents))
        return ()

    def _save_cell(self, each: CellType) -> Iterable[object]:
        try:
            contents = each.cell_contents
        except ValueError:  # empty so far
            return ()
        self._restores.append(partial(setattr, each, "cell_contents", contents))
        return (contents,)

    def _save_attributes(self, each: object) -> Iterable[object]:
        """Save the attributes of an ordinary object, of `__dict__` and slots; those of a frozen one cannot change."""
        found: list[object] = []
        attributes: dict[object, object] | None = getattr(each, "__dict__", None)
        if isinstance(attributes, dict):
            found.extend(self._save_dict(attributes))
        slots = {name: value for name in _slots(type(each)) if (value := getattr(each, name, _MISSING)) is not _MISSING}
        if slots and not _is_frozen(type(each)):
            self._restores.append(partial(_set_all, each, slots))
        found.extend(slots.values())
        return found


def _refill_set(each: set[object], members: set[object]) -> None:
    each.clear()
    each.update(members)


def _set_all(each: object, values: dict[str, object]) -> None:
    for name, value in values.items():
        setattr(each, name, value)


def _slots(kind: type) -> Iterator[str]:
    if issubclass(kind, Struct):
        yield from kind.__struct_fields__
        return
    for base in kind.__mro__:
        names = base.__dict__.get("__slots__", ())
        for name in (names,) if isinstance(names, str) else names:
            if name not in ("__dict__", "__weakref__"):
                yield f"_{base.__name__.lstrip('_')}{name}" if name[:2] == "__" != name[-2:] else name


def _is_frozen(kind: type) -> bool:
    if issubclass(kind, Struct):
        return kind.__struct_config__.frozen
    parameters = getattr(kind, "__dataclass_params__", None)
    return parameters is not None and parameters.frozen
