"""Constants of message types, parsed as genmsg does."""

import re
from typing import TypeAlias

from ..errors import DefinitionError, MessageError

Constant: TypeAlias = tuple[str, str, bool | int | float | str]
"""A constant: name, type and value."""
_LINE = re.compile(
    r"^[ \t]*(?P<type>[A-Za-z0-9_]+)[ \t]+(?P<name>[A-Za-z][A-Za-z0-9_]*)[ \t]*=(?P<value>.*)$", re.MULTILINE
)
_BITS = {f"{sign}int{bits}": bits for sign in ("", "u") for bits in (8, 16, 32, 64)} | {"byte": 8, "char": 8}
_BOOLS = {"true": True, "1": True, "false": False, "0": False}


class _Float(float):
    """A float whose `repr` is a Python expression even if infinite: rosbags generates code from it."""

    def __repr__(self) -> str:
        return f"float({float.__repr__(self)!r})"


def constant_texts(text: str) -> dict[str, str]:
    """Values of constants exactly as written: the md5 sum covers the text, and `1.50` is not `1.5`."""
    return {match["name"]: _text(match) for match in _LINE.finditer(text)}


def read_constant(line: str, number: int) -> Constant | None:
    """Parse a line of a message definition; None if it is not a constant.

    Args:
        line: line without its newline.
        number: line number, for errors.

    Raises:
        DefinitionError: the value does not fit its type.
    """
    match = _LINE.match(line)
    if match is None:
        return None
    try:
        return match["name"], match["type"], _value(match["type"], _text(match))
    except MessageError as error:
        raise DefinitionError(number, str(error)) from None


def _text(match: re.Match[str]) -> str:
    # A string constant extends to the end of the line, '#' included (msg specification).
    value = match["value"]
    return value.strip() if match["type"] == "string" else value.partition("#")[0].strip()


def _value(kind: str, text: str) -> bool | int | float | str:
    try:
        if kind == "string":
            return text
        if kind == "bool":
            return _BOOLS[text.lower()]
        if kind in ("float32", "float64"):
            return _Float(text)
        low, high = _range(kind)
        value = int(text, 0) if text[:2].lower() == "0x" else int(text)
    except (KeyError, ValueError):
        raise MessageError(f"{text[:80]!r} is not a constant of type {kind[:80]}") from None
    if not low <= value <= high:
        raise MessageError(f"{value} is not in the range of {kind}, {low} to {high}")
    return value


def _range(kind: str) -> tuple[int, int]:
    """Minimum and maximum; byte is signed in ROS 1, char unsigned."""
    bits = _BITS[kind]
    return (0, 2**bits - 1) if kind.startswith("u") or kind == "char" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
