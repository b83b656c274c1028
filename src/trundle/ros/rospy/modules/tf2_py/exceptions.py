"""Exceptions of transform lookups.

TransformException
├── ConnectivityException
├── LookupException
├── ExtrapolationException
├── InvalidArgumentException
└── TimeoutException
"""

from trundle.ros import errors


class TransformException(Exception):
    """A transform lookup failed."""


class ConnectivityException(TransformException):
    """The two frames are in different trees."""


class LookupException(TransformException):
    """A frame does not exist."""


class ExtrapolationException(TransformException):
    """The time is outside the buffered history."""


class InvalidArgumentException(TransformException):
    """A frame name is empty or starts with a slash."""


class TimeoutException(TransformException):
    """No answer in time."""


for _class in (
    TransformException, ConnectivityException, LookupException, ExtrapolationException, InvalidArgumentException,
    TimeoutException,
):  # fmt: skip
    _class.__module__ = "tf2"  # tracebacks name this module, as with the original's compiled module

_CLASSES: dict[type[errors.TransformError], type[TransformException]] = {
    errors.ConnectivityError: ConnectivityException,
    errors.ExtrapolationError: ExtrapolationException,
    errors.FrameNameError: InvalidArgumentException,
    errors.UnknownFrameError: LookupException,
}


def of_error(error: errors.TransformError) -> TransformException:
    """Convert a TransformError to tf2's exception."""
    return _CLASSES.get(type(error), TransformException)(str(error))
