"""Text of messages, as YAML."""

from collections.abc import Callable, Iterable
from typing import Any

from .rostime import Time, TVal


def strify_message(
    val: Any,
    indent: str = "",
    time_offset: Time | None = None,
    current_time: Time | None = None,
    field_filter: Callable[[Any], Iterable[str]] | None = None,
    fixed_numeric_width: int | None = None,
) -> str:
    """Text of a message or of a field's value.

    Args:
        val: message, time, number, text or a list of them.
        indent: prefix of each line; a message within another starts on a new line.
        time_offset: times are shown relative to it.
        current_time: not used.
        field_filter: returns the names of the fields to show.
        fixed_numeric_width: width of numbers.
    """
    options = (time_offset, current_time, field_filter, fixed_numeric_width)
    if type(val) in (int, float, bool):
        return _number(val, fixed_numeric_width)
    if isinstance(val, str):
        return _dump(val, default_style='"') if val else "''"
    if isinstance(val, TVal):
        if time_offset is not None and isinstance(val, Time):
            val = val - time_offset
        return _time(val, indent, fixed_numeric_width)
    if type(val) in (list, tuple):
        return _list(val, indent, options)
    if hasattr(val, "_slot_types") and hasattr(val, "__slots__"):
        return _fields(val, indent, options)
    return str(val)


def _number(value: float, width: int | None) -> str:
    if width is None or type(value) is bool:
        return str(value)
    if type(value) is float:
        text = f"{value:.{width}f}"
        return text[: max(text.find("."), width)]
    return f"{value:{width}d}"


def _time(value: TVal, indent: str, width: int | None) -> str:
    if width is not None:
        return f"\n{indent}secs: {value.secs:{width}d}\n{indent}nsecs: {value.nsecs:{width}d}"
    return f"\n{indent}secs: {value.secs}\n{indent}nsecs: {value.nsecs:9d}"


def _list(values: Any, indent: str, options: tuple[Any, ...]) -> str:
    if not values:
        return "[]"
    first = values[0]
    if type(first) in (int, float) and options[-1] is not None:
        return "[" + "".join(strify_message(value, indent, *options) + ", " for value in values).rstrip(", ") + "]"
    if isinstance(first, str):
        text = _dump(values if isinstance(values, list) else list(values))
        return text if text.startswith("[") else "\n" + "\n".join(indent + line for line in text.splitlines())
    if type(first) in (int, float, bool):
        return str(list(values))
    return "\n" + "\n".join(f"{indent}- {strify_message(value, indent + '  ', *options)}" for value in values)


def _fields(message: Any, indent: str, options: tuple[Any, ...]) -> str:
    field_filter = options[2]
    names = message.__slots__ if field_filter is None else list(field_filter(message))
    lines = [
        f"{indent}{name}: {strify_message(_value(message, name, kind), '  ' + indent, *options)}"
        for name, kind in zip(message.__slots__, message._slot_types, strict=True)
        if name in names
    ]
    return ("\n" if indent else "") + "\n".join(lines)


def _value(message: Any, name: str, kind: str) -> Any:
    value = getattr(message, name)
    if isinstance(value, bytes | str) and "uint8[" in kind:
        return list(value if isinstance(value, bytes) else value.encode("latin-1", "replace"))
    return value


def _dump(value: Any, **style: Any) -> str:
    import yaml

    return yaml.dump(value, **style).rstrip("\n")
