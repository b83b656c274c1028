"""Makes messages from nested values, as `rostopic pub` does from YAML, and says which field does not fit."""

import dataclasses
import numbers
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from rosbags.interfaces import Nodetype

from .errors import MessageError
from .type_texts import fields_of

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_TIME, _DURATION = "builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"
_HEADER = "std_msgs/msg/Header"
_DTYPES = {"bool": "bool", "byte": "int8", "char": "uint8"}
_TIME_FIELDS = {"secs": "sec", "nsecs": "nanosec", "sec": "sec", "nanosec": "nanosec"}
"""rospy says secs and nsecs, rosbags sec and nanosec; both are understood."""


class Filling:
    """Makes messages of one type store."""

    def __init__(self, store: "Typestore") -> None:
        self._store = store
        self._makers: dict[str, Callable[[], Any]] = {}
        """Type → makes a message of it whose fields all have ROS's default."""

    def message(self, key: str, given: Any, now_ns: int, path: str = "") -> Any:
        """Make a message of type `key` ('geometry_msgs/msg/Twist') from a dictionary, a list or another message."""
        cls = self._store.types[key]
        fields = fields_of(self._store, key)
        if key in (_TIME, _DURATION):
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
            given = self._by_order(key, cast("Sequence[Any]", given), path)
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
                else self._maker(desc)()
                for name, desc in fields
            )
        )

    def fresh(self, key: str) -> Any:
        """Make a message whose fields all have ROS's default."""
        return self._maker_of(key)()

    def _by_order(self, key: str, given: Sequence[Any], path: str) -> dict[str, Any]:
        names = [name for name, _ in fields_of(self._store, key)]
        if len(given) != len(names):
            expected = ", ".join(names) or "none"
            raise MessageError(
                f"{_field(path)}{_ros(key)} has {len(names)} fields ({expected}), got {len(given)} values"
            )
        return dict(zip(names, given, strict=True))

    def _maker_of(self, key: str) -> Callable[[], Any]:
        if key not in self._makers:
            cls, makers = self._store.types[key], [self._maker(desc) for _, desc in fields_of(self._store, key)]
            self._makers[key] = lambda: cls(*[make() for make in makers])
        return self._makers[key]

    def _maker(self, desc: Any) -> Callable[[], Any]:
        """Return what makes the default of a field."""
        kind, detail = desc
        if kind == Nodetype.BASE:
            value: Any = {"string": "", "bool": False, "float32": 0.0, "float64": 0.0}.get(detail[0], 0)
            return lambda: value
        if kind == Nodetype.NAME:
            return self._maker_of(detail)
        inner, count = detail
        length = count if kind == Nodetype.ARRAY else 0
        if inner[0] == Nodetype.BASE and inner[1][0] != "string":
            dtype = _DTYPES.get(inner[1][0], inner[1][0])
            return lambda: np.zeros(length, dtype)
        make = self._maker(inner)
        return lambda: [make() for _ in range(length)]

    def _value(self, desc: Any, given: Any, now_ns: int, path: str) -> Any:
        kind, detail = desc
        if kind == Nodetype.BASE:
            return _scalar(detail[0], given, path)
        if kind == Nodetype.NAME:
            return self.message(detail, {} if given is None else given, now_ns, path)
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
            if given != "now" or key != _TIME:
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
            parts[_TIME_FIELDS[name]] = _scalar("int32" if key == _DURATION else "uint32", value, f"{path}.{name}")
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
    limits = np.iinfo(_DTYPES.get(kind, kind))
    if not limits.min <= int(given) <= limits.max:
        raise MessageError(f"field {path!r} is a {kind} ({limits.min} to {limits.max}), got {given}")
    return int(given)


def _numbers(kind: str, given: Any, path: str) -> Any:
    dtype = np.dtype(_DTYPES.get(kind, kind))
    if isinstance(given, str):
        raise MessageError(f"field {path!r} is a list of {kind}, got {given!r}")
    if isinstance(given, bytes | bytearray | memoryview):
        return np.frombuffer(given, np.uint8).view(dtype) if dtype.itemsize == 1 else _refuse(kind, given, path)
    if isinstance(given, np.ndarray):
        return np.ascontiguousarray(given, dtype).reshape(-1)
    if not isinstance(given, Sequence):
        raise MessageError(f"field {path!r} is a list of {kind}, got {given!r}")
    elements = cast("Sequence[Any]", given)
    quick = _at_once(elements, dtype)
    if quick is not None:
        return quick
    return np.array([_scalar(kind, item, f"{path}[{i}]") for i, item in enumerate(elements)], dtype)


def _at_once(elements: "Sequence[Any]", dtype: "np.dtype[Any]") -> "np.ndarray[Any, Any] | None":
    """Convert a list of plain numbers that fit; None where one by one must say which does not."""
    try:
        array = np.asarray(elements)
    except (ValueError, OverflowError):
        return None
    if array.ndim != 1 or array.dtype.kind not in ("iuf" if dtype.kind == "f" else "iu"):
        return None
    if dtype.kind != "f" and array.size:
        limits = np.iinfo(dtype)
        if array.min() < limits.min or array.max() > limits.max:
            return None
    return array.astype(dtype)


def _refuse(kind: str, given: object, path: str) -> Any:
    raise MessageError(f"field {path!r} is a list of {kind}, got {type(given).__name__}")


def _attribute(message: Any, name: str) -> str:
    """rosbags appends `_` to a field named like a Python keyword."""
    return name if hasattr(message, name) else f"{name}_"


def _field(path: str) -> str:
    return f"field {path!r}: " if path else ""


def _ros(key: str) -> str:
    return key.replace("/msg/", "/", 1)
