"""Values of an expression that can be called."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from .budget import Budget


class Caller(Protocol):
    """The interpreter, as seen by the functions that it calls."""

    @property
    def budget(self) -> Budget:
        """Work and memory left."""
        ...

    def call(self, callee: Any, values: Sequence[Any], named: Mapping[str, Any], /) -> Any:
        """Call a value.

        Raises:
            Exception: it may not be called, or whatever the call raises.
        """
        ...


Guarded = Callable[[Caller, Sequence[Any], Mapping[str, Any]], Any]
"""A function that bounds its own work."""


class Callee:
    """A value that an expression may call; it has no attributes there."""

    __slots__ = ()

    def call(self, caller: Caller, values: Sequence[Any], named: Mapping[str, Any], /) -> Any:
        """Call it."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True, eq=False)
class Function(Callee):
    """A function that the program offers to the expressions of a file."""

    name: str
    body: Guarded

    def call(self, caller: Caller, values: Sequence[Any], named: Mapping[str, Any], /) -> Any:
        return self.body(caller, values, named)

    def __repr__(self) -> str:
        return f"<function {self.name}>"


def wrap_function(function: Callable[..., Any], name: str | None = None) -> Function:
    """Offer a function of Python that does no more work than its values are long."""

    def body(caller: Caller, values: Sequence[Any], named: Mapping[str, Any]) -> Any:
        caller.budget.spend(10)
        caller.budget.spend_traversal([*values, *named.values()])
        found = function(*values, **named)
        if isinstance(found, list | tuple | dict):
            caller.budget.allocate(60 * caller.budget.spend_traversal(found))
        return found

    return Function(name or function.__name__, body)
