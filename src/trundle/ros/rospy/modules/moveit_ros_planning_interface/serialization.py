"""Messages as bytes, as MoveIt's compiled modules take and return them."""

import io
from typing import Any, TypeVar

_Message = TypeVar("_Message")


def to_bytes(message: Any) -> bytes:
    """Serialize a message."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def from_bytes(kind: type[_Message], data: bytes) -> _Message:
    """Build a message of a class from its bytes.

    Raises:
        genpy.DeserializationError: the bytes are not a message of the class.
    """
    message: Any = kind()
    message.deserialize(data)
    return message
