"""Parser of message definitions: constants and fields in rosbags' form."""

import re
from typing import Any

from ..errors import DefinitionError
from .constants import Constant, read_constant
from .definition_search import MAX_CHARACTERS

MAX_ELEMENTS = 1_000_000_000
"""Maximum array length: one byte per element of the largest message."""
_MAX_FIELDS = 5_000
_FIELD = re.compile(
    r"(?P<type>[A-Za-z]\w*(?:/[A-Za-z]\w*){0,2})(?:<=(?P<max_length>\d{1,9}))?"
    r"(?P<list>\[(?P<bound><=)?(?P<count>-?\d*)\])?[ \t]+(?P<name>[A-Za-z]\w*)",
    re.ASCII,
)
_NUMBERS = (*(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)), "float32", "float64")
_BASE = frozenset({"bool", "byte", "char", "string", *_NUMBERS})
_ALIASES = {
    "time": "builtin_interfaces/msg/Time",
    "duration": "builtin_interfaces/msg/Duration",
    "Header": "std_msgs/msg/Header",
}


def read_type(text: str, key: str) -> tuple[list[Constant], list[tuple[str, Any]]]:
    """Parse a message definition without dependencies: its constants, and its fields in rosbags' form.

    Args:
        text: content of a .msg file.
        key: type's name in rosbags' form.

    Raises:
        DefinitionError: the text is invalid; the error names the line.
    """
    if len(text) > MAX_CHARACTERS:
        raise DefinitionError(1, f"longer than the limit of {MAX_CHARACTERS} characters")
    constants: list[Constant] = []
    fields: list[tuple[str, Any]] = []
    names: dict[str, int] = {}
    for number, line in enumerate(text.split("\n"), 1):
        constant = read_constant(line, number)
        declaration = line.partition("#")[0].strip()
        if constant is not None:
            constants.append(constant)
        elif declaration:
            fields.append(_read_field(declaration, key.rpartition("/")[0], number))
        else:
            continue
        name = constant[0] if constant is not None else fields[-1][0]
        if names.setdefault(name, number) != number:
            raise DefinitionError(number, f"duplicate name {name[:80]!r}; line {names[name]} defines it first")
        if len(names) > _MAX_FIELDS:
            raise DefinitionError(number, f"more than {_MAX_FIELDS} fields and constants")
    return constants, fields


def field_line(text: str, name: str) -> int:
    """Line number of a field; 1 if there is no such field."""
    for number, line in enumerate(text.split("\n"), 1):
        field = _FIELD.fullmatch(line.partition("#")[0].strip())
        if field is not None and field["name"] == name:
            return number
    return 1


def _read_field(line: str, package: str, number: int) -> tuple[str, Any]:
    from rosbags.interfaces import Nodetype

    field = _FIELD.fullmatch(line)
    if field is None:
        raise DefinitionError(
            number, f"not a field: {line[:80]!r}; fields are written TYPE NAME, like float64 x or int32[3] x"
        )
    kind = field["type"]
    inner: Any
    if kind in _BASE:
        inner = (Nodetype.BASE, (kind, int(field["max_length"] or 0)))
    else:
        owner, slash, name = kind.rpartition("/")
        owner = package if not slash else owner if owner.endswith("/msg") else f"{owner}/msg"
        inner = (Nodetype.NAME, _ALIASES.get(kind, f"{owner}/{name}"))
    if field["list"] is None:
        return field["name"], inner
    count = field["count"]
    if count.startswith("-") or len(count) > len(str(MAX_ELEMENTS)) or int(count or 0) > MAX_ELEMENTS:
        raise DefinitionError(number, f"an array has from 0 to {MAX_ELEMENTS} elements, not {count[:40]}")
    if field["bound"] or not count:
        return field["name"], (Nodetype.SEQUENCE, (inner, int(count or 0)))
    return field["name"], (Nodetype.ARRAY, (inner, int(count)))
