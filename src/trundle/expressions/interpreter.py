"""Evaluates expressions that a file holds, with nothing of Python but what is listed here.

simpleeval knows neither lambdas nor a bound on time and looks names of attributes up in a list of those to refuse;
asteval has statements, files and numpy; RestrictedPython leaves every bound to whoever uses it, and both lists go by
names alone, where the type of the object decides what is harmless.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from .budget import Budget, ExpressionError
from .functions import GUARDED
from .methods import attribute
from .syntax import Code, compile_expression
from .values import Callee

_LONGEST = 65_536
"""Characters of one expression."""
_OCTETS_PER_NODE = 250
"""Memory of a node; the steps to parse it are a tenth."""
_STEPS_PER_CALL = 5
_OCTETS_PER_CALL = 80
"""Memory of a value that a call returns and that is not counted where it is made; also of finding an attribute."""
_SHORT = frozenset({str, int, float, bool})
"""Kinds of values that are as long as they look."""


class Names(Protocol):
    """Where the names of an expression are looked up."""

    def __getitem__(self, name: str, /) -> Any:
        """The value of a name.

        Raises:
            KeyError: nothing has it.
        """
        ...


class _Compiled(NamedTuple):
    code: Code
    cost: int


class Interpreter:
    """Evaluates the expressions of one document, which share a budget."""

    def __init__(self, budget: Budget | None = None, dotted: Callable[[Any, str], Any] | None = None) -> None:
        """Prepare.

        Args:
            budget: work and memory of the whole document.
            dotted: gives an attribute of an object of the program's own, or NotImplemented.
        """
        self.budget = budget or Budget()
        self.dotted = dotted
        self._compiled: dict[str, _Compiled] = {}

    def evaluate(self, text: str, names: Names) -> Any:
        """Evaluate an expression.

        Raises:
            ExpressionError: a name or an attribute that is not for files, or a value or a loop too large.
            Exception: what Python raises for the same: SyntaxError, NameError, TypeError, ZeroDivisionError, …
        """
        try:
            compiled = self._compiled.get(text) or self._compile(text)
            self.budget.spend(compiled.cost)
            value = compiled.code(Evaluation(self, names), None)
            if value.__class__ not in _SHORT:
                self.budget.spend_traversal(value)
            elif value.__class__ is str and not value.isascii():
                value.encode()
            return value
        except UnicodeEncodeError:
            raise ExpressionError("a text with half of a surrogate pair, which no file can hold") from None
        except (RecursionError, MemoryError):
            raise ExpressionError("an expression or a value nested too deeply") from None

    def _compile(self, text: str) -> _Compiled:
        if len(text) > _LONGEST:
            raise ExpressionError(f"an expression of more than {_LONGEST} characters")
        code, cost, hidden = compile_expression(text.strip())
        if hidden:
            raise ExpressionError(f"Use of invalid name(s): {', '.join(hidden)}")
        compiled = self._compiled[text] = _Compiled(code, cost)
        self.budget.allocate(_OCTETS_PER_NODE * cost)
        self.budget.spend(_OCTETS_PER_NODE // 10 * cost)
        return compiled


class Evaluation:
    """One evaluation: its names, and what it may call."""

    __slots__ = ("_interpreter", "_names", "budget")

    def __init__(self, interpreter: Interpreter, names: Names) -> None:
        self._interpreter, self._names = interpreter, names
        self.budget = interpreter.budget

    def look_up(self, name: str) -> Any:
        """The value of a name.

        Raises:
            NameError: nothing has it.
        """
        try:
            return self._names[name]
        except KeyError:
            raise NameError(f"name {name!r} is not defined") from None

    def attribute(self, owner: Any, name: str) -> Any:
        """The attribute of a value.

        Raises:
            AttributeError: there is none that an expression may use.
        """
        self.budget.spend(_STEPS_PER_CALL)
        self.budget.allocate(_OCTETS_PER_CALL)
        dotted = self._interpreter.dotted
        found = NotImplemented if dotted is None else dotted(owner, name)
        return attribute(owner, name) if found is NotImplemented else found

    def call(self, callee: Any, values: Sequence[Any], named: Mapping[str, Any], /) -> Any:
        """Call a value.

        Raises:
            TypeError: it is nothing that an expression may call.
        """
        self.budget.spend(_STEPS_PER_CALL)
        self.budget.allocate(_OCTETS_PER_CALL)
        if isinstance(callee, Callee):
            return callee.call(self, values, named)
        guarded = GUARDED.get(callee) if callable(callee) and type(callee).__hash__ is not None else None
        if guarded is None:
            kept_back = " for an expression" if callable(callee) else ""
            raise TypeError(f"{type(callee).__name__!r} object is not callable{kept_back}")
        return guarded(self, values, named)
