"""Errors of state machines; each is logged when it is made."""

from .log import logerr


class SmachError(Exception):
    """Base of this package's errors."""

    def __init__(self, message):
        logerr(f"{type(self).__name__}: {message}")
        super().__init__(message)


class InvalidTransitionError(SmachError):
    """A transition from or to something that does not exist."""


class InvalidStateError(SmachError):
    """A state that does not exist, or is wrong here."""


class InvalidConstructionError(SmachError):
    """A container that is not open."""


class InvalidUserCodeError(SmachError):
    """An exception in a state's or a callback's code."""
