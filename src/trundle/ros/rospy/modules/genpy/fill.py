"""Filling messages from YAML values, as `rostopic pub` does."""

import re
from typing import Any

from .errors import MessageException
from .lookup import get_message_class
from .rostime import Time, TVal

_TYPE = re.compile(r"(?P<base>[^\[]+)(?P<array>\[(?P<length>\d*)\])?")
_PRIMITIVES = frozenset({
    "bool", "byte", "char", "string", "float32", "float64", "int8", "uint8", "int16", "uint16", "int32", "uint32",
    "int64", "uint64",
})  # fmt: skip


def fill_message_args(msg: Any, msg_args: Any, keys: dict[str, Any] | None = None) -> None:
    """Fill a message.

    Args:
        msg: message or time to fill.
        msg_args: all values in order, or a list of one dictionary by field names.
        keys: values of times and messages by name, such as 'now'.

    Raises:
        MessageException: a field that does not exist, or too many or few values.
        ValueError: neither a list nor a dictionary.
    """
    msg_args = [] if msg_args is None else msg_args
    if isinstance(msg_args, list | tuple) and len(msg_args) == 1 and isinstance(msg_args[0], dict):
        msg_args = msg_args[0]
    _fill(msg, msg_args, keys or {}, "")


def get_printable_message_args(msg: Any, buff: Any = None, prefix: str = "") -> str:
    """Names of the fields, in nested messages with their paths, separated by spaces."""
    names: list[str] = []
    _collect(msg, prefix, names)
    text = " ".join(names)
    if buff is not None:
        buff.write(text)
    return text


def _collect(msg: Any, prefix: str, names: list[str]) -> None:
    for name in msg.__slots__:
        value = getattr(msg, name)
        if hasattr(value, "_slot_types") and not isinstance(value, TVal):
            _collect(value, f"{prefix}{name}.", names)
        else:
            names.append(f"{prefix}{name}")


def _fill(msg: Any, values: Any, keys: dict[str, Any], prefix: str) -> None:
    if not hasattr(msg, "_slot_types"):
        raise ValueError(f"msg must be a Message instance: {msg}")
    slots = ["secs", "nsecs"] if isinstance(msg, TVal) else msg.__slots__
    if isinstance(values, dict):
        for name, value in values.items():
            _fill_field(msg, slots, name, "" if value is None else value, keys, prefix)
        return
    if not isinstance(values, list | tuple):
        raise ValueError(f"invalid msg_args type: {values}")
    if len(values) != len(slots):
        amount = "Too many" if len(values) > len(slots) else "Not enough"
        raise MessageException(f"{amount} arguments:\n * Given: {values}\n * Expected: {slots}")
    for name, value in zip(slots, values, strict=True):
        _fill_field(msg, slots, name, value, keys, prefix)


def _fill_field(msg: Any, slots: list[str], name: str, value: Any, keys: dict[str, Any], prefix: str) -> None:
    if name not in slots:
        raise MessageException(f"No field name [{prefix}{name}]")
    current = getattr(msg, name)
    if hasattr(current, "_slot_types"):
        if isinstance(value, str):
            if value not in keys:
                raise MessageException(f"No key named [{value}]")
            setattr(msg, name, keys[value])
        elif isinstance(current, TVal) and type(value) is int:
            setattr(msg, name, type(current).from_sec(value / 1e9))
        else:
            _fill(current, value, keys, f"{prefix}{name}.")
    elif isinstance(current, list):
        setattr(msg, name, _items(msg._slot_types[slots.index(name)], value, keys, f"{prefix}{name}"))
    else:
        setattr(msg, name, value)


def _items(type_name: str, values: Any, keys: dict[str, Any], path: str) -> list[Any]:
    if not isinstance(values, list | tuple):
        raise MessageException(f"Field [{path}] must be a list or tuple instead of: {type(values).__name__}")
    match = _TYPE.fullmatch(type_name)
    assert match is not None
    if match["length"] and len(values) != int(match["length"]):
        raise MessageException(f"Field [{path}] has incorrect number of elements: {len(values)} != {match['length']}")
    if match["base"] in _PRIMITIVES:
        return list(values)
    message_class = get_message_class(match["base"])
    if message_class is None:
        raise MessageException(f"Cannot instantiate messages for field [{path}] : cannot load class {match['base']}")
    return [_item(message_class, value, keys, path) for value in values]


def _item(message_class: Any, value: Any, keys: dict[str, Any], path: str) -> Any:
    item = message_class()
    if isinstance(item, TVal) and type(value) is int:
        return type(item).from_sec(value / 1e9)
    if isinstance(item, Time) and isinstance(value, str) and value in keys:
        return keys[value]
    _fill(item, value, keys, f"{path}.")
    return item
