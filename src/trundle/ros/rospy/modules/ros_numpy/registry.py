"""Conversion functions, registered by message class."""

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from .numpy_msg import numpy_msg

_Converter = TypeVar("_Converter", bound=Callable[..., Any])
_Table = dict[tuple[Any, bool], Callable[..., Any]]
_to_numpy: _Table = {}
_from_numpy: _Table = {}


def converts_to_numpy(msgtype: Any, plural: bool = False) -> Callable[[_Converter], _Converter]:
    """Decorator: register a function that converts a message of this class, or a list of them, to an array."""

    def register(function: _Converter) -> _Converter:
        return _register(_to_numpy, msgtype, plural, function)

    return register


def converts_from_numpy(msgtype: Any, plural: bool = False) -> Callable[[_Converter], _Converter]:
    """Decorator: register a function that converts an array to a message of this class."""

    def register(function: _Converter) -> _Converter:
        return _register(_from_numpy, msgtype, plural, function)

    return register


def numpify(msg: Any, *args: Any, **kwargs: Any) -> Any:
    """Convert a message, or a list of messages, to an array.

    Raises:
        ValueError: the type is not supported.
    """
    if msg is None:
        return None
    convert = _to_numpy.get((type(msg), False))
    if not convert and isinstance(msg, Sequence):
        if not msg:
            raise ValueError("an empty list has no message type")
        convert = _to_numpy.get((type(msg[0]), True))
    if not convert:
        raise ValueError(f"{type(msg).__name__} cannot be converted to an array; supported are {_names(_to_numpy)}")
    return convert(msg, *args, **kwargs)


def msgify(msg_type: Any, numpy_obj: Any, *args: Any, **kwargs: Any) -> Any:
    """Convert an array to a message of a class; with `plural=True` to a list of messages.

    Raises:
        ValueError: the type is not supported.
    """
    convert = _from_numpy.get((msg_type, kwargs.pop("plural", False)))
    if not convert:
        raise ValueError(f"cannot convert an array to {msg_type.__name__}; supported are {_names(_from_numpy)}")
    return convert(numpy_obj, *args, **kwargs)


def _register(table: _Table, msgtype: Any, plural: bool, function: _Converter) -> _Converter:
    table[msgtype, plural] = table[numpy_msg(msgtype), plural] = function
    return function


def _names(table: _Table) -> str:
    return ", ".join(sorted({cls.__name__ + ("[]" if plural else "") for cls, plural in table}))
