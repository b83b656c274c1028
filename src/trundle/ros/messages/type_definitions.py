"""How message types are written down, and the sums over it that peers compare.

Types are named here as rosbags does: 'geometry_msgs/msg/Twist'.
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
"""Types of the library that ROS 1 has no messages for."""
PLACEHOLDER = "structure_needs_at_least_one_member"
"""A field that rosbags puts into empty types because ROS 2 does."""


class TypeDefinitions:
    """Texts and sums of the types of one store."""

    def __init__(self, store: "Typestore", installed: Definitions | None) -> None:
        """Begin; texts of an installed ROS are looked for if asked to."""
        self.own: dict[str, str] = {}
        """Texts of types that did not come from rosbags, which keeps no comments."""
        self._store = store
        self._installed = installed
        self._md5s: dict[str, str] = {}
        self._in_progress: set[str] = set()
        self._definitions: dict[str, str] = {}

    def fields(self, key: str) -> dict[str, str]:
        """Field names with their ROS types, in order."""
        return {name: _type_text(desc) for name, desc in fields_of(self._store, key)}

    def constants(self, key: str) -> dict[str, tuple[str, str]]:
        """Constants in order: name → (type, value as written)."""
        written = constant_texts(self.own.get(key, ""))
        return {
            name: (kind, written.get(name, _constant(value))) for name, kind, value in self._store.fielddefs[key][0]
        }

    def text(self, key: str) -> str:
        """Return the text of a type alone: as installed if that means the same.

        `rosbag check` compares texts, comments included, and not md5 sums.
        """
        if self._installed is not None and (text := self._installed.installed(ros_name(key))) is not None:
            with suppress(MessageError):
                constants, fields = read_type(text, key)
                if (constants, fields) == (self._store.fielddefs[key][0], fields_of(self._store, key)):
                    return text
        if key in self.own:
            return self.own[key]
        lines = [f"{kind} {name}={text}\n" for name, (kind, text) in self.constants(key).items()]
        return "".join([*lines, *(f"{kind} {name}\n" for name, kind in self.fields(key).items())])

    def definition(self, key: str) -> str:
        """Return the text of a type followed by those it depends on, as genmsg writes it."""
        if key not in self._definitions:
            others = self._nested_types(key)
            parts = [f"{_SEPARATOR}{ros_name(other)}\n{self.text(other)}" for other in others]
            self._definitions[key] = "\n".join([self.text(key), *parts])
        return self._definitions[key]

    def md5(self, key: str) -> str:
        """Return the md5 sum over the canonical text of a type.

        Raises:
            MessageError: the type consists of itself.
        """
        if key not in self._md5s:
            if key in self._in_progress:
                raise MessageError(f"the definition of {ros_name(key)} cannot be read: it has itself inside")
            self._in_progress.add(key)
            try:
                self._md5s[key] = _md5sum(self._canonical(key))
            finally:
                self._in_progress.remove(key)
        return self._md5s[key]

    def service_md5(self, request: str, response: str) -> str:
        """Return the md5 sum of a service, given the types of its halves."""
        return _md5sum(self._canonical(request) + self._canonical(response))

    def field_types(self, key: str) -> Iterator[str]:
        """Types that the fields of a type are of."""
        for _, desc in fields_of(self._store, key):
            name = referenced_type(desc)
            if name is not None:
                yield name

    def _nested_types(self, key: str) -> list[str]:
        """Types that a type consists of, each once, as they come."""
        found: dict[str, None] = {}
        waiting = [*self.field_types(key)]
        while waiting:
            name = waiting.pop(0)
            if name not in found:
                found[name] = None
                waiting = [*self.field_types(name), *waiting]
        return list(found)

    def _canonical(self, key: str) -> str:
        """Write the text the md5 sum is taken of: constants, then fields, with types replaced by their own sums."""
        lines = [f"{kind} {name}={text}" for name, (kind, text) in self.constants(key).items()]
        for name, desc in fields_of(self._store, key):
            reference = referenced_type(desc)
            lines.append(f"{_type_text(desc) if reference is None else self.md5(reference)} {name}")
        return "\n".join(lines)


def fields_of(store: "Typestore", key: str) -> list[tuple[str, Any]]:
    """Fields of a type in order, as they are written down."""
    return [field for field in store.fielddefs[key][1] if field[0] != PLACEHOLDER]


def ros_name(key: str) -> str:
    """Name a type as ROS 1 does."""
    return key.replace("/msg/", "/", 1)


def _md5sum(text: str) -> str:
    return hashlib.md5(text.encode()).hexdigest()


def referenced_type(desc: Any) -> str | None:
    """Name the message type a field refers to, itself or as an element; None: numbers, texts and times."""
    kind, detail = desc
    if kind >= 3:
        kind, detail = detail[0]
    return cast(str, detail) if kind == 2 and detail not in BUILTIN else None


def _type_text(desc: Any) -> str:
    """Write a field's type as a .msg file does."""
    kind, detail = desc
    if kind >= 3:
        inner, count = detail
        return f"{_type_text(inner)}[{count if kind == 3 else ''}]"
    return BUILTIN.get(detail, ros_name(detail)) if kind == 2 else cast(str, detail[0])


def _constant(value: object) -> str:
    return str(int(value)) if isinstance(value, bool) else str(value)
