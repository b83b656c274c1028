"""Serialization of one message type: its layout, compiled once, drives the C++ reader and writer."""

from typing import TYPE_CHECKING, Any

from ..errors import MessageError
from ..transport.framing import Pieces

if TYPE_CHECKING:
    from collections.abc import Callable

    from rosbags.typesys.store import Typestore

ENCODING_ERRORS = (AttributeError, BufferError, OverflowError, TypeError, ValueError)
"""Exceptions for a field's value that does not fit its type, and for bytes that are no message."""


class Codec:
    """Serializer and deserializer of one message type."""

    def __init__(self, store: "Typestore", key: str, *, convert: "Callable[[Any], Any]") -> None:
        """Compile the type.

        Args:
            store: type store that holds the type.
            key: type's name in rosbags' form, such as 'std_msgs/msg/String'.
            convert: converts a message to one that can be serialized, or raises a MessageError that names the field.

        Raises:
            MessageError: the type has no layout.
        """
        from .layouts import compile_type  # lazy: imports the C++ module

        self.type = key.replace("/msg/", "/", 1)
        self._native = compile_type(store, key)
        self.exact_frame = self._native.frame
        """`frame` without the conversion: raises one of `ENCODING_ERRORS` instead."""
        self.receive = self._native.receive
        """Receives messages into a stream's buffer; see `FrameDecoder.receive`."""
        self._convert = convert

    def write(self, message: object) -> bytes:
        """Serialize a message.

        Raises:
            MessageError: a field's value does not fit its type; the text names the field.
        """
        try:
            return self._native.write(message)
        except ENCODING_ERRORS:
            return self._converted(message, self._native.write)

    def frame(self, message: object) -> Pieces:
        """Serialize a message with its length prefix: one `bytes`, plus the buffers of long arrays.

        Long arrays (images, maps, point clouds) are not copied.

        Raises:
            MessageError: a field's value does not fit its type; the text names the field.
        """
        try:
            return self._native.frame(message)
        except ENCODING_ERRORS:
            return self._converted(message, self._native.frame)

    def read(self, data: bytes | bytearray | memoryview) -> Any:
        """Deserialize a message; its arrays are views of the data, read-only if the data is.

        Raises:
            MessageError: the bytes are not a message of this type.
        """
        try:
            return self._native.read(data)
        except (BufferError, ValueError) as error:
            raise MessageError(f"{len(data)} bytes are not a {self.type}: {error}") from None

    def _converted(self, message: Any, write: "Callable[[Any], Any]") -> Any:
        """Serialize a message after conversion, such as of lists to numpy arrays."""
        try:
            return write(self._convert(message))
        except ENCODING_ERRORS as error:
            raise MessageError(f"cannot serialize a {self.type}: {error}") from None
