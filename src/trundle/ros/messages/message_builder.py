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

    def message(self, key: str, given: object, now_ns: int) -> object:
        """Build a message of type `key` ('geometry_msgs/msg/Twist') from a dictionary, a list or another message."""
        try:
            return self._fast_path.make(key, given)
        except NotFastPathError:
            return self._message(key, given, now_ns, "")

    def empty(self, key: str) -> object:
        """Build a message with ROS's default in all fields."""
        return self._fast_path.empty(key)

    def _message(self, key: str, given: Any, now_ns: int, path: str) -> Any:
        """Build a message; raises a MessageError that names the field."""
        cls = self._store.types[key]
        fields = fields_of(self._store, key)
        if key in (TIME, DURATION):
            return self._time(key, given, now_ns, path)
        if dataclasses.is_dataclass(given) and not isinstance(given, type):
            if getattr(given, "__msgtype__", None) != key:
                raise MessageError(
                    f"{_field(path)}a {_ros(key)} is needed, got a {_ros(str(getattr(given, '__msgtype__', '?')))}"
                )
            given = {name: getattr(given, _attribute(given, name)) for name, _ in fields}
        if isinstance(given, str):
            if given == "auto" and key == _HEADER:
                given = {"stamp": "now"}
            else:
                raise MessageError(f"{_field(path)}a {_ros(key)} is needed, got {given!r}")
        if isinstance(given, Sequence):
            given = self._from_sequence(key, cast("Sequence[Any]", given), path)
        if not isinstance(given, Mapping):
            raise MessageError(f"{_field(path)}a {_ros(key)} is needed, got {given!r}")
        values = cast("Mapping[str, Any]", given)
        names = [name for name, _ in fields]
        for name in values:
            if name not in names:
                there = ", ".join(repr(n) for n in names) or "none"
                raise MessageError(f"{_field(path)}{_ros(key)} has no field {name!r}; fields here: {there}")
        return cls(
            *(
                self._value(desc, values[name], now_ns, f"{path}.{name}".lstrip("."))
                if name in values
                else self._fast_path.default(desc)()
                for name, desc in fields
            )
        )

    def _from_sequence(self, key: str, given: Sequence[Any], path: str) -> dict[str, Any]:
        names = [name for name, _ in fields_of(self._store, key)]
        if len(given) != len(names):
            expected = ", ".join(names) or "none"
            raise MessageError(
                f"{_field(path)}{_ros(key)} has {len(names)} fields ({expected}), got {len(given)} values"
            )
        return dict(zip(names, given, strict=True))

    def _value(self, desc: Any, given: Any, now_ns: int, path: str) -> Any:
        kind, detail = desc
        if kind == Nodetype.BASE:
            return _scalar(detail[0], given, path)
        if kind == Nodetype.NAME:
            return self._message(detail, {} if given is None else given, now_ns, path)
        inner, count = detail
        if inner[0] == Nodetype.BASE and inner[1][0] != "string":
            value: Any = _numbers(inner[1][0], given, path)
        elif isinstance(given, Sequence) and not isinstance(given, str | bytes):
            elements = cast("Sequence[Any]", given)
            value = [self._value(inner, item, now_ns, f"{path}[{i}]") for i, item in enumerate(elements)]
        else:
            raise MessageError(f"field {path!r} is a list, got {given!r}")
        if kind == Nodetype.ARRAY and len(value) != count:
            raise MessageError(f"field {path!r} has exactly {count} elements, got {len(value)}")
        return value

    def _time(self, key: str, given: Any, now_ns: int, path: str) -> Any:
        cls = self._store.types[key]
        if isinstance(given, str):
            if given != "now" or key != TIME:
                raise MessageError(f"{_field(path)}a time is {{secs, nsecs}}, nanoseconds or 'now', got {given!r}")
            return cls(now_ns // 10**9, now_ns % 10**9)
        if isinstance(given, numbers.Integral):
            return cls(int(given) // 10**9, int(given) % 10**9)
        if hasattr(given, "sec"):
            return cls(int(given.sec), int(given.nanosec))
        if isinstance(given, Sequence) and len(cast("Sequence[Any]", given)) == 2:
            given = dict(zip(("secs", "nsecs"), cast("Sequence[Any]", given), strict=True))
        if not isinstance(given, Mapping):
            raise MessageError(f"{_field(path)}a time is {{secs, nsecs}}, nanoseconds or 'now', got {given!r}")
        parts = {"sec": 0, "nanosec": 0}
        for name, value in cast("Mapping[str, Any]", given).items():
            if name not in _TIME_FIELDS:
                raise MessageError(f"{_field(path)}a time has no field {name!r}; fields here: 'secs', 'nsecs'")
            parts[_TIME_FIELDS[name]] = _scalar("int32" if key == DURATION else "uint32", value, f"{path}.{name}")
        return cls(**parts)


def _scalar(kind: str, given: Any, path: str) -> Any:
    if kind == "string":
        if given is None:  # `{frame_id: }` in YAML
            return ""
        if not isinstance(given, str):
            raise MessageError(f"field {path!r} is a string, got {given!r}; quote it to make it one")
        return given
    if kind == "bool":
        if given not in (True, False):
            raise MessageError(f"field {path!r} is a bool, got {given!r}")
        return bool(given)
    if kind.startswith("float"):
        if not isinstance(given, numbers.Real):
            raise MessageError(f"field {path!r} is a {kind}, got {given!r}")
        return float(given)
    if not isinstance(given, numbers.Integral):
        raise MessageError(f"field {path!r} is a {kind}, got {given!r}")
    limits = np.iinfo(dtype_of(kind))
    if not limits.min <= int(given) <= limits.max:
        raise MessageError(f"field {path!r} is a {kind} ({limits.min} to {limits.max}), got {given}")
    return int(given)


def _numbers(kind: str, given: Any, path: str) -> Any:
    dtype = dtype_of(kind)
    if isinstance(given, str):
        raise MessageError(f"field {path!r} is a list of {kind}, got {given!r}")
    if isinstance(given, bytes | bytearray | memoryview):
        if dtype.itemsize != 1:
            return _refuse(kind, cast("bytes", given), path)
        return np.frombuffer(cast("bytes", given), np.uint8).view(dtype)
    if isinstance(given, np.ndarray):
        return np.ascontiguousarray(given, dtype).reshape(-1)
    if not isinstance(given, Sequence):
        raise MessageError(f"field {path!r} is a list of {kind}, got {given!r}")
    elements = cast("Sequence[Any]", given)
    quick = number_array(elements, dtype)
    if quick is not None:
        return quick
    return np.array([_scalar(kind, item, f"{path}[{i}]") for i, item in enumerate(elements)], dtype)


def _refuse(kind: str, given: object, path: str) -> Any:
    raise MessageError(f"field {path!r} is a list of {kind}, got {type(given).__name__}")


def _attribute(message: Any, name: str) -> str:
    """Attribute of a field: rosbags appends `_` to Python keywords."""
    return name if hasattr(message, name) else f"{name}_"


def _field(path: str) -> str:
    return f"field {path!r}: " if path else ""


def _ros(key: str) -> str:
    return key.replace("/msg/", "/", 1)
