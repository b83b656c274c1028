"""Interpreter for expressions in files, restricted to the Python features listed in this room.

simpleeval has neither lambdas nor a time bound and refuses attributes by name; asteval has statements, files and numpy;
RestrictedPython leaves every bound to its caller. Both lists go by names alone, where the type of the object decides
what is harmless.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from .budget import Budget, ExpressionError
from .functions import GUARDED
from .methods import attribute
from .syntax import Code, compile_expression
from .values import Callee

_LONGEST = 65_536
"""Largest length of an expression."""
_OCTETS_PER_NODE = 250
"""Memory per syntax node; its parsing costs a tenth of that in steps."""
_STEPS_PER_CALL = 5
_OCTETS_PER_CALL = 80
"""Memory of a call's result that is not counted where it is created, and of an attribute lookup."""
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")
_SHORT = frozenset({str, int, float, bool})
"""Types whose size needs no traversal."""


class Names(Protocol):
    """Lookup of the names of an expression."""

    def __getitem__(self, name: str, /) -> object:
        """Return the value of a name.

        Raises:
            KeyError: it is not defined.
        """
        ...


class _Compiled(NamedTuple):
    code: Code
    cost: int


class Interpreter:
    """Interpreter for the expressions of one document, which share a budget."""

    def __init__(self, budget: Budget | None = None, dotted: Callable[[object, str], object] | None = None) -> None:
        """Create an interpreter.

        Args:
            budget: time and memory of the whole document.
            dotted: returns an attribute of an object of the program's own, or NotImplemented.
        """
        self.budget = budget or Budget()
        self.dotted = dotted
        self._compiled: dict[str, _Compiled] = {}

    def evaluate(self, text: str, names: Names) -> object:
        """Evaluate an expression.

        Raises:
            ExpressionError: a forbidden name or attribute, or a value or loop that is too large.
            Exception: what Python raises for the same: SyntaxError, NameError, TypeError, ZeroDivisionError, …
        """
        self.budget.start_clock()
        try:
            compiled = self._compiled.get(text) or self._compile(text)
            self.budget.spend(compiled.cost)
            value = compiled.code(Evaluation(self, names), None)
            if value.__class__ not in _SHORT:
                self.budget.spend_traversal(value)
            elif value.__class__ is str and not value.isprintable():
                self.budget.spend(len(value) >> 6)
                value.encode()
                if found := _FORBIDDEN.search(value):
                    raise ExpressionError(f"a text with the character {found[0]!a}, which XML forbids")
            return value
        except UnicodeEncodeError:
            raise ExpressionError("a text with half of a surrogate pair, which no file can hold") from None
        except (RecursionError, MemoryError):
            raise ExpressionError("an expression or a value nested too deeply") from None
        finally:
            self.budget.stop_clock()

    def evaluate_number(self, text: str, names: Names) -> float:
        """Evaluate an expression whose value is a number, or a text with one.

        Raises:
            TypeError, ValueError: it is neither.
            Exception: as `evaluate`.
        """
        value: Any = self.evaluate(text, names)
        return float(value)

    def check(self, text: str) -> None:
        """Compile an expression without evaluating it.

        Raises:
            ExpressionError: it is too long, or has a forbidden name.
            SyntaxError: it is no expression.
        """
        self._compile(text)

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
    """One evaluation: names and calls."""

    __slots__ = ("_interpreter", "_names", "budget")

    def __init__(self, interpreter: Interpreter, names: Names) -> None:
        self._interpreter, self._names = interpreter, names
        self.budget = interpreter.budget

    def look_up(self, name: str) -> object:
        """Return the value of a name.

        Raises:
            NameError: it is not defined.
        """
        try:
            return self._names[name]
        except KeyError:
            raise NameError(f"name {name!r} is not defined") from None

    def attribute(self, owner: object, name: str) -> object:
        """Return an attribute of a value.

        Raises:
            AttributeError: it does not exist or is not allowed.
        """
        self.budget.spend(_STEPS_PER_CALL)
        self.budget.allocate(_OCTETS_PER_CALL)
        dotted = self._interpreter.dotted
        found = NotImplemented if dotted is None else dotted(owner, name)
        return attribute(owner, name) if found is NotImplemented else found

    def call(self, callee: object, values: Sequence[object], named: Mapping[str, object], /) -> Any:
        """Call a value.

        Raises:
            TypeError: expressions may not call it.
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
