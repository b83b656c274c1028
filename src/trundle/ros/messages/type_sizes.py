"""Memory of empty messages: limits the sizes that definitions can require."""

from typing import TYPE_CHECKING, Any

from ..transport.headers import MAX_MESSAGE_BYTES
from .type_definitions import fields_of, ros_name

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_OBJECT_BYTES = 64
"""Approximate size of a message, string or list object [bytes]."""
_SMALL = {"bool": 1, "byte": 1, "char": 1, "int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4}


class FieldError(Exception):
    """A field makes its type recursive or too large."""

    def __init__(self, key: str, field: str, reason: str) -> None:
        super().__init__(reason)
        self.key = key
        self.field = field


class TypeSizes:
    """Sizes of one store's types."""

    def __init__(self, store: "Typestore") -> None:
        self._store = store
        self._sizes: dict[str, int] = {}
        self._in_progress: dict[str, str] = {}
        """Types on the current path → the field being visited."""

    def check(self, key: str) -> None:
        """Check a type whose dependencies are registered.

        Raises:
            FieldError: it contains itself, or its empty message exceeds `MAX_MESSAGE_BYTES`.
        """
        try:
            self._size(key)
        finally:
            self._in_progress.clear()

    def _size(self, key: str) -> int:
        if key in self._in_progress:
            chain = [*self._in_progress]
            cycle = " > ".join(ros_name(other) for other in (*chain[chain.index(key) :], key))
            raise FieldError(key, self._in_progress[key], f"{ros_name(key)} contains itself: {cycle}")
        if key not in self._sizes:
            size = _OBJECT_BYTES
            for name, desc in fields_of(self._store, key):
                self._in_progress[key] = name
                size += self._field_size(desc)
                if size > MAX_MESSAGE_BYTES:
                    limit = f"more than the {MAX_MESSAGE_BYTES} of a connection"
                    raise FieldError(key, name, f"a {ros_name(key)} takes {size} bytes when it is empty, {limit}")
            self._in_progress.pop(key, None)
            self._sizes[key] = size
        return self._sizes[key]

    def _field_size(self, desc: Any) -> int:
        kind, detail = desc
        if kind == 3:
            inner, count = detail
            return _OBJECT_BYTES + count * self._field_size(inner)
        if kind == 4:
            self._field_size(detail[0])  # ROS does not allow a list of the message's own type either
            return _OBJECT_BYTES
        if kind == 2:
            return self._size(detail)
        return _OBJECT_BYTES if detail[0] == "string" else _SMALL.get(detail[0], 8)
