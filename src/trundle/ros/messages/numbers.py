"""Numbers in messages by their paths in plots: `.pose.pose.position.x`, `.ranges[3]`, `.position[left_wheel]`.

Times, strings and headers are left out, and so are long arrays; the limit is lower for arrays of bytes, such as images.
"""

from collections.abc import Iterator
from typing import Any

from msgspec import Struct

from ..errors import MessageError
from .message_library import Messages
from .printing import field_value

_BYTES = ("uint8", "int8", "char", "byte")
_WHOLE = {"bool", "byte", "char"} | {f"{u}int{bits}" for u in ("", "u") for bits in (8, 16, 32, 64)}
_NUMBERS = _WHOLE | {"float32", "float64"}
_MAX_BYTES = 64
_MAX_ELEMENTS = 2000
_MAX_PARTS = 64
"""Limits of the length of arrays of bytes, of other numbers and of messages."""
_MAX_DEPTH = 32
_MAX_LAYOUTS = 16
"""Maximum number of layouts of a type; messages of further layouts are not read."""


class Layout(Struct, frozen=True, eq=False):
    """Numbers of messages whose arrays have the same lengths and names."""

    paths: tuple[str, ...]
    is_held: tuple[bool, ...]
    """True for integers and booleans, which are not interpolated."""


class NumberReader:
    """Reads the numbers of one type's messages."""

    def __init__(self, messages: Messages, type_name: str) -> None:
        """Read the fields of the type.

        Raises:
            MessageError: the type is unknown, or contains itself.
        """
        self._fields = _Fields(messages, type_name)
        self._layouts: dict[tuple[object, ...], Layout] = {}

    def read(self, message: Any) -> tuple[Layout, list[float]] | None:
        """Return a message's layout and numbers; None: it has another layout than the first ones."""
        values: list[float] = []
        shape: list[object] = []
        self._fields.read(message, values, shape)
        key = tuple(shape)
        layout = self._layouts.get(key)
        if layout is None:
            if len(self._layouts) >= _MAX_LAYOUTS:
                return None
            found = list(self._fields.paths(message, ""))
            layout = Layout(tuple(path for path, _ in found), tuple(is_held for _, is_held in found))
            self._layouts[key] = layout
        return layout, values


class _Fields:
    """Fields of a type that are numbers or contain some."""

    def __init__(self, messages: Messages, type_name: str, depth: int = 0) -> None:
        if depth > _MAX_DEPTH:
            raise MessageError(f"the definition of {type_name} is invalid: it contains itself")
        self._numbers: list[tuple[str, bool]] = []
        self._arrays: list[tuple[str, int, bool]] = []
        """Name, limit of the length, and whether the numbers are whole."""
        self._parts: list[tuple[str, _Fields]] = []
        self._lists: list[tuple[str, _Fields]] = []
        fields = messages.fields(type_name)
        self._has_names = fields.get("name") == "string[]"
        for name, kind in fields.items():
            base, bracket, _ = kind.partition("[")
            if base in _NUMBERS and bracket:
                self._arrays.append((name, _MAX_BYTES if base in _BYTES else _MAX_ELEMENTS, base in _WHOLE))
            elif base in _NUMBERS:
                self._numbers.append((name, base in _WHOLE))
            elif base not in ("string", "time", "duration", "Header", "std_msgs/Header"):
                (self._lists if bracket else self._parts).append((name, _Fields(messages, base, depth + 1)))

    def read(self, message: Any, values: list[float], shape: list[object]) -> None:
        """Append a message's numbers, and the lengths and names by which layouts differ."""
        if self._has_names:
            shape.append(tuple(message.name))
        for name, _ in self._numbers:
            values.append(_member(message, name))
        for name, limit, _ in self._arrays:
            array = _member(message, name)
            if len(array) <= limit:
                shape.append(len(array))
                values.extend(array.tolist())
        for name, fields in self._parts:
            fields.read(_member(message, name), values, shape)
        for name, fields in self._lists:
            parts = _member(message, name)
            if len(parts) <= _MAX_PARTS:
                shape.append(len(parts))
                for part in parts:
                    fields.read(part, values, shape)

    def paths(self, message: Any, above: str) -> Iterator[tuple[str, bool]]:
        """Yield the paths in the order of `read`, and whether a number is whole."""
        names: list[str] = list(message.name) if self._has_names else []

        def elements(array: Any) -> Iterator[object]:
            return iter(names if len(names) == len(array) else range(len(array)))

        for name, is_whole in self._numbers:
            yield f"{above}.{name}", is_whole
        for name, limit, is_whole in self._arrays:
            array = _member(message, name)
            if len(array) <= limit:
                yield from ((f"{above}.{name}[{element}]", is_whole) for element in elements(array))
        for name, fields in self._parts:
            yield from fields.paths(_member(message, name), f"{above}.{name}")
        for name, fields in self._lists:
            parts = _member(message, name)
            if len(parts) <= _MAX_PARTS:
                for element, part in zip(elements(parts), parts, strict=True):
                    yield from fields.paths(part, f"{above}.{name}[{element}]")


def _member(message: Any, name: str) -> Any:
    return field_value(message, name)
