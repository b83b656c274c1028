"""Messages from nested values, as `rostopic pub` builds them from YAML; errors name the field."""

import dataclasses
import numbers
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from rosbags.interfaces import Nodetype

from ..errors import MessageError
from .message_fast_path import DURATION, TIME, MessageFastPath, NotFastPathError, dtype_of, number_array
from .type_definitions import fields_of

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_HEADER = "std_msgs/msg/Header"
_TIME_FIELDS = {"secs": "sec", "nsecs": "nanosec", "sec": "sec", "nanosec": "nanosec"}
"""Field names of rospy (secs, nsecs) and of rosbags (sec, nanosec)."""


class MessageBuilder:
    """Builds messages of one type store."""

    def __init__(self, store: "Typestore") -> None:
        self._store = store
        self._fast_path = MessageFastPath(store)

    def message(self, key: str, value: object, now_ns: int) -> object:
        """Build a message of type `key` ('geometry_msgs/msg/Twist') from a dictionary, a list or another message."""
        try:
            return self._fast_path.make(key, value)
        except NotFastPathError:
            return self._message(key, value, now_ns, "")

    def empty(self, key: str) -> object:
        """Build a message with ROS's default in all fields."""
        return self._fast_path.empty(key)

    def _message(self, key: str, value: Any, now_ns: int, path: str) -> Any:
        """Build a message; raises a MessageError that names the field."""
        cls = self._store.types[key]
        fields = fields_of(self._store, key)
        if key in (TIME, DURATION):
            return self._time(key, value, now_ns, path)
        if dataclasses.is_dataclass(value) and not isinstance(value, type):
            if getattr(value, "__msgtype__", None) != key:
                raise MessageError(
                    f"{_field(path)}a {_ros(key)} is needed, got a {_ros(str(getattr(value, '__msgtype__', '?')))}"
                )
            value = {name: getattr(value, _attribute(value, name)) for name, _ in fields}
        if isinstance(value, str):
            if value == "auto" and key == _HEADER:
                value = {"stamp": "now"}
            else:
                raise MessageError(f"{_field(path)}a {_ros(key)} is needed, got {value!r}")
        if isinstance(value, Sequence):
            value = self._from_sequence(key, cast("Sequence[Any]", value), path)
        if not isinstance(value, Mapping):
            raise MessageError(f"{_field(path)}a {_ros(key)} is needed, got {value!r}")
        values = cast("Mapping[str, Any]", value)
        names = [name for name, _ in fields]
        for name in values:
            if name not in names:
                valid_names = ", ".join(repr(n) for n in names) or "none"
                raise MessageError(f"{_field(path)}{_ros(key)} has no field {name!r}; fields here: {valid_names}")
        return cls(
            *(
                self._value(desc, values[name], now_ns, f"{path}.{name}".lstrip("."))
                if name in values
                else self._fast_path.default(desc)()
                for name, desc in fields
            )
        )

    def _from_sequence(self, key: str, value: Sequence[Any], path: str) -> dict[str, Any]:
        names = [name for name, _ in fields_of(self._store, key)]
        if len(value) != len(names):
            expected = ", ".join(names) or "none"
            raise MessageError(
                f"{_field(path)}{_ros(key)} has {len(names)} fields ({expected}), got {len(value)} values"
            )
        return dict(zip(names, value, strict=True))

    def _value(self, desc: Any, value: Any, now_ns: int, path: str) -> Any:
        kind, detail = desc
        if kind == Nodetype.BASE:
            return _scalar(detail[0], value, path)
        if kind == Nodetype.NAME:
            return self._message(detail, {} if value is None else value, now_ns, path)
        inner, count = detail
        if inner[0] == Nodetype.BASE and inner[1][0] != "string":
            result: Any = _numbers(inner[1][0], value, path)
        elif isinstance(value, Sequence) and not isinstance(value, str | bytes):
            elements = cast("Sequence[Any]", value)
            result = [self._value(inner, item, now_ns, f"{path}[{i}]") for i, item in enumerate(elements)]
        else:
            raise MessageError(f"field {path!r} is a list, got {value!r}")
        if kind == Nodetype.ARRAY and len(result) != count:
            raise MessageError(f"field {path!r} has exactly {count} elements, got {len(result)}")
        return result

    def _time(self, key: str, value: Any, now_ns: int, path: str) -> Any:
        cls = self._store.types[key]
        if isinstance(value, str):
            if value != "now" or key != TIME:
                raise MessageError(f"{_field(path)}a time is {{secs, nsecs}}, nanoseconds or 'now', got {value!r}")
            return cls(now_ns // 10**9, now_ns % 10**9)
        if isinstance(value, numbers.Integral):
            return cls(int(value) // 10**9, int(value) % 10**9)
        if hasattr(value, "sec"):
            return cls(int(value.sec), int(value.nanosec))
        if isinstance(value, Sequence) and len(cast("Sequence[Any]", value)) == 2:
            value = dict(zip(("secs", "nsecs"), cast("Sequence[Any]", value), strict=True))
        if not isinstance(value, Mapping):
            raise MessageError(f"{_field(path)}a time is {{secs, nsecs}}, nanoseconds or 'now', got {value!r}")
        parts = {"sec": 0, "nanosec": 0}
        for name, number in cast("Mapping[str, Any]", value).items():
            if name not in _TIME_FIELDS:
                raise MessageError(f"{_field(path)}a time has no field {name!r}; fields here: 'secs', 'nsecs'")
            parts[_TIME_FIELDS[name]] = _scalar("int32" if key == DURATION else "uint32", number, f"{path}.{name}")
        return cls(**parts)


def _scalar(kind: str, value: Any, path: str) -> Any:
    if kind == "string":
        if value is None:  # `{frame_id: }` in YAML
            return ""
        if not isinstance(value, str):
            raise MessageError(f"field {path!r} is a string, got {value!r}; quote it to make it one")
        return value
    if kind == "bool":
        if value not in (True, False):
            raise MessageError(f"field {path!r} is a bool, got {value!r}")
        return bool(value)
    if kind.startswith("float"):
        if not isinstance(value, numbers.Real):
            raise MessageError(f"field {path!r} is a {kind}, got {value!r}")
        return float(value)
    if not isinstance(value, numbers.Integral):
        raise MessageError(f"field {path!r} is a {kind}, got {value!r}")
    limits = np.iinfo(dtype_of(kind))
    if not limits.min <= int(value) <= limits.max:
        raise MessageError(f"field {path!r} is a {kind} ({limits.min} to {limits.max}), got {value}")
    return int(value)


def _numbers(kind: str, value: Any, path: str) -> Any:
    dtype = dtype_of(kind)
    if isinstance(value, str):
        raise MessageError(f"field {path!r} is a list of {kind}, got {value!r}")
    if isinstance(value, bytes | bytearray | memoryview):
        if dtype.itemsize != 1:
            return _refuse(kind, cast("bytes", value), path)
        return np.frombuffer(cast("bytes", value), np.uint8).view(dtype)
    if isinstance(value, np.ndarray):
        return np.ascontiguousarray(value, dtype).reshape(-1)
    if not isinstance(value, Sequence):
        raise MessageError(f"field {path!r} is a list of {kind}, got {value!r}")
    elements = cast("Sequence[Any]", value)
    array = number_array(elements, dtype)
    if array is not None:
        return array
    return np.array([_scalar(kind, item, f"{path}[{i}]") for i, item in enumerate(elements)], dtype)


def _refuse(kind: str, value: object, path: str) -> Any:
    raise MessageError(f"field {path!r} is a list of {kind}, got {type(value).__name__}")


def _attribute(message: Any, name: str) -> str:
    """Attribute of a field: rosbags appends `_` to Python keywords."""
    return name if hasattr(message, name) else f"{name}_"


def _field(path: str) -> str:
    return f"field {path!r}: " if path else ""


def _ros(key: str) -> str:
    return key.replace("/msg/", "/", 1)
