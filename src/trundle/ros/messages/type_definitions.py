"""Definitions of message types and their md5 sums.

Type names here are in rosbags' form: 'geometry_msgs/msg/Twist'.
"""

import hashlib
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any, cast

from ..errors import MessageError
from .constants import constant_texts
from .definition_parser import read_type
from .definition_search import Definitions

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_SEPARATOR = "=" * 80 + "\nMSG: "
BUILTIN = {"builtin_interfaces/msg/Time": "time", "builtin_interfaces/msg/Duration": "duration"}
"""rosbags types that are primitives in ROS 1."""
PLACEHOLDER = "structure_needs_at_least_one_member"
"""Field that rosbags adds to empty types, as ROS 2 does."""


class TypeDefinitions:
    """Definitions and md5 sums of one store's types."""

    def __init__(self, store: "Typestore", installed: Definitions | None) -> None:
        """Create; `installed` supplies the definitions of an installed ROS, if there is one."""
        self.registered: dict[str, str] = {}
        """Definitions as written, of types that do not come from rosbags, which drops comments."""
        self._store = store
        self._installed = installed
        self._md5s: dict[str, str] = {}
        self._definitions: dict[str, str] = {}

    def fields(self, key: str) -> dict[str, str]:
        """Field names → ROS types, in order."""
        return {name: _type_text(desc) for name, desc in fields_of(self._store, key)}

    def constants(self, key: str) -> dict[str, tuple[str, str]]:
        """Constants in order: name → (type, value as written)."""
        written = constant_texts(self.registered.get(key, ""))
        return {
            name: (kind, written.get(name, _constant(value))) for name, kind, value in self._store.fielddefs[key][0]
        }

    def text(self, key: str) -> str:
        """Return the definition of a type without dependencies: the installed one if it differs only in comments.

        `rosbag check` compares definitions including comments, not md5 sums.
        """
        if self._installed is not None and (text := self._installed.installed(ros_name(key))) is not None:
            with suppress(MessageError):
                constants, fields = read_type(text, key)
                if (constants, fields) == (self._store.fielddefs[key][0], fields_of(self._store, key)):
                    return text
        if key in self.registered:
            return self.registered[key]
        lines = [f"{kind} {name}={text}\n" for name, (kind, text) in self.constants(key).items()]
        return "".join([*lines, *(f"{kind} {name}\n" for name, kind in self.fields(key).items())])

    def definition(self, key: str) -> str:
        """Full definition with all dependencies, as genmsg writes it."""
        if key not in self._definitions:
            others = self._nested_types(key)
            parts = [f"{_SEPARATOR}{ros_name(other)}\n{self.text(other)}" for other in others]
            self._definitions[key] = "\n".join([self.text(key), *parts])
        return self._definitions[key]

    def md5(self, key: str) -> str:
        """Return the md5 sum of a type's canonical text.

        Raises:
            MessageError: the type contains itself.
        """
        return self._md5(key, ())

    def service_md5(self, request: str, response: str) -> str:
        """md5 sum of a service, from its request and response types."""
        return _md5sum(self._canonical(request, ()) + self._canonical(response, ()))

    def field_types(self, key: str) -> Iterator[str]:
        """Message types of a type's fields."""
        for _, desc in fields_of(self._store, key):
            name = referenced_type(desc)
            if name is not None:
                yield name

    def _nested_types(self, key: str) -> list[str]:
        """All types that a type contains, each once, in depth-first order."""
        types: dict[str, None] = {}
        pending = [*self.field_types(key)]
        while pending:
            name = pending.pop(0)
            if name not in types:
                types[name] = None
                pending = [*self.field_types(name), *pending]
        return list(types)

    def _md5(self, key: str, containers: tuple[str, ...]) -> str:
        """md5 sum of a type nested in `containers`; thread-safe."""
        if key in containers:
            raise MessageError(f"the definition of {ros_name(key)} is invalid: it contains itself")
        if key not in self._md5s:
            self._md5s[key] = _md5sum(self._canonical(key, (*containers, key)))
        return self._md5s[key]

    def _canonical(self, key: str, containers: tuple[str, ...]) -> str:
        """Canonical text for the md5 sum: constants, then fields, with types replaced by their md5 sums."""
        lines = [f"{kind} {name}={text}" for name, (kind, text) in self.constants(key).items()]
        for name, desc in fields_of(self._store, key):
            reference = referenced_type(desc)
            lines.append(f"{_type_text(desc) if reference is None else self._md5(reference, containers)} {name}")
        return "\n".join(lines)


def fields_of(store: "Typestore", key: str) -> list[tuple[str, object]]:
    """Fields of a type in order, without rosbags' placeholder."""
    return [field for field in store.fielddefs[key][1] if field[0] != PLACEHOLDER]


def ros_name(key: str) -> str:
    """ROS 1 name of a type."""
    return key.replace("/msg/", "/", 1)


def _md5sum(text: str) -> str:
    return hashlib.md5(text.encode()).hexdigest()


def referenced_type(desc: Any) -> str | None:
    """Message type of a field or of its elements; None for primitives."""
    kind, detail = desc
    if kind >= 3:
        kind, detail = detail[0]
    return cast(str, detail) if kind == 2 and detail not in BUILTIN else None


def _type_text(desc: Any) -> str:
    """Type of a field as in a .msg file."""
    kind, detail = desc
    if kind >= 3:
        inner, count = detail
        return f"{_type_text(inner)}[{count if kind == 3 else ''}]"
    return BUILTIN.get(detail, ros_name(detail)) if kind == 2 else cast(str, detail[0])


def _constant(value: object) -> str:
    return str(int(value)) if isinstance(value, bool) else str(value)
