"""Argument checks and answers [code, text, value] of the master and slave APIs; refusals in the original's words."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from trundle.robots.names import resolve_name

from .rpc_server import UnknownMethodError

Answer: TypeAlias = tuple[int, str, object]
"""Code, text and value."""
Method: TypeAlias = tuple[int, object, Callable[..., Answer]]
"""Argument count after caller_id, the value in a refusal, and the function."""


class BadArgumentError(Exception):
    """An argument the original refuses, with its error text."""


def answer_call(methods: Mapping[str, Method], method: str, arguments: list[object]) -> Answer:
    """Check the arguments, call the method and return its answer.

    Raises:
        UnknownMethodError: there is no such method.
    """
    if method not in methods:
        raise UnknownMethodError(f'method "{method}" is not supported')
    count, nothing, function = methods[method]
    if not arguments:
        return -1, "missing required caller_id parameter", nothing
    if method == "shutdown" and len(arguments) == 1:
        arguments = [*arguments, ""]
    if len(arguments) != count + 1:
        return -1, "Error: bad call arity", nothing
    if not isinstance(arguments[0], str):
        return -1, "caller_id must be a string", nothing
    try:
        return function(*arguments)
    except BadArgumentError as error:
        return -1, str(error), nothing


def name_argument(what: str, value: object, caller: str) -> str:
    """Resolve a name argument in the caller's namespace.

    Raises:
        BadArgumentError: the argument is not a valid name.
    """
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{what}] must be a non-empty string")
    if ":" in value or " " in value:
        raise BadArgumentError(f"ERROR: parameter [{what}] contains illegal chars")
    if value == "/":
        raise BadArgumentError(f"ERROR: parameter [{what}] cannot be the global namespace")
    return resolve_name(value, caller)
