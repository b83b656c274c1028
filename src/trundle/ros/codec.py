"""One message type as bytes: what rosbags made for it, called as little as can be."""

import struct
import sys
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from .errors import MessageError
from .frames import untouched

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from rosbags.typesys.store import Typestore

Pieces: TypeAlias = tuple[bytes | memoryview, ...]
"""Bytes that need not lie together."""
_COUNT = struct.Struct("<I")
_LONG_BYTES = 32 * 1024
"""From here on, to copy an array takes longer than to leave it where it is."""
_MISFITS = (AttributeError, TypeError, ValueError, AssertionError, OverflowError, struct.error)
"""Raised by the generated code where a field holds what its type does not."""


class Codec:
    """Writes and reads messages of one type."""

    def __init__(self, store: "Typestore", key: str, *, mend: "Callable[[Any], Any]") -> None:
        """Have all ready: libraries are imported, code is generated.

        Args:
            store: knows the type.
            key: its name, as rosbags writes it.
            mend: makes a message that can be written of one that cannot, or says which field is wrong.
        """
        self.type = key.replace("/msg/", "/", 1)
        self._store = store
        self._kind = store.get_msgdef(key)
        self._mend = mend
        self._array, self._item_bytes, self._behind = _last_array(store, key)

    def write(self, message: Any, *, room: int = 0) -> memoryview:
        """Write a message's bytes, behind `room` bytes that the caller fills in.

        Raises:
            MessageError: a field holds what its type cannot; the text names it.
        """
        try:
            return self._written(message, room)
        except _MISFITS:  # lists where numpy arrays belong, or something wrong
            return self._written(self._mend(message), room)

    def write_pieces(self, message: Any, *, room: int = 0) -> Pieces:
        """As `write`, but a long array stays where it is: a picture, a map, a cloud."""
        if not self._array:
            return (self.write(message, room=room),)
        array: Any = getattr(message, self._array)
        if getattr(array, "nbytes", 0) < _LONG_BYTES or not self._lies_as_written(array):
            return (self.write(message, room=room),)
        without = object.__new__(type(message))  # in a quarter of the time of `dataclasses.replace`
        without.__dict__.update(message.__dict__, **{self._array: array[:0]})
        rest = self.write(without, room=room)
        end = len(rest) - self._behind
        _COUNT.pack_into(rest, end - _COUNT.size, len(array))
        head, pixels = rest[:end], memoryview(array).cast("B").toreadonly()
        return (head, pixels, rest[end:]) if self._behind else (head, pixels)

    def frame(self, message: Any) -> Pieces:
        """Write a message with its length in front, as connections carry it: one `bytes` but for a long array.

        Raises:
            MessageError: a field holds what its type cannot; the text names it.
        """
        first, *others = self.write_pieces(message, room=_COUNT.size)
        _COUNT.pack_into(cast(memoryview, first), 0, len(first) - _COUNT.size + sum(map(len, others)))
        return bytes(first), *others

    def read(self, data: bytes | memoryview) -> Any:
        """Read a message's bytes; its arrays may be read-only views of them.

        Raises:
            MessageError: the bytes are no such message.
        """
        kind = self._kind
        try:
            message, end = kind.deserialize_ros1(data, 0, kind.cls, self._store)
        except Exception as error:  # generated code meets arbitrary bytes here
            raise MessageError(f"{len(data)} bytes are no {self.type}: {error}") from None
        if end != len(data):
            raise MessageError(f"{len(data)} bytes are no {self.type}: it ends after {end}")
        return message

    def _written(self, message: Any, room: int) -> memoryview:
        """As the store's own `serialize_ros1`, which leaves no room: a picture would be copied for its length."""
        kind, store = self._kind, self._store
        size = room + (kind.size_ros1 or kind.getsize_ros1(0, message, store))
        data = memoryview(bytearray(size)) if size < _LONG_BYTES else untouched(size)
        end = kind.serialize_ros1(data, room, message, store)
        assert end == size
        return data

    def _lies_as_written(self, array: Any) -> bool:
        """Whether a numpy array's memory is what goes over the wire."""
        return (
            array.ndim == 1
            and array.itemsize == self._item_bytes
            and array.flags.c_contiguous
            and (array.itemsize == 1 or (array.dtype.isnative and sys.byteorder == "little"))
        )


def _last_array(store: "Typestore", key: str) -> tuple[str, int, int]:
    """Find the number array that nothing of unknown size follows: its field, bytes of an item, bytes behind it."""
    from rosbags.interfaces import Nodetype
    from rosbags.serde.utils import SIZEMAP

    sizes = cast("Mapping[str, int]", SIZEMAP)
    fields = cast("Sequence[tuple[str, Any]]", store.get_msgdef(key).fields)
    behind = 0
    for name, (kind, detail) in reversed(fields):
        if kind == Nodetype.BASE and detail[0] != "string":
            behind += sizes[detail[0]]
            continue
        if kind == Nodetype.SEQUENCE and detail[0][0] == Nodetype.BASE and detail[0][1][0] != "string":
            return name, sizes[detail[0][1][0]], behind
        break
    return "", 0, 0
