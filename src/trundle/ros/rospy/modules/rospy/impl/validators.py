"""Checks of remote calls' parameters: functions of the value and the caller's name that return the value to use."""

from collections.abc import Callable
from typing import Any, TypeAlias

Check: TypeAlias = Callable[[Any, str], Any]


class ParameterInvalid(Exception):
    """A parameter is invalid."""

    def __init__(self, message: str) -> None:
        super().__init__(message)
        self._message = message


def non_empty(param_name: str) -> Check:
    """Check that a parameter is not empty."""

    def check(value: Any, context: str) -> Any:
        del context
        if not value:
            raise ParameterInvalid(f"ERROR: parameter [{param_name}] must be specified and non-empty")
        return value

    return check


def checked_text(param_name: str, value: Any) -> str:
    """Return a text that is not empty.

    Raises:
        ParameterInvalid: it is empty or no text.
    """
    if not value or not isinstance(value, str):
        raise ParameterInvalid(f"ERROR: parameter [{param_name}] must be a non-empty string")
    return value
