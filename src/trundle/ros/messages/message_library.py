"""ROS 1 message and service types by name: definitions, md5 sums, construction, serialization.

rosbags supplies the types of a desktop installation; it is imported on first use, to keep this module's import cheap.
"""

import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import did_you_mean

from ..errors import MessageError
from .codec import Codec
from .definition_search import Definitions, split_service
from .raw_message import Message, ServiceType, TypedMessage
from .type_definitions import BUILTIN, TypeDefinitions, ros_name
from .type_registry import TypeRegistry, UnknownTypeError

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

    from ..message_types import Time
    from .message_builder import MessageBuilder


class Messages:
    """Store of message types, named as in ROS: 'geometry_msgs/Twist'."""

    def __init__(self, *, bare: bool = False) -> None:
        """Create a store.

        Args:
            bare: True: start empty, such as for a bag, which contains the definitions of its types.
        """
        self._is_bare = bare
        self._definitions = Definitions({}, {}) if bare else Definitions.shipped()
        self._services: dict[str, ServiceType] = {}
        self._codecs: dict[str, Codec] = {}
        self._lock = threading.RLock()
        """Held while types are added: nodes of several threads share a store."""
        self._store_: Typestore | None = None
        self._type_definitions_: TypeDefinitions | None = None
        self._registry_: TypeRegistry | None = None
        self._builder_: MessageBuilder | None = None

    # -- types

    def has(self, type_name: str) -> bool:
        """True if the message type is known."""
        with suppress(MessageError):
            return bool(self._key(type_name))
        return False

    def type(self, type_name: str) -> type[Message]:
        """Class of a type; it needs every field as an argument, unlike `new`."""
        return self._store.types[self._key(type_name)]

    def type_of(self, message: TypedMessage) -> str:
        """Type name of a message."""
        return ros_name(message.__msgtype__)

    def type_names(self) -> list[str]:
        """All message types: rosbags', shipped, published, and on the package path; no requests and responses."""
        with self._lock:
            self._definitions.load_all()
            return self._names()

    def service_names(self) -> list[str]:
        """All service types."""
        with self._lock:
            self._definitions.load_all()
            return sorted(self._definitions.services)

    def fields(self, type_name: str) -> dict[str, str]:
        """Field names → ROS types, in order: {'name': 'string[]', 'stamp': 'time', …}."""
        return self._type_definitions.fields(self._key(type_name))

    def constants(self, type_name: str) -> dict[str, tuple[str, str]]:
        """Constants in order: name → (type, value as written)."""
        return self._type_definitions.constants(self._key(type_name))

    def text(self, type_name: str) -> str:
        """Definition of a type without dependencies; from rosbags, where no ROS is installed, it has no comments."""
        return self._type_definitions.text(self._key(type_name))

    def service_text(self, type_name: str) -> str:
        """Definition of a service type."""
        self.service(type_name)
        return self._definitions.service_text(type_name)

    def add(self, type_name: str, text: str) -> None:
        """Add a message type from its .msg text; known types are kept."""
        if not self.has(type_name):
            with self._lock:
                self._definitions.messages[type_name] = text
                self._registry.add(type_name)

    def add_service(self, type_name: str, text: str) -> None:
        """Add a service type from its .srv text."""
        self._definitions.services.setdefault(type_name, text)

    def add_package(self, name: str, folder: Path) -> None:
        """Add the types of a package; `msg/`, `srv/` and `action/` are read on first use."""
        self._definitions.add_package(name, folder)

    def add_definition(self, type_name: str, definition: str) -> None:
        """Add a type and its dependencies from the full definition in a connection header."""
        text, *dependencies = definition.split("\n" + "=" * 80 + "\n")
        for dependency in dependencies:
            head, _, body = dependency.partition("\n")
            if head.startswith("MSG: ") and not self.has(head[5:].strip()):
                self._definitions.messages.setdefault(head[5:].strip(), body)
        self.add(type_name, text)

    # -- md5 sums and definitions

    def md5(self, type_name: str) -> str:
        """md5 sum of a type's canonical text."""
        return self._type_definitions.md5(self._key(type_name))

    def definition(self, type_name: str) -> str:
        """Full definition with all dependencies, as genmsg writes it."""
        return self._type_definitions.definition(self._key(type_name))

    def service(self, type_name: str) -> ServiceType:
        """Look up a service type.

        Raises:
            MessageError: the type is unknown.
        """
        with self._lock:
            return self._services.get(type_name) or self._read_service(type_name)

    # -- construction and serialization

    def new(self, type_name: str, fields: object = None, *, now_ns: int | None = None) -> Message:
        """Build a message; omitted fields have ROS's default (0, '', empty).

        Args:
            type_name: such as 'geometry_msgs/Twist'.
            fields: name → value, nested; or all values in order, as a list. 'now' is a time, 'auto' a header stamped
                now.
            now_ns: time [ns] for 'now'; wall time by default.

        Raises:
            MessageError: unknown type or field, or a value that does not fit; the text names the field.
        """
        if fields is None:
            return self._builder.empty(self._key(type_name))
        return self._builder.message(self._key(type_name), fields, time.time_ns() if now_ns is None else now_ns)

    def stamp(self, ns: int) -> "Time":
        """Make a `time` value."""
        time_class: Any = self._store.types["builtin_interfaces/msg/Time"]
        return time_class(sec=ns // 10**9, nanosec=ns % 10**9)

    def serialize(self, message: TypedMessage) -> bytes:
        """Serialize a message.

        Raises:
            MessageError: a field's value does not fit its type; the text names the field.
        """
        return self.codec(message.__msgtype__).write(message)

    def deserialize(self, data: bytes | memoryview, type_name: str) -> Message:
        """Deserialize a message; its arrays may be read-only views of the data.

        Raises:
            MessageError: the bytes are not a message of this type.
        """
        return self.codec(type_name).read(data)

    def codec(self, type_name: str) -> Codec:
        """Codec of a type, made on first use."""
        return self._codecs.get(type_name) or self._make_codec(type_name)

    # -- internals

    def _make_codec(self, type_name: str) -> Codec:
        key = self._key(type_name)
        self._codecs[type_name] = Codec(
            self._store, key, convert=lambda message: self._builder.message(key, message, 0)
        )
        return self._codecs[type_name]

    @property
    def _store(self) -> "Typestore":
        if self._store_ is None:
            with self._lock:
                from rosbags.typesys import Stores, get_typestore

                self._store_ = self._store_ or get_typestore(Stores.EMPTY if self._is_bare else Stores.ROS1_NOETIC)
        return self._store_

    @property
    def _type_definitions(self) -> TypeDefinitions:
        with self._lock:
            if self._type_definitions_ is None:
                self._type_definitions_ = TypeDefinitions(self._store, None if self._is_bare else self._definitions)
            return self._type_definitions_

    @property
    def _registry(self) -> TypeRegistry:
        if self._registry_ is None:
            self._registry_ = TypeRegistry(self._store, self._definitions, self._type_definitions, self._key)
        return self._registry_

    @property
    def _builder(self) -> "MessageBuilder":
        if self._builder_ is None:
            from .message_builder import MessageBuilder

            self._builder_ = MessageBuilder(self._store)
        return self._builder_

    def _key(self, type_name: str) -> str:
        """Name of a known type in rosbags' form."""
        package, slash, name = type_name.partition("/")
        key = f"{package}/msg/{name}" if not name.startswith("msg/") else type_name
        if key in self._store.types:
            return key
        definitions = self._definitions
        for load in (definitions.load_package, definitions.load_from_path, definitions.load_published):
            if load == definitions.load_from_path:
                _ = self._definitions.on_path  # a long search, without the lock
            with self._lock:
                load(package)
                if key not in self._store.types and ros_name(key) in self._definitions.messages:
                    self._registry.add(ros_name(key))
                service = ros_name(key).removesuffix("Request").removesuffix("Response")
                if service != ros_name(key) and service in self._definitions.services and service not in self._services:
                    self.service(service)
            if key in self._store.types:
                return key
        if key not in self._store.types:
            if reason := self._definitions.unreadable.get(f"{ros_name(key)}.msg"):
                raise MessageError(reason)
            if not slash:
                raise UnknownTypeError(
                    f"{type_name!r} is not a message type; types are written package/Name, like std_msgs/String"
                )
            names = [other for other in self._names() if other.startswith(f"{package}/")]
            hint = did_you_mean(ros_name(key), names or self._names())
            raise UnknownTypeError(f"no message type {ros_name(key)!r}{hint}{_suggestion('messages', package, names)}")
        return key

    def _names(self) -> list[str]:
        names = {ros_name(key) for key in self._store.types if key not in BUILTIN} | self._definitions.messages.keys()
        of_services = {name for kind in self._services.values() for name in (kind.request, kind.response)}
        return sorted(names - of_services)

    def _read_service(self, type_name: str) -> ServiceType:
        package = type_name.partition("/")[0]
        self._definitions.load_package(package)
        for load in (self._definitions.load_from_path, self._definitions.load_published):
            if type_name not in self._definitions.services:
                load(package)
        text = self._definitions.services.get(type_name)
        if text is None:
            if reason := self._definitions.unreadable.get(f"{type_name}.srv"):
                raise MessageError(reason)
            names = sorted(name for name in self._definitions.services if name.startswith(f"{package}/"))
            hint = did_you_mean(type_name, names or list(self._definitions.services))
            raise MessageError(f"no service type {type_name!r}{hint}{_suggestion('services', package, names)}")
        request, response = f"{type_name}Request", f"{type_name}Response"
        for name, (line, part) in zip((request, response), split_service(text), strict=True):
            self._definitions.add_part(name, part, line, of=type_name)
            self._registry.add(name)
        md5sum = self._type_definitions.service_md5(self._key(request), self._key(response))
        self._services[type_name] = ServiceType(type=type_name, md5sum=md5sum, request=request, response=response)
        return self._services[type_name]


def _suggestion(kind: str, package: str, names: list[str]) -> str:
    if not names:
        return f"; no {kind} of a package {package!r} are known"
    return f"; {kind} of {package}: {', '.join(name.partition('/')[2] for name in names[:40])}"
