"""Messages as CBOR (RFC 8949), number arrays as typed arrays (RFC 8746)."""

import struct
from collections.abc import Callable, Mapping
from keyword import iskeyword
from typing import Any, cast

import numpy as np

from trundle.ros import Message, Messages

_UNSIGNED, _NEGATIVE, _BYTES, _TEXT, _LIST, _MAP, _TAG = range(7)
_FALSE, _TRUE, _NULL, _DOUBLE = 0xF4, 0xF5, 0xF6, 0xFB
_ONE_BYTE, _MAX_INLINE = 24, 23
_TYPED_ARRAYS: dict[str, tuple[int, str]] = {
    "uint16": (69, "<u2"),
    "uint32": (70, "<u4"),
    "uint64": (71, "<u8"),
    "byte": (72, "<i1"),
    "int8": (72, "<i1"),
    "int16": (77, "<i2"),
    "int32": (78, "<i4"),
    "int64": (79, "<i8"),
    "float32": (85, "<f4"),
    "float64": (86, "<f8"),
}
"""ROS type → tag and layout."""
_INTEGERS = frozenset({"byte", "char", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"})


class Tagged:
    """Bytes with a tag."""

    def __init__(self, tag: int, data: bytes) -> None:
        self.tag = tag
        self.data = data


def dump_cbor(value: object) -> bytes:
    """Encode None, numbers, texts, bytes, lists, mappings and `Tagged`."""
    out = bytearray()
    _write(out, value)
    return bytes(out)


def cbor_values(messages: Messages, message: Message, type_name: str) -> dict[str, object]:
    """Return the fields of a message for `dump_cbor`."""
    return {
        name: _field(messages, getattr(message, f"{name}_" if iskeyword(name) else name), kind)
        for name, kind in messages.fields(type_name).items()
    }


def _field(messages: Messages, value: Any, kind: str) -> Any:
    element, bracket, _ = kind.partition("[")
    if bracket:
        return _array(messages, value, element)
    if kind in ("time", "duration"):
        return {"secs": int(value.sec), "nsecs": int(value.nanosec)}
    converters: dict[str, Callable[[Any], Any]] = {"string": str, "bool": bool, "float32": float, "float64": float}
    convert = int if kind in _INTEGERS else converters.get(kind)
    return cbor_values(messages, value, kind) if convert is None else convert(value)


def _array(messages: Messages, value: Any, element: str) -> Any:
    if element in ("uint8", "char"):
        return np.asarray(value, np.uint8).tobytes()
    if element in _TYPED_ARRAYS:
        tag, layout = _TYPED_ARRAYS[element]
        return Tagged(tag, np.asarray(value).astype(layout).tobytes())
    return [_field(messages, item, element) for item in value]


def _head(out: bytearray, major: int, number: int) -> None:
    """Write a major type with its argument."""
    if number <= _MAX_INLINE:
        out.append(major << 5 | number)
        return
    for power in range(4):
        if number < 1 << (8 << power):
            out.append(major << 5 | _ONE_BYTE + power)
            out += number.to_bytes(1 << power, "big")
            return


def _write(out: bytearray, value: object) -> None:
    if value is None or value is True or value is False:
        out.append(_NULL if value is None else _TRUE if value else _FALSE)
    elif isinstance(value, int):
        _head(out, _UNSIGNED if value >= 0 else _NEGATIVE, value if value >= 0 else -1 - value)
    elif isinstance(value, float):
        out.append(_DOUBLE)
        out += struct.pack(">d", value)
    elif isinstance(value, str):
        data = value.encode("utf-8", "replace")
        _head(out, _TEXT, len(data))
        out += data
    elif isinstance(value, bytes | memoryview):
        _head(out, _BYTES, len(value))
        out += value
    elif isinstance(value, Tagged):
        _head(out, _TAG, value.tag)
        _write(out, value.data)
    elif isinstance(value, Mapping):
        items = cast("Mapping[object, object]", value)
        _head(out, _MAP, len(items))
        for name, item in items.items():
            _write(out, name)
            _write(out, item)
    else:
        members = cast("list[object]", value)
        _head(out, _LIST, len(members))
        for item in members:
            _write(out, item)
