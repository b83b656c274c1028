"""Messages ↔ values of JSON, as rosbridge_library maps them.

`uint8[]` and `char[]` are base64, times {secs, nsecs}, and NaN and infinities null.
"""

import binascii
import math
from base64 import standard_b64decode, standard_b64encode
from collections.abc import Callable, Mapping, Sequence
from keyword import iskeyword
from typing import Any, cast

import numpy as np

from trundle.ros import Message, Messages

from .errors import FieldTypeError, NoFieldError

_INTEGERS = frozenset({"int8", "byte", "uint8", "char", "int16", "uint16", "int32", "uint32", "int64", "uint64"})
_FLOATS = frozenset({"float32", "float64"})
_PRIMITIVES = _INTEGERS | _FLOATS | {"bool", "string"}
_TIMES = ("time", "duration")
_BYTES = ("uint8", "char")
_MATCHING_TYPES: dict[type, frozenset[str]] = {
    bool: frozenset({"bool"}),
    int: _INTEGERS | _FLOATS,
    float: _FLOATS,
    str: frozenset({"string"}),
}
"""Python type of a JSON value → matching ROS types."""

_Convert = Callable[[Any], Any]


class JsonEncoder:
    """Messages as JSON values; the fields of a type are looked up once."""

    def __init__(self, messages: Messages) -> None:
        self._messages = messages
        self._converters: dict[str, _Convert] = {}

    def values(self, message: Message, type_name: str) -> dict[str, object]:
        """Return the fields of a message."""
        return self._converter(type_name)(message)

    def _converter(self, kind: str) -> _Convert:
        converter = self._converters.get(kind)
        if converter is None:
            converter = self._converters[kind] = self._make(kind)
        return converter

    def _make(self, kind: str) -> _Convert:
        element, bracket, _ = kind.partition("[")
        if bracket:
            return self._array(element)
        if kind in _TIMES:
            return lambda value: {"secs": int(value.sec), "nsecs": int(value.nanosec)}
        if kind in _FLOATS:
            return lambda value: float(value) if math.isfinite(value) else None
        if kind in _PRIMITIVES:
            return _plain
        fields = [
            (name, f"{name}_" if iskeyword(name) else name, self._converter(field))
            for name, field in self._messages.fields(kind).items()
        ]
        return lambda message: {name: convert(getattr(message, slot)) for name, slot, convert in fields}

    def _array(self, element: str) -> _Convert:
        if element in _BYTES:
            return lambda array: standard_b64encode(np.ascontiguousarray(array, np.uint8).data).decode("ascii")
        if element in _FLOATS:
            return _finite
        if element in _PRIMITIVES:
            return lambda array: array.tolist() if isinstance(array, np.ndarray) else list(array)
        convert = self._converter(element)
        return lambda array: [convert(value) for value in array]


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _finite(array: Any) -> list[float | None]:
    values = np.asarray(array, np.float64)
    if np.isfinite(values).all():
        return values.tolist()
    return [value if math.isfinite(value) else None for value in values.tolist()]


class JsonDecoder:
    """JSON values as fields for `Messages.new`, with rosbridge_library's checks."""

    def __init__(self, messages: Messages) -> None:
        self._messages = messages

    def fields(self, values: object, type_name: str, now_ns: int) -> dict[str, object]:
        """Return the fields of a message; a header without a stamp gets the current time.

        Raises:
            RosbridgeError: a value does not fit.
        """
        return self._object(values, type_name, type_name, (), now_ns)

    def _value(self, value: object, kind: str, root: str, path: tuple[str, ...], now_ns: int) -> Any:
        element, bracket, _ = kind.partition("[")
        if bracket and element in _BYTES:
            return _bytes(value, kind, root, path)
        if bracket:
            if not isinstance(value, list):
                raise FieldTypeError(root, path, kind, value)
            return [self._value(item, element, root, path, now_ns) for item in cast("list[object]", value)]
        if kind in _TIMES:
            return _time(value, kind, root, path, now_ns)
        if kind in _PRIMITIVES:
            if kind not in _MATCHING_TYPES.get(type(value), ()):
                raise FieldTypeError(root, path, kind, value)
            return value
        return self._object(value, kind, root, path, now_ns)

    def _object(self, values: object, kind: str, root: str, path: tuple[str, ...], now_ns: int) -> dict[str, Any]:
        if not isinstance(values, Mapping):
            raise FieldTypeError(root, path, kind, values)
        types = self._messages.fields(kind)
        fields: dict[str, Any] = {"stamp": now_ns} if kind == "std_msgs/Header" else {}
        for name, value in cast("Mapping[str, object]", values).items():
            if name not in types:
                raise NoFieldError(root, (*path, name))
            fields[name] = self._value(value, types[name], root, (*path, name), now_ns)
        return fields


def _bytes(value: object, kind: str, root: str, path: Sequence[str]) -> bytes:
    try:
        if isinstance(value, str):
            return standard_b64decode(value)
        if isinstance(value, list):
            return bytes(cast("list[int]", value))
    except (binascii.Error, ValueError, TypeError):
        pass
    raise FieldTypeError(root, path, kind, value)


def _time(value: object, kind: str, root: str, path: Sequence[str], now_ns: int) -> dict[str, int] | int:
    if value == "now" and kind == "time":
        return now_ns
    if not isinstance(value, Mapping):
        return 0  # as in rosbridge_library
    parts = {name: cast("Mapping[str, object]", value).get(name, 0) for name in ("secs", "nsecs")}
    for name, number in parts.items():
        if not isinstance(number, int):
            raise FieldTypeError(root, (*path, name), "int32", number)
    return cast("dict[str, int]", parts)
