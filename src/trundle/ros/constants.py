"""Constants of message types, read as genmsg reads them."""

import re
from typing import Any, TypeAlias, cast

from .errors import MessageError

Constant: TypeAlias = tuple[str, str, bool | int | float | str]
"""Name, type and value."""
_LINE = re.compile(
    r"^[ \t]*(?P<type>[A-Za-z0-9_]+)[ \t]+(?P<name>[A-Za-z][A-Za-z0-9_]*)[ \t]*=(?P<value>.*)$", re.MULTILINE
)
_BITS = {f"{sign}int{bits}": bits for sign in ("", "u") for bits in (8, 16, 32, 64)} | {"byte": 8, "char": 8}
_TRUTHS = {"true": True, "1": True, "false": False, "0": False}


class _Float(float):
    """A number whose `repr` is one in Python, also if it is infinite: rosbags puts that into code."""

    def __repr__(self) -> str:
        return f"float({float.__repr__(self)!r})"


def constant_texts(text: str) -> dict[str, str]:
    """Values of constants exactly as written: the md5 sum is over the text, and `1.50` is not `1.5`."""
    return {match["name"]: _text(match) for match in _LINE.finditer(text)}


def read_type(text: str, key: str) -> tuple[list[Constant], list[tuple[str, Any]]]:
    """Read a type's own text, without those it depends on: its constants, and its fields as rosbags has them.

    Args:
        text: of a .msg file.
        key: the type's name as rosbags writes it.

    Raises:
        MessageError: it cannot be read; the text says why.
    """
    from rosbags.typesys import TypesysError, get_types_from_msg

    constants = [(match["name"], match["type"], _value(match["type"], _text(match))) for match in _LINE.finditer(text)]
    try:
        fields = get_types_from_msg(_LINE.sub("", text), key)[key][1]
    except (TypesysError, KeyError) as error:
        raise MessageError(str(error)) from None
    return constants, cast("list[tuple[str, Any]]", fields)


def _text(match: re.Match[str]) -> str:
    # Only string constants may hold a '#'; everything up to the end of the line is theirs (msg specification).
    value = match["value"]
    return value.strip() if match["type"] == "string" else value.partition("#")[0].strip()


def _value(kind: str, text: str) -> bool | int | float | str:
    try:
        if kind == "string":
            return text
        if kind == "bool":
            return _TRUTHS[text.lower()]
        if kind in ("float32", "float64"):
            return _Float(text)
        low, high = _range(kind)
        value = int(text, 0) if text[:2].lower() == "0x" else int(text)
    except (KeyError, ValueError):
        raise MessageError(f"{text!r} is no constant of type {kind}") from None
    if not low <= value <= high:
        raise MessageError(f"{value} is no {kind}, which is from {low} to {high}")
    return value


def _range(kind: str) -> tuple[int, int]:
    """Least and greatest; a byte has a sign in ROS 1, a char none."""
    bits = _BITS[kind]
    return (0, 2**bits - 1) if kind.startswith("u") or kind == "char" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
