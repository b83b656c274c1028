"""Methods of every message class: serialization by the compiled codec.

Values that only Python's `struct` accepts (numpy arrays of other types, ranges, …) are serialized here; errors for
other values are genpy's.
"""

import struct
from typing import Any, BinaryIO

import genpy
from trundle.ros import _message_codec
from trundle.ros.messages.codec import ENCODING_ERRORS

from .message_spec import PRIMITIVES

_NUMBER_FORMATS = {
    "bool": "B", "byte": "b", "char": "B", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
    "uint32": "I", "int64": "q", "uint64": "Q", "float32": "f", "float64": "d",
}  # fmt: skip
_TIME_FORMATS = {"time": "<II", "duration": "<ii"}
_TIME_LAYOUTS = {
    "time": (genpy.Time, [("secs", "uint32", _message_codec.SCALAR, 0), ("nsecs", "uint32", _message_codec.SCALAR, 0)]),
    "duration": (
        genpy.Duration,
        [("secs", "int32", _message_codec.SCALAR, 0), ("nsecs", "int32", _message_codec.SCALAR, 0)],
    ),
}


def codec(cls: Any) -> _message_codec.MessageCodec:
    """Codec of a message class, with arrays as genpy reads them; compiled on first use."""
    compiled = cls.__dict__.get("_codec")
    if compiled is None:
        compiled = cls._codec = _compile(cls, plain_arrays=True)
    return compiled


def numpy_codec(cls: Any) -> _message_codec.MessageCodec:
    """Codec of a message class that reads arrays of numbers as numpy arrays."""
    compiled = cls.__dict__.get("_numpy_codec")
    if compiled is None:
        compiled = cls._numpy_codec = _compile(cls, plain_arrays=False)
    return compiled


def is_plain(cls: Any) -> bool:
    """True if a class has the `serialize` and `deserialize` of this module."""
    return all(getattr(cls, name, None) is METHODS[name] for name in ("serialize", "deserialize"))


def has_only_bytes(cls: Any) -> bool:
    """True if a class is plain and its arrays of numbers are bytes, as in images and point clouds."""
    if not is_plain(cls):
        return False
    fields = cls._spec.fields
    return all(field.base in ("uint8", "char") for field in fields if field.array and field.base in PRIMITIVES) and all(
        has_only_bytes(cls._inner[field.base]) for field in fields if field.is_message
    )


def encode(message: Any) -> bytes:
    """Serialize a message of a generated class.

    Raises:
        genpy.SerializationError: a value does not fit its field; the text names the field.
        AttributeError: a nested message is something else.
    """
    try:
        return codec(type(message)).write(message)
    except ENCODING_ERRORS:
        return _encode_slowly(message)


def frame(message: Any) -> tuple[bytes | memoryview, ...]:
    """Serialize a message with its length prefix; immutable long arrays are not copied.

    Raises:
        genpy.SerializationError, AttributeError: as `encode`.
    """
    try:
        pieces = codec(type(message)).frame(message)
    except ENCODING_ERRORS:
        data = _encode_slowly(message)
        return struct.pack("<I", len(data)), data
    if len(pieces) > 1 and not isinstance(getattr(pieces[1], "obj", None), bytes):
        return (b"".join(pieces),)  # the caller may change its array before the kernel takes it
    return pieces


def _encode_slowly(message: Any) -> bytes:
    parts: list[bytes] = []
    try:
        _write(message, parts)
    except (struct.error, TypeError, ValueError, OverflowError) as error:
        message._check_types(error)
        raise genpy.SerializationError(str(error)) from None
    return b"".join(parts)


def _write(message: Any, parts: list[bytes]) -> None:
    for name, field in zip(message.__slots__, message._spec.fields, strict=True):
        value = getattr(message, name)
        if not field.array:
            _write_one(field.base, value, parts)
            continue
        if field.length is None:
            parts.append(struct.pack("<I", len(value)))
        elif len(value) != field.length:
            raise ValueError(f"{name} has {field.length} elements, not {len(value)}")
        if field.base in _NUMBER_FORMATS and not isinstance(value, bytes):
            parts.append(struct.pack(f"<{len(value)}{_NUMBER_FORMATS[field.base]}", *value))
        elif field.base in _NUMBER_FORMATS:
            parts.append(bytes(value))
        else:
            for item in value:
                _write_one(field.base, item, parts)


def _write_one(base: str, value: Any, parts: list[bytes]) -> None:
    if base in _NUMBER_FORMATS:
        parts.append(struct.pack(f"<{_NUMBER_FORMATS[base]}", value))
    elif base == "string":
        len(value)  # raises TypeError as genpy; other values with a length raise AttributeError
        data = value if isinstance(value, bytes) else value.encode()
        parts += (struct.pack("<I", len(data)), data)
    elif base in _TIME_FORMATS:
        parts.append(struct.pack(_TIME_FORMATS[base], value.secs, value.nsecs))
    elif hasattr(value, "_spec"):
        _write(value, parts)
    else:
        raise TypeError(f"a {base} is needed, not a {type(value).__name__}")


def _compile(cls: Any, *, plain_arrays: bool) -> _message_codec.MessageCodec:
    layouts: dict[str, Any] = {}
    _add_layout(cls, layouts)
    return _message_codec.MessageCodec(list(layouts.values()), plain_arrays=plain_arrays)


def _add_layout(cls: Any, layouts: dict[str, Any]) -> int:
    """Append the layout of a class after its fields' layouts; returns its index."""
    if cls._type in layouts:
        return list(layouts).index(cls._type)
    fields: list[tuple[str, str, int, int]] = []
    for name, field in zip(cls.__slots__, cls._spec.fields, strict=True):
        count = _message_codec.SCALAR
        if field.array:
            count = _message_codec.VARIABLE if field.length is None else field.length
        if field.base in _TIME_LAYOUTS:
            layouts.setdefault(field.base, _TIME_LAYOUTS[field.base])
            fields.append((name, "message", count, list(layouts).index(field.base)))
        elif field.is_message:
            fields.append((name, "message", count, _add_layout(cls._inner[field.base], layouts)))
        else:
            fields.append((name, field.base, count, 0))
    layouts[cls._type] = cls, fields
    return len(layouts) - 1


# The methods, with genpy's parameter names.


def _serialize(self: Any, buff: BinaryIO) -> None:
    """Serialize into a binary file."""
    buff.write(encode(self))


def _serialize_numpy(self: Any, buff: BinaryIO, numpy: object) -> None:
    """Serialize into a binary file; arrays may be numpy's."""
    del numpy
    buff.write(encode(self))


def _deserialize(self: Any, str: bytes) -> Any:
    """Fill the message from its serialized form."""
    return _fill(self, codec(type(self)), str)


def _deserialize_numpy(self: Any, str: bytes, numpy: object) -> Any:
    """Fill the message from its serialized form, with numpy arrays."""
    del numpy
    return _fill(self, numpy_codec(type(self)), str)


def _fill(message: Any, with_codec: _message_codec.MessageCodec, data: bytes) -> Any:
    try:
        other = with_codec.read(data)
    except (BufferError, ValueError) as error:
        raise genpy.DeserializationError(f"{len(data)} bytes are not a {message._type}: {error}") from None
    for name, field in zip(message.__slots__, message._spec.fields, strict=True):
        value: Any = getattr(other, name)
        is_text = field.array and field.base in ("uint8", "char")
        setattr(message, name, bytes(value) if is_text else value)
    return message


def _get_types(self: Any) -> list[str]:
    return self._slot_types


METHODS: dict[str, Any] = {
    "serialize": _serialize,
    "serialize_numpy": _serialize_numpy,
    "deserialize": _deserialize,
    "deserialize_numpy": _deserialize_numpy,
    "_get_types": _get_types,
}
