"""Argument checks and answers [code, text, value] of the master and slave APIs; error texts are rosmaster's."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from trundle.robots.names import resolve_name

from .rpc_server import UnknownMethodError

Answer: TypeAlias = tuple[int, str, object]
"""Code, text and value."""
Method: TypeAlias = tuple[int, object, Callable[..., Answer]]
"""Number of arguments after caller_id, value of a failed answer, and function."""


class BadArgumentError(Exception):
    """An invalid argument, with rosmaster's error text."""


def answer_call(methods: Mapping[str, Method], method: str, arguments: list[object]) -> Answer:
    """Check the arguments, call the method and return its answer.

    Raises:
        UnknownMethodError: there is no such method.
    """
    if method not in methods:
        raise UnknownMethodError(f'method "{method}" is not supported')
    count, failure_value, function = methods[method]
    if not arguments:
        return -1, "missing required caller_id parameter", failure_value
    if method == "shutdown" and len(arguments) == 1:
        arguments = [*arguments, ""]
    if len(arguments) != count + 1:
        return -1, "Error: bad call arity", failure_value
    if not isinstance(arguments[0], str):
        return -1, "caller_id must be a string", failure_value
    try:
        return function(*arguments)
    except BadArgumentError as error:
        return -1, str(error), failure_value


def name_argument(argument: str, value: object, caller: str) -> str:
    """Resolve a name argument in the caller's namespace.

    Raises:
        BadArgumentError: the argument is not a valid name.
    """
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{argument}] must be a non-empty string")
    if ":" in value or " " in value:
        raise BadArgumentError(f"ERROR: parameter [{argument}] contains illegal chars")
    if value == "/":
        raise BadArgumentError(f"ERROR: parameter [{argument}] cannot be the global namespace")
    return resolve_name(value, caller)
