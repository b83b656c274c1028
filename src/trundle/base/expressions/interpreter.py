"""Interpreter for expressions in files, restricted to the Python features listed in this room.

Why not a library: simpleeval has neither lambdas nor a time limit and filters attributes by name; asteval offers
statements, files and NumPy; RestrictedPython leaves all limits to its caller. Filters by name are insufficient, since
the object's type decides what is harmless.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from .budget import Budget, ExpressionError
from .functions import GUARDED
from .methods import attribute
from .syntax import Code, compile_expression
from .values import Callee

_MAX_LENGTH = 65_536
"""Maximum length of an expression [characters]."""
_OCTETS_PER_NODE = 250
"""Memory per syntax node; parsing one costs a tenth of that in steps."""
_STEPS_PER_CALL = 5
_OCTETS_PER_CALL = 80
"""Memory of an attribute lookup, and of a call's result that its function does not count."""
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
            dotted: returns an attribute of one of the program's objects, or NotImplemented.
        """
        self.budget = budget or Budget()
        self.dotted = dotted
        self._compiled: dict[str, _Compiled] = {}

    def evaluate(self, text: str, names: Names) -> object:
        """Evaluate an expression.

        Raises:
            ExpressionError: a forbidden name or attribute, or a value or loop that is too large.
            Exception: as Python: SyntaxError, NameError, TypeError, ZeroDivisionError, …
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
                if forbidden := _FORBIDDEN.search(value):
                    raise ExpressionError(f"a text with the character {forbidden[0]!a}, which XML forbids")
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
            Exception: see `evaluate`.
        """
        value: Any = self.evaluate(text, names)
        return float(value)

    def check(self, text: str) -> None:
        """Compile an expression without evaluating it.

        Raises:
            ExpressionError: it is too long, or has a forbidden name.
            SyntaxError: it is not an expression.
        """
        self._compile(text)

    def _compile(self, text: str) -> _Compiled:
        if len(text) > _MAX_LENGTH:
            raise ExpressionError(f"an expression of more than {_MAX_LENGTH} characters")
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
        result = NotImplemented if dotted is None else dotted(owner, name)
        return attribute(owner, name) if result is NotImplemented else result

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
            restriction = " for an expression" if callable(callee) else ""
            raise TypeError(f"{type(callee).__name__!r} object is not callable{restriction}")
        return guarded(self, values, named)
