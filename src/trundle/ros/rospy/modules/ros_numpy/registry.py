"""Conversion functions by message class."""

from collections.abc import Sequence

from .numpy_msg import numpy_msg

_to_numpy, _from_numpy = {}, {}


def converts_to_numpy(msgtype, plural=False):
    """Decorator: the function makes an array of a message of this class, or of a list of them."""
    return lambda function: _register(_to_numpy, msgtype, plural, function)


def converts_from_numpy(msgtype, plural=False):
    """Decorator: the function makes a message of this class of an array."""
    return lambda function: _register(_from_numpy, msgtype, plural, function)


def numpify(msg, *args, **kwargs):
    """Array of a message, or of a list of messages.

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
        raise ValueError(f"{type(msg).__name__} cannot become an array; supported are {_names(_to_numpy)}")
    return convert(msg, *args, **kwargs)


def msgify(msg_type, numpy_obj, *args, **kwargs):
    """Message of a class, of an array; `plural=True`: a list of them.

    Raises:
        ValueError: the type is not supported.
    """
    convert = _from_numpy.get((msg_type, kwargs.pop("plural", False)))
    if not convert:
        raise ValueError(f"no {msg_type.__name__} can be made of an array; supported are {_names(_from_numpy)}")
    return convert(numpy_obj, *args, **kwargs)


def _register(table, msgtype, plural, function):
    table[msgtype, plural] = table[numpy_msg(msgtype), plural] = function
    return function


def _names(table):
    return ", ".join(sorted({cls.__name__ + ("[]" if plural else "") for cls, plural in table}))
