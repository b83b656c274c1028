"""One message type as bytes: its layout, found once; C++ writes and reads by it."""

from typing import TYPE_CHECKING, Any, TypeAlias

from ..errors import MessageError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosbags.typesys.store import Typestore

Pieces: TypeAlias = tuple[bytes | memoryview, ...]
"""Bytes that need not lie together."""
ENCODING_ERRORS = (AttributeError, BufferError, OverflowError, TypeError, ValueError)
"""Raised where a field holds what its type does not, or bytes are no message."""


class Codec:
    """Writes and reads messages of one type."""

    def __init__(self, store: "Typestore", key: str, *, mend: "Callable[[Any], Any]") -> None:
        """Have all ready.

        Args:
            store: knows the type.
            key: its name, as rosbags writes it.
            mend: makes a message that can be written of one that cannot, or says which field is wrong.

        Raises:
            MessageError: no message can be of this type.
        """
        from .layouts import compile_type  # not where no message is written or read

        self.type = key.replace("/msg/", "/", 1)
        self._program = compile_type(store, key)
        self.exact_frame = self._program.frame
        """As `frame`, but what that would mend or explain raises a `MISFITS`."""
        self.receive = self._program.receive
        """Called with a socket's `recv_into` and room for it; returns a message whose frame came alone, or None, and
        how much came."""
        self._mend = mend

    def write(self, message: Any) -> bytes:
        """Write a message's bytes.

        Raises:
            MessageError: a field holds what its type cannot; the text names it.
        """
        try:
            return self._program.write(message)
        except ENCODING_ERRORS:
            return self._mended(message, self._program.write)

    def frame(self, message: Any) -> Pieces:
        """Write a message with its length in front, as connections carry it: one `bytes` but for a long array.

        Such an array stays where it is: a picture, a map, a cloud.

        Raises:
            MessageError: a field holds what its type cannot; the text names it.
        """
        try:
            return self._program.frame(message)
        except ENCODING_ERRORS:
            return self._mended(message, self._program.frame)

    def read(self, data: bytes | bytearray | memoryview) -> Any:
        """Read a message's bytes; its arrays are views of them, read-only if they are.

        Raises:
            MessageError: the bytes are no such message.
        """
        try:
            return self._program.read(data)
        except (BufferError, ValueError) as error:
            raise MessageError(f"{len(data)} bytes are no {self.type}: {error}") from None

    def _mended(self, message: Any, write: "Callable[[Any], Any]") -> Any:
        """Write a message that has other lists than of plain numbers where numpy arrays belong, or something wrong."""
        try:
            return write(self._mend(message))
        except ENCODING_ERRORS as error:
            raise MessageError(f"no {self.type} can be written: {error}") from None
