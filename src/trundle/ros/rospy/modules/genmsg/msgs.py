"""Types of fields, and parsed definitions."""

import re
from typing import Any

from .base import SEP, InvalidMsgSpec
from .names import is_legal_resource_name

TIME, DURATION, HEADER = "time", "duration", "Header"
HEADER_FULL_NAME = "std_msgs/Header"
PRIMITIVE_TYPES = [
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64", "string", "bool",
    "char", "byte",
]  # fmt: skip
BUILTIN_TYPES = [*PRIMITIVE_TYPES, TIME, DURATION]
_DIMENSIONS = re.compile(r"(\[[0-9]*\])*")


def bare_msg_type(msg_type: Any) -> Any:
    """Type of an array's elements."""
    return None if msg_type is None else msg_type.partition("[")[0]


def parse_type(msg_type: str) -> tuple[str, bool, int | None]:
    """Element type, whether it is an array, and the array's fixed length.

    Raises:
        ValueError: not a type.
    """
    base, bracket, rest = (msg_type or "").partition("[")
    if not base or (bracket and not rest.endswith("]")):
        raise ValueError(f"Invalid message type [{msg_type}]")
    return base, bool(bracket), int(rest[:-1]) if rest[:-1] else None


def resolve_type(msg_type: str, package_context: str) -> str:
    """Type with its package."""
    bare = bare_msg_type(msg_type)
    if bare in BUILTIN_TYPES or SEP in bare:
        return msg_type
    return msg_type.replace(HEADER, HEADER_FULL_NAME, 1) if bare == HEADER else f"{package_context}{SEP}{msg_type}"


def is_builtin(msg_type_name: str) -> bool:
    """True for types that need no definition."""
    return msg_type_name in BUILTIN_TYPES


def is_header_type(msg_type: str) -> bool:
    """True for headers."""
    return msg_type in (HEADER, HEADER_FULL_NAME, "roslib/Header")


def is_valid_msg_type(msg_type: str) -> bool:
    """True if a string can be a type."""
    base, bracket, rest = msg_type.partition("[")
    return is_legal_resource_name(base) and _DIMENSIONS.fullmatch(bracket + rest) is not None


class Constant:
    """A constant of a message."""

    def __init__(self, type_: str, name: str, val: Any, val_text: str) -> None:
        if type_ is None or name is None or val is None or val_text is None:  # pyright: ignore[reportUnnecessaryComparison]
            raise ValueError("Constant must have non-None parameters")
        self.type, self.name, self.val, self.val_text = type_, name, val, val_text

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Constant) and (self.type, self.name, self.val) == (other.type, other.name, other.val)

    def __repr__(self) -> str:
        return f"{self.type} {self.name}={self.val}"


class Field:
    """A field of a message."""

    def __init__(self, name: str, type: str) -> None:
        self.name, self.type = name, type
        self.base_type, self.is_array, self.array_len = parse_type(type)
        self.is_header = is_header_type(type)
        self.is_builtin = is_builtin(self.base_type)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Field) and (self.name, self.type) == (other.name, other.type)

    def __repr__(self) -> str:
        return f"[{self.name}, {self.type}, {self.base_type}, {self.is_array}, {self.array_len}]"


class MsgSpec:
    """A parsed definition."""

    def __init__(
        self, types: list[str], names: list[str], constants: list[Constant], text: str, full_name: str,
        package: str = "", short_name: str = "",
    ) -> None:  # fmt: skip
        if len(types) != len(names):
            raise InvalidMsgSpec("len of names and types must match")
        self.types, self.names, self.constants, self.text, self.full_name = types, names, constants, text, full_name
        self.package, _, base = full_name.partition(SEP)
        self.package = package or self.package
        self.short_name = short_name or base

    def __eq__(self, other: object) -> bool:
        return isinstance(other, MsgSpec) and vars(self) == vars(other)

    def __repr__(self) -> str:
        lists = [self.constants, self.types, self.names] if self.constants else [self.types, self.names]
        return f"MsgSpec[{', '.join(map(repr, lists))}]"

    def __str__(self) -> str:
        return self.text

    def fields(self) -> list[tuple[str, str]]:
        """Pairs (type, name)."""
        return list(zip(self.types, self.names, strict=True))

    def parsed_fields(self) -> list[Field]:
        """Fields."""
        return [Field(name, kind) for kind, name in self.fields()]

    def has_header(self) -> bool:
        """True if the first field is a header."""
        return bool(self.names) and self.names[0] == "header" and is_header_type(self.types[0])
