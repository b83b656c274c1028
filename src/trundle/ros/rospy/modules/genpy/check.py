"""Diagnosis of fields whose values do not fit their types, with genpy's messages."""

from typing import Any

from .base import is_simple
from .errors import SerializationError
from .rostime import Duration, Time

_BITS = {
    "byte": 8, "char": 8, "int8": 8, "uint8": 8, "int16": 16, "uint16": 16, "int32": 32, "uint32": 32, "int64": 64,
    "uint64": 64,
}  # fmt: skip
_SIGNED = frozenset({"byte", "int8", "int16", "int32", "int64"})
_NUMPY_NUMBERS = frozenset({
    "float32", "float64", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64",
})  # fmt: skip


def check_type(field_name: str, field_type: str, field_val: Any) -> None:
    """Check a value against a field type.

    Raises:
        SerializationError: it does not fit.
    """
    if is_simple(field_type):
        _check_number(field_name, field_type, field_val)
    elif field_type == "string":
        _check_text(field_name, field_val)
    elif field_type in ("time", "duration"):
        expected = Time if field_type == "time" else Duration
        if not isinstance(field_val, expected):
            raise SerializationError(f"field {field_name} must be of type {expected.__name__}")
    elif field_type.endswith("]"):
        _check_array(field_name, field_type[: field_type.index("[")], field_val)
    else:
        _check_message(field_name, field_type, field_val)


def _check_number(name: str, kind: str, value: Any) -> None:
    if kind in ("float32", "float64"):
        cls = type(value)
        if cls not in (float, int) and not (cls.__module__ == "numpy" and cls.__name__ in _NUMPY_NUMBERS):
            raise SerializationError(f"field {name} must be float type")
    elif kind == "bool":
        if value not in [True, False, 0, 1]:
            raise SerializationError(f"field {name} is not a bool")
    elif kind in _SIGNED:
        if type(value) is not int:
            raise SerializationError(f"field {name} must be an integer type")
        if not -(2 ** (_BITS[kind] - 1)) <= value < 2 ** (_BITS[kind] - 1):
            raise SerializationError(f"field {name} exceeds specified width [{kind}]")
    else:
        if type(value) is not int or value < 0:
            raise SerializationError(f"field {name} must be unsigned integer type")
        if value >= 2 ** _BITS[kind]:
            raise SerializationError(f"field {name} exceeds specified width [{kind}]")


def _check_text(name: str, value: Any) -> None:
    if type(value) is str:
        if not value.isascii():
            raise SerializationError(f"field {name} is a non-ascii string")
    elif type(value) is not bytes:
        raise SerializationError(f"field {name} must be of type bytes or an ascii string")


def _check_array(name: str, kind: str, value: Any) -> None:
    if type(value) in (bytes, str):
        if kind not in ("char", "uint8"):
            raise SerializationError(f"field {name} must be a list or tuple type. Only uint8[] can be a string")
        return
    if type(value) not in (list, tuple):
        raise SerializationError(f"field {name} must be a list or tuple type")
    for item in value:
        check_type(f"{name}[]", kind, item)


def _check_message(name: str, kind: str, value: Any) -> None:
    theirs = getattr(value, "_type", None)
    if theirs is None or not hasattr(value, "_get_types"):
        raise SerializationError(f"field {name} must be of type [{kind}]")
    if theirs in ("std_msgs/Header", "roslib/Header"):
        if kind not in ("Header", "std_msgs/Header", "roslib/Header"):
            raise SerializationError(f"field {name} must be a Header instead of a {theirs}")
    elif theirs != kind:
        raise SerializationError(f"field {name} must be of type {kind} instead of {theirs}")
    for inner, inner_kind in zip(value.__slots__, value._get_types(), strict=True):
        check_type(f"{name}.{inner}", inner_kind, getattr(value, inner))
