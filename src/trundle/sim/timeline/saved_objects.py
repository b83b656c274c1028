"""Contents of Python objects, restored in place.

The state of plugins, controllers and sensors is in ordinary objects; they need no code to save it. All objects
reachable from some roots are saved: attributes, containers, arrays, random generators, variables of closures.
Identities stay, so references lead to the old contents after a restore.
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
_OBJECT_BYTES = 200
"""Estimated memory of a saved object without arrays."""


class SavedObjects:
    """Contents of every mutable object reachable from some roots."""

    def __init__(
        self,
        roots: Iterable[object],
        *,
        is_outside: Callable[[object], bool],
        is_shared: Callable[[object], bool] = lambda _: False,
    ) -> None:
        """Save.

        Args:
            roots: objects to start from.
            is_outside: True for an object whose contents are not saved, except by its `checkpoint()`, which returns
                a function that restores it.
            is_shared: True for an object that is neither saved nor restored.
        """
        self._restores: list[_Restore] = []
        self.size = 0
        """Bytes of arrays that were copied."""
        self.lost: set[type] = set()
        """Types of objects whose progress cannot be saved, such as generators."""
        self._seen: dict[int, object] = {}  # keeps the objects alive, so that no id is used twice
        waiting = list(roots)
        while waiting:
            obj = waiting.pop()
            if isinstance(obj, _ATOMS) or id(obj) in self._seen or is_shared(obj):
                continue
            self._seen[id(obj)] = obj
            if (checkpoint := getattr(type(obj), "checkpoint", None)) is not None:
                self._restores.append(checkpoint(obj))
            elif not is_outside(obj):
                waiting.extend(self._save(obj))
        self.size += _OBJECT_BYTES * len(self._seen)

    def restore(self) -> None:
        """Restore all contents."""
        for restore in self._restores:
            restore()

    def _save(self, obj: Any) -> Iterable[object]:
        """Save one object; return the objects it refers to."""
        match obj:
            case list() | deque():
                return self._save_sequence(obj)
            case dict():
                return self._save_dict(obj)
            case set():
                members = set(obj)
                self._restores.append(partial(_refill_set, obj, members))
                return members
            case tuple() | frozenset():
                return obj
            case bytearray():
                data = bytes(obj)
                self._restores.append(partial(obj.__setitem__, slice(None), data))
                return ()
            case np.ndarray():
                return self._save_array(obj)
            case random.Random():
                self._restores.append(partial(obj.setstate, obj.getstate()))
                return ()
            case np.random.Generator():
                bits = obj.bit_generator
                self._restores.append(partial(setattr, bits, "state", bits.state))
                return ()
            case MethodType():
                return (obj.__self__,)
            case partial():
                return (obj.func, *obj.args, *obj.keywords.values())
            case FunctionType():
                return [*(obj.__closure__ or ()), *(obj.__defaults__ or ())]
            case CellType():
                return self._save_cell(obj)
            case GeneratorType():
                self.lost.add(type(obj))
                return ()
            case _:
                return self._save_attributes(obj)

    def _save_sequence(self, obj: list[object] | deque[object]) -> Iterable[object]:
        members = tuple(obj)

        def restore() -> None:
            obj.clear()
            obj.extend(members)

        self._restores.append(restore)
        return members

    def _save_dict(self, obj: dict[object, object]) -> Iterable[object]:
        items = dict(obj)

        def restore() -> None:
            if obj.keys() != items.keys() or list(obj) != list(items):
                obj.clear()
            obj.update(items)

        self._restores.append(restore)
        return [*items, *items.values()]

    def _save_array(self, obj: NDArray[Any]) -> Iterable[object]:
        if obj.dtype.hasobject:
            return list(obj.flat)
        if obj.flags.writeable:
            contents = obj.copy()
            self.size += contents.nbytes
            self._restores.append(partial(np.copyto, obj, contents))
        return ()

    def _save_cell(self, obj: CellType) -> Iterable[object]:
        try:
            contents = obj.cell_contents
        except ValueError:  # a closure's variable without a value
            return ()
        self._restores.append(partial(setattr, obj, "cell_contents", contents))
        return (contents,)

    def _save_attributes(self, obj: object) -> Iterable[object]:
        """Save the attributes of an ordinary object, in `__dict__` and slots; those of a frozen one cannot change."""
        references: list[object] = []
        attributes: dict[object, object] | None = getattr(obj, "__dict__", None)
        if isinstance(attributes, dict):
            references.extend(self._save_dict(attributes))
        slots = {name: value for name in _slots(type(obj)) if (value := getattr(obj, name, _MISSING)) is not _MISSING}
        if slots and not _is_frozen(type(obj)):
            self._restores.append(partial(_set_all, obj, slots))
        references.extend(slots.values())
        return references


def _refill_set(obj: set[object], members: set[object]) -> None:
    obj.clear()
    obj.update(members)


def _set_all(obj: object, values: dict[str, object]) -> None:
    for name, value in values.items():
        setattr(obj, name, value)


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
