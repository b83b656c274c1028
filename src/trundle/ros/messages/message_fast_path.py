"""Fast path for well-formed values; anything else raises, and the message builder finds the fault."""

# For pyright: values are of any type.
# pyright: reportUnknownMemberType=false, reportUnknownArgumentType=false, reportUnknownVariableType=false

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype

from .type_definitions import fields_of

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

TIME, DURATION = "builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"
_DTYPES = {"bool": "bool", "byte": "int8", "char": "uint8"}
"""Types that numpy names differently."""

_Make: TypeAlias = Callable[[Any], Any]
_Fields: TypeAlias = list[tuple[str, _Make, Callable[[], Any]]]
"""A field: name, function that makes it from a value, and function that makes ROS's default."""
_MISSING = object()
_NUMBERS = (int, np.float64, np.float32)
"""Real number types besides float that the fast path accepts."""
_CONVERTED = {"f": "iuf", "b": ""}
"""Array kinds convertible to a kind; integers by default."""


class NotFastPathError(Exception):
    """The value is not in the common form; it may still be valid."""


class MessageFastPath:
    """Message makers of one type store, compiled once per type."""

    def __init__(self, store: "Typestore") -> None:
        self._store = store
        self._makers: dict[str, _Make] = {}
        self._defaults: dict[str, Callable[[], Any]] = {}

    def make(self, key: str, value: Any) -> Any:
        """Make a message of type `key` ('geometry_msgs/msg/Twist') from a dictionary, a list or another message.

        Raises:
            NotFastPathError: a value is not in the common form.
        """
        return (self._makers.get(key) or self._compile(key))(value)

    def empty(self, key: str) -> object:
        """Make a message whose fields all have ROS's default."""
        return self._default_maker(key)()

    def default(self, desc: Any) -> Callable[[], Any]:
        """Maker of a field's default."""
        kind, detail = desc
        if kind == Nodetype.BASE:
            value: Any = {"string": "", "bool": False, "float32": 0.0, "float64": 0.0}.get(detail[0], 0)
            return lambda: value
        if kind == Nodetype.NAME:
            return self._default_maker(detail)
        inner, count = detail
        length = count if kind == Nodetype.ARRAY else 0
        if _is_number(inner):
            dtype = dtype_of(inner[1][0])
            return lambda: np.zeros(length, dtype)
        if not length:
            return list
        make = self.default(inner)
        return lambda: [make() for _ in range(length)]

    def _default_maker(self, key: str) -> Callable[[], Any]:
        if key not in self._defaults:
            cls, makers = self._store.types[key], [self.default(desc) for _, desc in fields_of(self._store, key)]
            self._defaults[key] = lambda: cls(*[make() for make in makers])
        return self._defaults[key]

    def _compile(self, key: str) -> _Make:
        """Compile a type; its makers are stored once all are complete, since other threads may use them."""
        makers: dict[str, _Make] = {}
        make = self._maker_of(key, makers)
        self._makers.update(makers)
        return make

    def _maker_of(self, key: str, makers: dict[str, _Make]) -> _Make:
        if key in makers:
            return makers[key]
        cls = self._store.types[key]
        if key in (TIME, DURATION):
            makers[key] = _time_maker(cls)
            return makers[key]
        fields: _Fields = []
        makers[key] = _message_maker(cls, fields)  # before its fields, which may be lists of this type
        for name, desc in fields_of(self._store, key):
            fields.append((name, self._maker(desc, makers), self.default(desc)))
        return makers[key]

    def _maker(self, desc: Any, makers: dict[str, _Make]) -> _Make:
        kind, detail = desc
        if kind == Nodetype.BASE:
            return _scalar_maker(detail[0])
        if kind == Nodetype.NAME:
            return self._maker_of(detail, makers)
        inner, count = detail
        if kind == Nodetype.SEQUENCE:
            count = None
        if _is_number(inner):
            return _array_maker(dtype_of(inner[1][0]), count)
        return _list_maker(self._maker(inner, makers), count)


def dtype_of(kind: str) -> "np.dtype[Any]":
    """numpy dtype of a numeric type."""
    return np.dtype(_DTYPES.get(kind, kind))


def number_array(values: Sequence[object], dtype: "np.dtype[Any]") -> "NDArray[np.generic] | None":
    """Convert a list of plain numbers; None if the elements must be checked one by one."""
    try:
        array = np.array(values)
    except (ValueError, OverflowError):
        return None
    if array.ndim != 1 or array.dtype.kind not in _CONVERTED.get(dtype.kind, "iu"):
        return None
    if array.dtype == dtype:
        return array
    if dtype.kind != "f" and array.size:
        limits = np.iinfo(dtype)
        if array.min() < limits.min or array.max() > limits.max:
            return None
    return array.astype(dtype)


def _is_number(desc: Any) -> bool:
    return desc[0] == Nodetype.BASE and desc[1][0] != "string"


def _message_maker(cls: Any, fields: _Fields) -> _Make:
    def make(value: Any) -> Any:
        kind = type(value)
        if kind is dict:
            unused, arguments = len(value), []
            for name, make_field, default in fields:
                field = value.get(name, _MISSING)
                if field is _MISSING:
                    arguments.append(default())
                else:
                    unused -= 1
                    arguments.append(make_field(field))
            if unused:
                raise NotFastPathError
            return cls(*arguments)
        if (kind is list or kind is tuple) and len(value) == len(fields):
            return cls(*[make_field(field) for (_, make_field, _), field in zip(fields, value, strict=True)])
        if kind is cls:
            return cls(*[make_field(getattr(value, name, _MISSING)) for name, make_field, _ in fields])
        raise NotFastPathError

    return make


def _time_maker(cls: Any) -> _Make:
    def make(value: Any) -> Any:
        if type(value) is int:
            return cls(*divmod(value, 10**9))
        if type(value) is cls:
            return cls(int(value.sec), int(value.nanosec))
        raise NotFastPathError

    return make


def _list_maker(make: _Make, count: int | None) -> _Make:
    def make_all(value: Any) -> Any:
        if (type(value) is list or type(value) is tuple) and (count is None or len(value) == count):
            return [make(item) for item in value]
        raise NotFastPathError

    return make_all


def _array_maker(dtype: "np.dtype[Any]", count: int | None) -> _Make:
    def make(value: Any) -> Any:
        if type(value) is list or type(value) is tuple:
            array = number_array(value, dtype) if value else np.zeros(0, dtype)
        elif type(value) is np.ndarray:
            array = np.ascontiguousarray(value, dtype).reshape(-1)
        elif type(value) is bytes and dtype.itemsize == 1:
            array = np.frombuffer(value, dtype)
        else:
            raise NotFastPathError
        if array is None or (count is not None and len(array) != count):
            raise NotFastPathError
        return array

    return make


def _scalar_maker(kind: str) -> _Make:
    if kind == "string":
        return _make_text
    if kind == "bool":
        return _make_bool
    if kind.startswith("float"):
        return _make_float
    limits = np.iinfo(dtype_of(kind))
    low, high = int(limits.min), int(limits.max)

    def make(value: Any) -> Any:
        if type(value) is int and low <= value <= high:
            return value
        raise NotFastPathError

    return make


def _make_text(value: Any) -> str:
    if type(value) is str:
        return value
    raise NotFastPathError


def _make_bool(value: Any) -> bool:
    if type(value) is bool:
        return value
    raise NotFastPathError


def _make_float(value: Any) -> float:
    if type(value) is float:
        return value
    if type(value) in _NUMBERS:
        try:
            return float(value)
        except OverflowError:
            raise NotFastPathError from None
    raise NotFastPathError
