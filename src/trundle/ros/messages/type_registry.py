"""Transactional registration of message types: a type with all its dependencies, or nothing."""

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, cast

from ..errors import DefinitionError, MessageError
from .definition_parser import field_line, read_type
from .definition_search import Definitions
from .type_definitions import TypeDefinitions, referenced_type, ros_name
from .type_sizes import FieldError, TypeSizes

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_NAME = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*", re.ASCII)
_MAX_DEPTH = 100
"""Limit of nested messages, far above real types."""


class UnknownTypeError(MessageError):
    """The type is unknown."""


class TypeRegistry:
    """Registers types of one store from their definitions."""

    def __init__(
        self, store: "Typestore", definitions: Definitions, texts: TypeDefinitions, find: Callable[[str], str]
    ) -> None:
        """Create; `find` returns a known type's rosbags name, registering it if its definition is known."""
        self._store = store
        self._definitions = definitions
        self._texts = texts
        self._find = find
        self._sizes = TypeSizes(store)
        self._added: list[str] = []
        """Types added by the current call."""
        self._depth = 0

    def add(self, type_name: str) -> None:
        """Register a type from its definition.

        Raises:
            MessageError: its definition or a dependency's is invalid; the text names file and line.
        """
        if not _NAME.fullmatch(type_name):
            raise MessageError(f"{type_name[:80]!r} is not a message type; types are written package/Name")
        self._depth += 1
        try:
            self._add(type_name)
            if self._depth == 1:
                self._check(type_name)
        except MessageError:
            if self._depth == 1:
                for key in self._added:
                    del self._store.types[key], self._store.fielddefs[key], self._texts.registered[key]
            raise
        finally:
            self._depth -= 1
            if not self._depth:
                self._added.clear()

    def _add(self, type_name: str) -> None:
        from rosbags.typesys import TypesysError

        text = self._definitions.messages[type_name]
        package, _, name = type_name.partition("/")
        key = f"{package}/msg/{name}"
        try:
            if self._depth > _MAX_DEPTH:
                raise DefinitionError(1, f"more than {_MAX_DEPTH} nested messages")
            constants, fields = read_type(text, key)
            self._store.register({key: (cast("Any", constants), fields)})
        except DefinitionError as error:
            raise MessageError(self._at(type_name, error.line) + str(error)) from None
        except TypesysError as error:
            raise MessageError(self._at(type_name, 1) + str(error)) from None
        self._texts.registered[key] = text
        self._added.append(key)
        for field, desc in fields:
            dependency = referenced_type(desc)
            if dependency is not None:
                try:
                    self._find(dependency)
                except UnknownTypeError as error:
                    raise MessageError(self._at(type_name, field_line(text, field)) + str(error)) from None

    def _check(self, type_name: str) -> None:
        try:
            self._sizes.check(self._find(type_name))
        except FieldError as error:
            name = ros_name(error.key)
            line = field_line(self._definitions.messages.get(name, ""), error.field)
            raise MessageError(self._at(name, line) + str(error)) from None

    def _at(self, type_name: str, line: int) -> str:
        """Prefix of an error message: file and line of a definition, or its type and line."""
        origin = self._definitions.origins.get(type_name)
        if origin is None:
            return f"the definition of {type_name} cannot be read: line {line}: "
        return f"{origin.path}:{origin.line + line - 1}: "
