"""Callable values of expressions."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from .budget import Budget


class Caller(Protocol):
    """Interpreter, as seen by the functions that it calls."""

    @property
    def budget(self) -> Budget:
        """Remaining time and memory."""
        ...

    def call(self, callee: object, values: Sequence[object], named: Mapping[str, object], /) -> Any:
        """Call a value.

        Raises:
            Exception: it may not be called, or the call raises it.
        """
        ...


Guarded = Callable[[Caller, Sequence[object], Mapping[str, object]], Any]
"""Function that bounds its own cost."""


class Callee:
    """Callable value without attributes."""

    __slots__ = ()

    def call(self, caller: Caller, values: Sequence[object], named: Mapping[str, object], /) -> Any:
        """Call the value."""
        raise NotImplementedError


class Function(Callee):
    """Function of the program for the expressions of a file."""

    __slots__ = ("_body", "name")

    def __init__(self, name: str, body: Guarded) -> None:
        self.name = name
        self._body = body

    def call(self, caller: Caller, values: Sequence[object], named: Mapping[str, object], /) -> Any:
        return self._body(caller, values, named)

    def __repr__(self) -> str:
        return f"<function {self.name}>"


def wrap_function(function: Callable[..., object], name: str | None = None) -> Function:
    """Wrap a Python function whose cost is linear in the length of its arguments."""

    def body(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        caller.budget.spend(10)
        caller.budget.spend_traversal([*values, *named.values()])
        result = function(*values, **named)
        if isinstance(result, list | tuple | dict):
            caller.budget.allocate(60 * caller.budget.spend_traversal(result))
        return result

    return Function(name or function.__name__, body)
