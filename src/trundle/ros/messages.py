"""ROS 1 messages and services: types, md5 sums, definition texts, values and bytes.

The library rosbags brings the types of a desktop installation and the serialisation; it is imported when the first
type is asked for, so that importing this module costs nothing.
"""

import hashlib
import struct
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from .errors import MessageError
from .sources import Definitions, constant_texts, split_service

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

    from .filling import Filling

Message: TypeAlias = Any
"""A message object: a dataclass made by rosbags, with the fields of its ROS type. Number arrays are numpy arrays,
`time` and `duration` have `sec` and `nanosec`, a field that is a Python keyword gets a trailing `_`."""

ANY_TYPE = "*"
_SEPARATOR = "=" * 80 + "\nMSG: "
_LONG_BYTES = 64 * 1024
_BUILTIN = {"builtin_interfaces/msg/Time": "time", "builtin_interfaces/msg/Duration": "duration"}


@dataclass(frozen=True, slots=True, kw_only=True)
class RawMessage:
    """A message as it came, for those who only count, store or pass on."""

    type: str
    md5sum: str
    definition: str
    data: bytes
    caller: str = ""
    """Node that published it."""
    latching: bool = False
    """Whether its publisher hands its last message to newcomers."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ServiceType:
    """A service: its name, its md5 sum and the message types of its two halves."""

    type: str
    md5sum: str
    request: str
    response: str


class Messages:
    """All message types a process knows. Types are written as ROS does: 'geometry_msgs/Twist'."""

    def __init__(self, *, bare: bool = False) -> None:
        """Make a store.

        Args:
            bare: know nothing but what is added, as when reading a bag by the definitions in it.
        """
        self._is_bare = bare
        self._definitions = Definitions({}, {}, {}, {}) if bare else Definitions.shipped()
        self._texts: dict[str, str] = {}
        """Definition text of types that did not come from rosbags, which keeps no comments."""
        self._services: dict[str, ServiceType] = {}
        self._md5s: dict[str, str] = {}
        self._definition_texts: dict[str, str] = {}
        self._lock = threading.RLock()
        """Held while types are added: nodes of several threads share one store."""
        self._store_: Typestore | None = None
        self._filling_: Filling | None = None

    # -- types

    def has(self, type_name: str) -> bool:
        """Tell whether a message type is known."""
        try:
            self._key(type_name)
        except MessageError:
            return False
        return True

    def type(self, type_name: str) -> type[Message]:
        """Return the class of a type; it takes every field as an argument, `new` is kinder."""
        return self._store.types[self._key(type_name)]

    def type_of(self, message: Message) -> str:
        """Name the type of a message."""
        return _ros(message.__msgtype__)

    def type_names(self) -> list[str]:
        """Every message type there is: of the library, shipped, and on the package path; those of services left out."""
        with self._lock:
            self._definitions.load_all()
            return self._names()

    def service_names(self) -> list[str]:
        """Every service type there is."""
        with self._lock:
            self._definitions.load_all()
            return sorted(self._definitions.services)

    def fields(self, type_name: str) -> dict[str, str]:
        """Field names with their ROS types, in order: {'name': 'string[]', 'stamp': 'time', …}."""
        return {name: _type_text(desc) for name, desc in fields_of(self._store, self._key(type_name))}

    def constants(self, type_name: str) -> dict[str, tuple[str, str]]:
        """Constants in order: name → (type, value as written)."""
        key = self._key(type_name)
        written = constant_texts(self._texts.get(key, ""))
        return {
            name: (kind, written.get(name, _constant(value))) for name, kind, value in self._store.fielddefs[key][0]
        }

    def text(self, type_name: str) -> str:
        """Return the text of a type alone; of the library's types that no ROS is installed for, without comments."""
        return self._text(self._key(type_name))

    def service_text(self, type_name: str) -> str:
        """Return the text of a service type."""
        self.service(type_name)
        return self._definitions.services[type_name]

    def add(self, type_name: str, text: str) -> None:
        """Add a message type from its .msg text; a type that is already known stays as it is."""
        if not self.has(type_name):
            self._definitions.messages[type_name] = text
            self._register(type_name)

    def add_service(self, type_name: str, text: str) -> None:
        """Add a service type from its .srv text."""
        self._definitions.services.setdefault(type_name, text)

    def add_package(self, name: str, folder: Path) -> None:
        """Add the types of a package; `msg/`, `srv/` and `action/` are read when one is asked for."""
        self._definitions.folders.setdefault(name, folder)

    def add_definition(self, type_name: str, definition: str) -> None:
        """Add a type, and what it depends on, from the text a publisher sends along."""
        own, *others = definition.split("\n" + "=" * 80 + "\n")
        for other in others:
            head, _, text = other.partition("\n")
            if head.startswith("MSG: ") and not self.has(head[5:].strip()):
                self._definitions.messages.setdefault(head[5:].strip(), text)
        self.add(type_name, own)

    # -- what peers compare

    def md5(self, type_name: str) -> str:
        """Return the md5 sum over a type's canonical text, which peers compare."""
        if type_name not in self._md5s:
            self._md5s[type_name] = hashlib.md5(self._canonical(self._key(type_name)).encode()).hexdigest()
        return self._md5s[type_name]

    def definition(self, type_name: str) -> str:
        """Return the text of a type followed by those it depends on, as genmsg writes it."""
        if type_name not in self._definition_texts:
            key = self._key(type_name)
            depends = dict.fromkeys(self._depends(key))
            parts = [self._text(key)] + [f"{_SEPARATOR}{_ros(other)}\n{self._text(other)}" for other in depends]
            self._definition_texts[type_name] = "\n".join(parts)
        return self._definition_texts[type_name]

    def service(self, type_name: str) -> ServiceType:
        """Return a service type.

        Raises:
            MessageError: there is none of this name.
        """
        with self._lock:
            return self._services.get(type_name) or self._read_service(type_name)

    # -- values and bytes

    def new(self, type_name: str, fields: object = None, *, now_ns: int | None = None) -> Message:
        """Make a message; every field not given has ROS's default (0, '', empty).

        Args:
            type_name: such as 'geometry_msgs/Twist'.
            fields: name → value, nested; or all values in order, as a list. 'now' stands for a time, 'auto' for a
                header stamped now.
            now_ns: what now is [ns]; the wall's time by default.

        Raises:
            MessageError: no such type or field, or a value that does not fit; the text names the field.
        """
        now = time.time_ns() if now_ns is None else now_ns
        return self._filling.message(self._key(type_name), {} if fields is None else fields, now)

    def stamp(self, ns: int) -> Message:
        """Make a `time` value from nanoseconds."""
        return self._store.types["builtin_interfaces/msg/Time"](sec=ns // 10**9, nanosec=ns % 10**9)

    def serialize(self, message: Message, *, room: int = 0) -> memoryview:
        """Write a message's bytes, behind `room` bytes that the caller fills in.

        Raises:
            MessageError: a field holds what its type cannot; the text names it.
        """
        key: str = message.__msgtype__
        try:
            return self._write(message, key, room)
        except (AttributeError, TypeError, ValueError, AssertionError, OverflowError, struct.error):
            # Lists where numpy arrays belong, or something wrong: convert field by field, which names what is wrong.
            return self._write(self._filling.message(key, message, 0), key, room)

    def deserialize(self, data: bytes | memoryview, type_name: str) -> Message:
        """Read a message's bytes; its arrays may be read-only views of them.

        Raises:
            MessageError: the bytes are no such message.
        """
        key = self._key(type_name)
        try:
            return self._store.deserialize_ros1(data, key)
        except Exception as error:  # generated code meets arbitrary bytes here
            raise MessageError(f"{len(data)} bytes are no {type_name}: {error}") from None

    def prepare(self, type_name: str) -> None:
        """Have all ready that reading and writing a type takes: libraries are imported, code is generated."""
        self._store.get_msgdef(self._key(type_name))

    # -- inside

    def _write(self, message: Message, key: str, room: int) -> memoryview:
        """As the store's own `serialize_ros1`, which leaves no room: a picture would be copied for its length."""
        store = self._store
        kind = store.get_msgdef(key)
        size = room + kind.getsize_ros1(0, message, store)
        data = memoryview(bytearray(size)) if size < _LONG_BYTES else _untouched(size)
        end = kind.serialize_ros1(data, room, message, store)
        assert end == len(data)
        return data

    @property
    def _store(self) -> "Typestore":
        if self._store_ is None:
            with self._lock:
                from rosbags.typesys import Stores, get_typestore

                self._store_ = self._store_ or get_typestore(Stores.EMPTY if self._is_bare else Stores.ROS1_NOETIC)
        return self._store_

    @property
    def _filling(self) -> "Filling":
        if self._filling_ is None:
            from .filling import Filling

            self._filling_ = Filling(self._store)
        return self._filling_

    def _key(self, type_name: str) -> str:
        """Name a known type as rosbags does."""
        package, slash, name = type_name.partition("/")
        key = f"{package}/msg/{name}" if not name.startswith("msg/") else type_name
        if key in self._store.types:
            return key
        with self._lock:
            for load in (self._definitions.load_package, self._definitions.load_from_path):
                load(package)
                if key not in self._store.types and _ros(key) in self._definitions.messages:
                    self._register(_ros(key))
                service = _ros(key).removesuffix("Request").removesuffix("Response")
                if service != _ros(key) and service in self._definitions.services and service not in self._services:
                    self.service(service)
                if key in self._store.types:
                    return key
        if key not in self._store.types:
            if not slash:
                raise MessageError(
                    f"{type_name!r} is no message type; types are written package/Name, like std_msgs/String"
                )
            known = [other for other in self._names() if other.startswith(f"{package}/")]
            raise MessageError(f"no message type {type_name!r}{_instead('messages', package, known)}")
        return key

    def _names(self) -> list[str]:
        names = {_ros(key) for key in self._store.types if key not in _BUILTIN} | self._definitions.messages.keys()
        halves = {half for kind in self._services.values() for half in (kind.request, kind.response)}
        return sorted(names - halves)

    def _read_service(self, type_name: str) -> ServiceType:
        package = type_name.partition("/")[0]
        self._definitions.load_package(package)
        if type_name not in self._definitions.services:
            self._definitions.load_from_path(package)
        text = self._definitions.services.get(type_name)
        if text is None:
            known = sorted(name for name in self._definitions.services if name.startswith(f"{package}/"))
            raise MessageError(f"no service type {type_name!r}{_instead('services', package, known)}")
        request, response = f"{type_name}Request", f"{type_name}Response"
        for name, half in zip((request, response), split_service(text), strict=True):
            self._definitions.messages[name] = half
            self._register(name)
        both = self._canonical(self._key(request)) + self._canonical(self._key(response))
        md5sum = hashlib.md5(both.encode()).hexdigest()
        self._services[type_name] = ServiceType(type=type_name, md5sum=md5sum, request=request, response=response)
        return self._services[type_name]

    def _register(self, type_name: str) -> None:
        from rosbags.typesys import TypesysError, get_types_from_msg

        text = self._definitions.messages[type_name]
        package, _, name = type_name.partition("/")
        key = f"{package}/msg/{name}"
        try:
            types = get_types_from_msg(text, key)
            self._store.register({key: types[key]})
        except (TypesysError, KeyError) as error:
            raise MessageError(f"the definition of {type_name} cannot be read: {error}") from None
        self._texts[key] = text
        for depends in self._direct(key):
            self._key(depends)

    def _direct(self, key: str) -> Iterator[str]:
        for _, desc in fields_of(self._store, key):
            name = _reference(desc)
            if name is not None and name not in _BUILTIN:
                yield name

    def _depends(self, key: str) -> Iterator[str]:
        for name in self._direct(key):
            yield name
            yield from self._depends(name)

    def _text(self, key: str) -> str:
        """As installed if that means the same: `rosbag check` compares texts, comments included, and not md5 sums."""
        if not self._is_bare and (text := self._definitions.installed(_ros(key))) is not None:
            from rosbags.typesys import TypesysError, get_types_from_msg

            with suppress(TypesysError):
                if get_types_from_msg(text, key)[key] == self._store.fielddefs[key]:
                    return text
        if key in self._texts:
            return self._texts[key]
        lines = [f"{kind} {name}={text}\n" for name, (kind, text) in self.constants(_ros(key)).items()]
        fields = fields_of(self._store, key)
        return "".join([*lines, *(f"{_type_text(desc)} {name}\n" for name, desc in fields)])

    def _canonical(self, key: str) -> str:
        """Write the text the md5 sum is taken of: constants, then fields, with types replaced by their own sums."""
        lines = [f"{kind} {name}={text}" for name, (kind, text) in self.constants(_ros(key)).items()]
        for name, desc in fields_of(self._store, key):
            reference = _reference(desc)
            if reference is None or reference in _BUILTIN:
                lines.append(f"{_type_text(desc)} {name}")
            else:
                lines.append(f"{self.md5(_ros(reference))} {name}")
        return "\n".join(lines)


def _untouched(size: int) -> memoryview:
    """Memory as it comes: to clear a picture's takes as long as to write it."""
    from numpy import empty, uint8

    return empty(size, uint8).data


def fields_of(store: "Typestore", key: str) -> list[tuple[str, Any]]:
    """Fields of a type in order, without the one rosbags puts into empty types because ROS 2 does."""
    return [field for field in store.fielddefs[key][1] if field[0] != "structure_needs_at_least_one_member"]


def _ros(key: str) -> str:
    return key.replace("/msg/", "/", 1)


def _reference(desc: Any) -> str | None:
    """Name the message type a field refers to, itself or as an element."""
    kind, detail = desc
    if kind >= 3:
        kind, detail = detail[0]
    return cast(str, detail) if kind == 2 else None


def _type_text(desc: Any) -> str:
    """Write a field's type as a .msg file does."""
    kind, detail = desc
    if kind >= 3:
        inner, count = detail
        return f"{_type_text(inner)}[{count if kind == 3 else ''}]"
    return _BUILTIN.get(detail, _ros(detail)) if kind == 2 else cast(str, detail[0])


def _constant(value: object) -> str:
    return str(int(value)) if isinstance(value, bool) else str(value)


def _instead(what: str, package: str, known: list[str]) -> str:
    if not known:
        return f"; no {what} of a package {package!r} are known"
    return f"; {what} of {package}: {', '.join(name.partition('/')[2] for name in known[:40])}"
