"""Message definitions parsed as genmsg does: constants, fields, md5 sum, full text."""

import re
from collections.abc import Callable, Iterator
from hashlib import md5
from typing import NamedTuple, TypeAlias

from trundle.ros.errors import DefinitionError
from trundle.ros.messages.constants import constant_texts, read_constant

_FIELD = re.compile(
    r"(?P<base>[A-Za-z]\w*(?:/[A-Za-z]\w*)?)(?P<array>\[\d{0,9}\])?[ \t]+(?P<name>[A-Za-z]\w*)", re.ASCII
)
_NUMBERS = tuple(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64))
PRIMITIVES = frozenset({"bool", "byte", "char", "string", "float32", "float64", "time", "duration", *_NUMBERS})
SEPARATOR = "=" * 80
_MAX_FIELDS = 5_000
_MAX_DEPTH = 100
"""Limit of nested messages, far above real types."""


class Constant(NamedTuple):
    """A constant: name, type, text of the value, value."""

    name: str
    type: str
    text: str
    value: bool | int | float | str


class Field(NamedTuple):
    """A field: name, element type ('float64', 'geometry_msgs/Twist'), and the length of an array."""

    name: str
    base: str
    array: str
    """'' for one value, '[]' or '[3]' for an array."""

    @property
    def type(self) -> str:
        """Type as in `_slot_types`."""
        return self.base + self.array

    @property
    def is_message(self) -> bool:
        """True if the elements are messages."""
        return self.base not in PRIMITIVES

    @property
    def length(self) -> int | None:
        """Length of an array of fixed length."""
        return int(self.array[1:-1]) if len(self.array) > len("[]") else None


class MessageSpec(NamedTuple):
    """A parsed definition."""

    type: str
    text: str
    constants: tuple[Constant, ...]
    fields: tuple[Field, ...]

    @property
    def has_header(self) -> bool:
        """True if the first field is a header named `header`."""
        return bool(self.fields) and self.fields[0] == Field("header", "std_msgs/Header", "")


FindSpec: TypeAlias = Callable[[str], MessageSpec]
"""Returns the definition of a type, or raises MessageError."""


def parse_message(type_name: str, text: str) -> MessageSpec:
    """Parse a .msg definition.

    Raises:
        DefinitionError: the text is invalid; the error names the line.
    """
    constants: list[Constant] = []
    fields: list[Field] = []
    names: set[str] = set()
    written = constant_texts(text)
    for number, line in enumerate(text.split("\n"), 1):
        bare = line.partition("#")[0].strip()
        if (constant := read_constant(line, number)) is not None:
            name, kind, value = constant
            plain = float(value) if isinstance(value, float) else value  # without the parser's own repr
            constants.append(Constant(name, kind, written[name], plain))
        elif bare:
            fields.append(_field(bare, type_name.partition("/")[0], number))
            name = fields[-1].name
        else:
            continue
        if name in names:
            raise DefinitionError(number, f"the name {name[:80]!r} is taken")
        names.add(name)
        if len(names) > _MAX_FIELDS:
            raise DefinitionError(number, f"more than {_MAX_FIELDS} fields and constants")
    return MessageSpec(type_name, text, tuple(constants), tuple(fields))


def md5sum(spec: MessageSpec, find: FindSpec) -> str:
    """md5 sum of a type: constants, then fields, with message types replaced by their md5 sums."""
    return md5(canonical_text(spec, find).encode()).hexdigest()


def canonical_text(spec: MessageSpec, find: FindSpec, depth: int = 0) -> str:
    """Text that the md5 sum covers.

    Raises:
        DefinitionError: the type contains itself.
    """
    if depth > _MAX_DEPTH:
        raise DefinitionError(1, f"{spec.type} contains itself, or nests too many messages")
    lines = [f"{constant.type} {constant.name}={constant.text}" for constant in spec.constants]
    for field in spec.fields:
        if field.is_message:
            field_md5 = md5(canonical_text(find(field.base), find, depth + 1).encode()).hexdigest()
            lines.append(f"{field_md5} {field.name}")
        else:
            lines.append(f"{field.type} {field.name}")
    return "\n".join(lines)


def full_text(spec: MessageSpec, find: FindSpec) -> str:
    """Definition with all dependencies, as in `_full_text` and in connection headers."""
    parts = [f"{SEPARATOR}\nMSG: {other.type}\n{other.text}" for other in _dependencies(spec, find)]
    return "\n".join([spec.text, *parts])


def _dependencies(spec: MessageSpec, find: FindSpec) -> Iterator[MessageSpec]:
    """All types that a type contains, each once, depth first."""
    visited: set[str] = set()
    waiting = [field.base for field in spec.fields if field.is_message]
    while waiting:
        name = waiting.pop(0)
        if name not in visited:
            visited.add(name)
            spec = find(name)
            yield spec
            waiting = [*(field.base for field in spec.fields if field.is_message), *waiting]


def _field(line: str, package: str, number: int) -> Field:
    match = _FIELD.fullmatch(line)
    if match is None:
        raise DefinitionError(
            number, f"not a field: {line[:80]!r}; fields are written TYPE NAME, like float64 x or int32[3] x"
        )
    base = match["base"]
    if base == "Header":
        base = "std_msgs/Header"
    elif base not in PRIMITIVES and "/" not in base:
        base = f"{package}/{base}"
    return Field(match["name"], base, match["array"] or "")
