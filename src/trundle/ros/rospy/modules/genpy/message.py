"""Base class of messages, their text, and filling them from YAML."""

import struct
from collections.abc import Iterable
from typing import Any, ClassVar

from .check import check_type as check_type
from .errors import (
    DeserializationError as DeserializationError,
    MessageException as MessageException,
    SerializationError as SerializationError,
)
from .fill import fill_message_args as fill_message_args, get_printable_message_args as get_printable_message_args
from .lookup import get_message_class as get_message_class, get_service_class as get_service_class
from .text import strify_message as strify_message

struct_I = struct.Struct("<I")


class Message:
    """Base class of messages."""

    __slots__: Any = ["_connection_header"]
    _slot_types: ClassVar[list[str]]
    _type: str
    _md5sum: str
    _full_text: str
    _has_header: bool

    def __init__(self, *args: Any, **kwds: Any) -> None:
        """Set all fields in order, or some by name; the rest is None.

        Raises:
            TypeError: both, or the wrong number of values.
            AttributeError: no field of this name.
        """
        if args and kwds:
            raise TypeError("Message constructor may only use args OR keywords, not both")
        if args:
            if len(args) != len(self.__slots__):
                raise TypeError(f"Invalid number of arguments, args should be {self.__slots__} args are{args}")
            for name, value in zip(self.__slots__, args, strict=True):
                setattr(self, name, value)
            return
        for name in kwds:
            if name not in self.__slots__:
                raise AttributeError(f"{name} is not an attribute of {type(self).__name__}")
        for name in self.__slots__:
            setattr(self, name, kwds.get(name))

    def __getstate__(self) -> list[Any]:
        return [getattr(self, name) for name in self.__slots__]

    def __setstate__(self, state: Iterable[Any]) -> None:
        for name, value in zip(self.__slots__, state, strict=False):
            setattr(self, name, value)

    def _get_types(self) -> list[str]:
        raise Exception("must be overriden")

    def _check_types(self, exc: Exception | None = None) -> None:
        """Name the field whose value does not fit.

        Raises:
            SerializationError: there is one, or `exc` is given.
        """
        for name, kind in zip(self.__slots__, self._get_types(), strict=True):
            check_type(name, kind, getattr(self, name))
        if exc is not None:
            raise SerializationError(str(exc))

    def serialize(self, buff: Any) -> None:
        """Serialize into a binary file; message classes do."""

    def deserialize(self, str_: bytes) -> Any:
        """Fill from the serialized form; message classes do."""

    def __repr__(self) -> str:
        return strify_message(self)

    def __str__(self) -> str:
        return strify_message(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        return all(_equal(getattr(self, name, self), getattr(other, name, other)) for name in self.__slots__)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None  # pyright: ignore[reportAssignmentType]


def _equal(ours: Any, theirs: Any) -> bool:
    if type(ours) in (list, tuple) and type(theirs) in (list, tuple):
        return tuple(ours) == tuple(theirs)
    return ours == theirs
