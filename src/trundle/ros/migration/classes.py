"""Message classes with genpy's interface, which update rules expect.

Numbers in arrays are tuples, `uint8[]` is bytes, times have `secs` and `nsecs`; serialization is that of `Messages`.
"""

from collections.abc import Callable, Sequence
from typing import Any, BinaryIO, cast

from ..errors import MessageError
from ..messages.message_library import Messages
from .times import Duration, Time

_TIMES = {"time": Time, "duration": Duration}
_BYTES = ("uint8", "char")
_NUMBERS = {f"{u}int{n}" for u in ("", "u") for n in (8, 16, 32, 64)} | {"byte", "char", "float32", "float64"}
BUILTIN = _NUMBERS | {"bool", "string", "time", "duration"}
Key = tuple[str, str]
"""Type and md5 sum; classes with equal keys are equivalent."""


class MessageClass(type):
    """Metaclass of message classes, with genpy's attributes such as `_type`."""

    _type: str
    _md5sum: str
    _full_text: str
    _kinds: dict[str, str]
    _classes: "MessageClasses"

    @property
    def kind(cls) -> str:
        """Type name."""
        return cls._type

    @property
    def md5sum(cls) -> str:
        """md5 sum."""
        return cls._md5sum

    @property
    def key(cls) -> Key:
        """Type and md5 sum."""
        return cls._type, cls._md5sum

    @property
    def definition(cls) -> str:
        """Full definition with dependencies."""
        return cls._full_text

    @property
    def kinds(cls) -> dict[str, str]:
        """Field names → types."""
        return cls._kinds

    @property
    def classes(cls) -> "MessageClasses":
        """Store that holds this class."""
        return cls._classes

    def nested_classes(cls) -> "dict[str, MessageClass]":
        """Classes of this type and of all types it contains, by name."""
        return cls._classes.nested_classes(cls._type)

    def constants(cls) -> dict[str, tuple[str, str]]:
        """Constants: name → (type, value as written)."""
        return cls._classes.constants(cls._type)


class RuleMessage(metaclass=MessageClass):
    """A message with genpy's interface."""

    __slots__: tuple[str, ...] = ()

    def __init__(self, *values: object, **named: object) -> None:
        """Create a message from all fields in order, or from some by name; others are 0 or empty."""
        cls = type(self)
        names = list(cls.kinds)
        if values and (named or len(values) != len(names)):
            raise TypeError(f"{cls.kind} has {len(names)} fields ({', '.join(names)}), got {len(values)} values")
        fields = dict(zip(names, values, strict=True)) if values else named
        for name in fields:
            if name not in names:
                raise AttributeError(f"{cls.kind} has no field {name!r}; fields here: {', '.join(names)}")
        for name, kind in cls.kinds.items():
            setattr(self, name, fields[name] if name in fields else cls.classes.default(kind))

    def serialize(self, buffer: BinaryIO) -> None:
        """Serialize the message."""
        buffer.write(to_bytes(self))

    def deserialize(self, data: bytes) -> "RuleMessage":
        """Set the fields from serialized data.

        Raises:
            MessageError: the data is not a message of this type.
        """
        cls = type(self)
        _copy_fields(self, cls.classes.read(data, cls.kind))
        return self

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(getattr(self, n) == getattr(other, n) for n in type(self).kinds)

    __hash__ = None  # pyright: ignore[reportAssignmentType]  # mutable, as genpy's

    def __repr__(self) -> str:
        cls = type(self)
        return f"{cls.kind}({', '.join(f'{name}={getattr(self, name)!r}' for name in cls.kinds)})"


class MessageClasses:
    """Message classes of one type store."""

    def __init__(self, messages: Messages) -> None:
        self._messages = messages
        self._message_classes: dict[str, MessageClass] = {}
        self._readers: dict[str, Callable[[Any], Any]] = {}

    @classmethod
    def from_definition(cls, kind: str, definition: str) -> "MessageClasses":
        """Create from a full definition, as in a bag or rule.

        Raises:
            MessageError: the definition is invalid.
        """
        messages = Messages(bare=True)
        # REP 100: until 2010 the header lived in roslib.
        messages.add_definition(kind, definition.strip().replace("roslib/Header", "std_msgs/Header"))
        return cls(messages)

    def has(self, kind: str) -> bool:
        """True if the type is known."""
        return self._messages.has(kind)

    def message_class(self, kind: str) -> MessageClass:
        """Return the class of a type.

        Raises:
            MessageError: the type is unknown.
        """
        if kind not in self._message_classes:
            self._message_classes[kind] = self._make(kind)
        return self._message_classes[kind]

    def nested_classes(self, kind: str) -> dict[str, MessageClass]:
        """Classes of a type and all types it contains, by name."""
        classes: dict[str, MessageClass] = {}
        pending = [kind]
        while pending:
            name = pending.pop()
            if name not in classes and name not in BUILTIN:
                classes[name] = self.message_class(name)
                pending += [base_type(field) for field in self._messages.fields(name).values()]
        return classes

    def constants(self, kind: str) -> dict[str, tuple[str, str]]:
        """Constants of a type: name → (type, value as written)."""
        return self._messages.constants(kind)

    def default(self, kind: str) -> object:
        """Default value of a field."""
        base, bracket, count = kind.partition("[")
        if bracket:
            length = int(count.rstrip("]") or 0)
            return bytes(length) if base in _BYTES else [self.default(base) for _ in range(length)]
        if base in BUILTIN:
            return _TIMES[base]() if base in _TIMES else {"string": "", "bool": False}.get(base, 0)
        return self.message_class(base)()

    def read(self, data: bytes, kind: str) -> Any:
        """Deserialize with the type store."""
        return self._messages.deserialize(data, kind)

    def write(self, kind: str, fields: dict[str, object]) -> bytes:
        """Serialize a message with these fields.

        Raises:
            MessageError: a field's value does not fit its type.
        """
        return self._messages.serialize(self._messages.new(kind, fields))

    def reader(self, kind: str) -> Callable[[Any], Any]:
        """Converter of a field's value from rosbags' to genpy's form."""
        if kind not in self._readers:
            self._readers[kind] = self._make_reader(kind)
        return self._readers[kind]

    def _make(self, kind: str) -> MessageClass:
        messages = self._messages
        fields = messages.fields(kind)
        constants = {
            name: _constant(type_, text)
            for name, (type_, text) in messages.constants(kind).items()
            if name not in fields
        }
        return MessageClass(
            kind.rpartition("/")[2],
            (RuleMessage,),
            {
                **constants,
                "__slots__": tuple(fields),
                "_type": kind,
                "_md5sum": messages.md5(kind),
                "_full_text": messages.definition(kind),
                "_slot_types": list(fields.values()),
                "_kinds": fields,
                "_classes": self,
            },
        )

    def _make_reader(self, kind: str) -> Callable[[Any], Any]:
        base, bracket, _ = kind.partition("[")
        if not bracket:
            if base in _TIMES:
                time_class = _TIMES[base]
                return lambda value: time_class(value.sec, value.nanosec)
            return (lambda value: value) if base in BUILTIN else self._reader_of_messages(base)
        if base in _BYTES:
            return lambda array: array.tobytes()
        if base in _NUMBERS:
            return lambda array: tuple(array.tolist())
        if base == "bool":
            return lambda array: array.tolist()
        read = self.reader(base)
        return lambda items: [read(item) for item in items]

    def _reader_of_messages(self, kind: str) -> Callable[[Any], Any]:
        cls = self.message_class(kind)

        def read(value: Any) -> RuleMessage:
            message = cast(RuleMessage, object.__new__(cls))
            _copy_fields(message, value)
            return message

        return read


def base_type(kind: str) -> str:
    """Type of a field without `[]`."""
    return kind.partition("[")[0]


def _copy_fields(message: RuleMessage, value: Any) -> None:
    """Set a message's fields from a message of the type store."""
    cls = type(message)
    for name, kind in cls.kinds.items():
        field = getattr(value, name) if hasattr(value, name) else getattr(value, f"{name}_")  # a Python keyword
        setattr(message, name, cls.classes.reader(kind)(field))


def from_bytes(cls: MessageClass, data: bytes) -> RuleMessage:
    """Deserialize without default values first, since fixed-size arrays may have any length.

    Raises:
        MessageError: the data is not a message of this type.
    """
    return cls.classes.reader(cls.kind)(cls.classes.read(data, cls.kind))


def to_bytes(message: RuleMessage) -> bytes:
    """Serialize a message.

    Raises:
        MessageError: a field's value does not fit its type; the text names it.
    """
    cls = type(message)
    return cls.classes.write(cls.kind, _fields(message, cls, ""))


def _fields(message: Any, cls: MessageClass, path: str) -> dict[str, Any]:
    """Fields of a message, which may be any object with the same attributes."""
    fields: dict[str, Any] = {}
    for name, kind in cls.kinds.items():
        try:
            value = getattr(message, name)
        except AttributeError:
            raise MessageError(f"field {path or name!r} is a {cls.kind}, got {message!r}") from None
        fields[name] = _field(value, kind, cls.classes, f"{path}.{name}".lstrip("."))
    return fields


def _field(value: Any, kind: str, classes: MessageClasses, path: str) -> Any:
    base, bracket, _ = kind.partition("[")
    if bracket:
        if base in _BYTES and isinstance(value, str):  # rules were written for Python 2, where bytes are strings
            return value.encode("latin-1", "replace")
        if base in _NUMBERS:
            return value
        if not isinstance(value, Sequence) or isinstance(value, str):
            raise MessageError(f"field {path!r} is a list of {base}, got {value!r}")
        return [_field(item, base, classes, f"{path}[{i}]") for i, item in enumerate(cast("Sequence[Any]", value))]
    if base in _TIMES and hasattr(value, "nsecs"):
        return {"secs": value.secs, "nsecs": value.nsecs}
    return value if base in BUILTIN else _fields(value, classes.message_class(base), path)


def _constant(kind: str, text: str) -> Any:
    if kind == "string":
        return text
    if kind == "bool":
        return text.strip().lower() not in ("0", "false")
    return float(text) if kind.startswith("float") else int(text, 0)
