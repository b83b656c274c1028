"""XML-RPC calls as masters and nodes answer them: a code, a text and a value, in the original's words if refused."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from trundle.names import resolve_name

from ..master.registry import Answer
from .rpc_server import UnknownMethodError

Method: TypeAlias = tuple[int, object, Callable[..., Answer]]
"""How many arguments follow the caller's name, the value of a refusal, and what answers."""


class BadArgumentError(Exception):
    """An argument the original refuses, in its words."""


def answer_call(methods: Mapping[str, Method], method: str, arguments: list[Any]) -> Answer:
    """Answer a call, or say what is wrong with it.

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


def name_argument(what: str, value: Any, caller: str) -> str:
    """Return the global name that an argument means to its caller.

    Raises:
        BadArgumentError: it is no name.
    """
    if not isinstance(value, str) or not value:
        raise BadArgumentError(f"ERROR: parameter [{what}] must be a non-empty string")
    if ":" in value or " " in value:
        raise BadArgumentError(f"ERROR: parameter [{what}] contains illegal chars")
    if value == "/":
        raise BadArgumentError(f"ERROR: parameter [{what}] cannot be the global namespace")
    return resolve_name(value, caller)
