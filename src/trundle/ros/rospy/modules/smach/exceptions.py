"""Exceptions of state machines; each is logged when it is created."""

from .log import logerr


class SmachError(Exception):
    """Base class of this package's exceptions."""

    def __init__(self, message: str) -> None:
        logerr(f"{type(self).__name__}: {message}")
        super().__init__(message)


class InvalidTransitionError(SmachError):
    """A transition from or to something that does not exist."""


class InvalidStateError(SmachError):
    """A state that does not exist, or is not allowed."""


class InvalidConstructionError(SmachError):
    """A container that is not open."""


class InvalidUserCodeError(SmachError):
    """An exception in a state's or a callback's code."""
