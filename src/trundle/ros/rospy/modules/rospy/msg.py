"""Messages from arguments, and their framing for the wire."""

from collections.abc import Mapping, Sequence
from io import BytesIO
from typing import Any

import genpy
from trundle.ros.rospy.message_methods import METHODS, frame

from . import names
from .exceptions import ROSException, ROSSerializationException


class AnyMsg(genpy.Message):
    """A message of any type, as its bytes in `_buff`."""

    _md5sum = _type = names.TOPIC_ANYTYPE
    _has_header = False
    _full_text = ""
    _slot_types: Any = []
    __slots__: Any = ["_buff"]

    def __init__(self, *args: Any) -> None:
        """Create without content.

        Raises:
            ROSException: there are arguments.
        """
        if args:
            raise ROSException("AnyMsg does not accept arguments")
        self._buff: bytes | None = None

    def serialize(self, buff: Any) -> None:
        """Write the bytes.

        Raises:
            ROSException: there are none.
        """
        if self._buff is None:
            raise ROSException("AnyMsg is not initialized")
        buff.write(self._buff)

    def deserialize(self, str_: bytes) -> Any:
        """Store the bytes."""
        self._buff = str_
        return self


def args_kwds_to_message(data_class: Any, args: Sequence[Any], kwds: Mapping[str, Any]) -> Any:
    """Message of a call's arguments: the message itself, or its fields in order or by name.

    Raises:
        TypeError: fields in order and by name, or a message of another type.
    """
    if args and kwds:
        raise TypeError("publish() can be called with arguments or keywords, but not both.")
    if kwds:
        return data_class(**kwds)
    if len(args) == 1:
        (value,) = args
        if getattr(value, "_md5sum", None) == data_class._md5sum or isinstance(value, AnyMsg):
            return value
        if isinstance(value, genpy.Message):
            expected = data_class._slot_types[:1]
            if not expected:
                raise TypeError(f"expected [] but got [{value._type}]")
            if value._type != expected[0]:
                raise TypeError(f"expected [{expected[0]}] but got [{value._type}]")
    return data_class(*args)


def serialize_message(b: Any, seq: int, msg: Any) -> None:
    """Write a message after its length; sets the header's `seq`.

    Raises:
        ROSSerializationException: a field's value does not fit.
    """
    try:
        for piece in framed(seq, msg):
            b.write(piece)
    except genpy.SerializationError as error:
        raise ROSSerializationException(str(error)) from None


def deserialize_messages(
    b: Any, msg_queue: list[Any], data_class: Any, queue_size: int | None = None, max_msgs: int | None = None,
    start: int = 0,
) -> None:  # fmt: skip
    """Read whole messages, each after its length, from a buffer; the rest stays.

    Raises:
        genpy.DeserializationError: bytes that are not a message of the class.
    """
    try:
        end = b.tell()
    except AttributeError as error:
        raise genpy.DeserializationError(f"cannot deserialize: {error}") from None
    data = b.getvalue()[:end]
    offset, contents = start, []
    while len(data) - offset >= 4 and (max_msgs is None or len(contents) < max_msgs):
        size = int.from_bytes(data[offset : offset + 4], "little")
        if len(data) - offset - 4 < size:
            break
        contents.append(data[offset + 4 : offset + 4 + size])
        offset += 4 + size
    if queue_size is not None:
        contents = contents[-queue_size:]
    msg_queue.extend(data_class().deserialize(content) for content in contents)
    if queue_size is not None:
        del msg_queue[:-queue_size]
    b.seek(start)
    b.truncate(start)
    b.write(data[offset:])


def framed(seq: int, msg: Any) -> tuple[bytes | memoryview, ...]:
    """Pieces of a message after its length; sets the header's `seq`.

    Raises:
        genpy.SerializationError: a field's value does not fit.
    """
    if msg._has_header:
        msg.header.seq = seq
        if msg.header.frame_id is None:
            msg.header.frame_id = "0"
    if type(msg).serialize is METHODS["serialize"]:
        return frame(msg)
    buff = BytesIO()
    msg.serialize(buff)
    data = buff.getvalue()
    return len(data).to_bytes(4, "little"), data
