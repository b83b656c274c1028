"""xacro's ${…} with bounds: an expression of a hostile file may not take the machine's memory or an hour.

What honest files write gives what xacro gives. Powers, repetitions, shifts, ranges and comprehensions are counted.
"""

import ast
import operator
from collections.abc import Iterable, Iterator
from functools import lru_cache
from types import CodeType
from typing import Any, cast

_MOST_BITS = 100_000
_MOST_ITEMS = 1_000_000
"""Of one string, list or range, and of all comprehensions of one expression together."""
_GUARDED: dict[type[ast.operator], str] = {ast.Pow: "<power>", ast.Mult: "<times>", ast.LShift: "<shift>"}
"""Names that no file can write."""


class ExpressionTooLargeError(ValueError):
    """An expression whose value no robot needs."""


def bounded_eval(expression: str, symbols: Any, local_symbols: Any = None) -> object:
    """Evaluate as xacro's `safe_eval` does: no builtins, no names that begin with two underscores.

    Raises:
        ExpressionTooLargeError: a value or a loop is beyond all sense.
        Exception: whatever the expression itself raises.
    """
    code = _guarded(expression.strip())
    counter = _Counter()
    symbols.update(__builtins__={})
    guards = {"<power>": _power, "<times>": _times, "<shift>": _shift, "<counted>": counter, "<range>": _range}
    symbols.update(guards)
    try:
        return eval(code, symbols, local_symbols)
    finally:
        for name in guards:
            del symbols[name]


@lru_cache
def _guarded(expression: str) -> CodeType:
    """Macros ask for the same again and again."""
    tree = ast.parse(expression, "<expression>", "eval")
    code = compile(ast.fix_missing_locations(_Guard().visit(tree)), "<expression>", "eval")
    hidden = sorted({name for name in _names(tree) if name.startswith("__")})
    if hidden:
        raise ValueError(f"Use of invalid name(s): {', '.join(hidden)}")
    return code


class _Guard(ast.NodeTransformer):
    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        """a ** b becomes <power>(a, b)."""
        self.generic_visit(node)
        name = _GUARDED.get(type(node.op))
        return node if name is None else _call(name, node.left, node.right)

    def visit_comprehension(self, node: ast.comprehension) -> ast.comprehension:
        """Every turn is counted."""
        self.generic_visit(node)
        node.iter = _call("<counted>", node.iter)
        return node

    def visit_Call(self, node: ast.Call) -> ast.expr:
        """range(…) is looked at before it is made."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "range":
            node.func.id = "<range>"
        return node


class _Counter:
    def __init__(self) -> None:
        self._left = _MOST_ITEMS

    def __call__(self, items: Iterable[object]) -> Iterator[object]:
        for item in items:
            self._left -= 1
            if self._left < 0:
                raise ExpressionTooLargeError(f"a loop of more than {_MOST_ITEMS} turns")
            yield item


def _call(name: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(func=ast.Name(id=name, ctx=ast.Load()), args=list(arguments), keywords=[])


def _names(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr


def _power(base: Any, exponent: Any) -> object:
    if isinstance(base, int) and isinstance(exponent, int) and base.bit_length() * abs(exponent) > _MOST_BITS:
        raise ExpressionTooLargeError(f"a power of more than {_MOST_BITS} bits")
    return operator.pow(base, exponent)


def _times(left: Any, right: Any) -> object:
    for many, number in ((left, right), (right, left)):
        if isinstance(number, int) and isinstance(many, str | bytes | list | tuple):
            length = len(cast(list[object], many))
            if length * number > _MOST_ITEMS:
                raise ExpressionTooLargeError(f"a repetition of more than {_MOST_ITEMS} items")
    if isinstance(left, int) and isinstance(right, int) and left.bit_length() + right.bit_length() > _MOST_BITS:
        raise ExpressionTooLargeError(f"a product of more than {_MOST_BITS} bits")
    return operator.mul(left, right)


def _shift(left: Any, right: Any) -> object:
    if isinstance(right, int) and right > _MOST_BITS:
        raise ExpressionTooLargeError(f"a shift by more than {_MOST_BITS} bits")
    return operator.lshift(left, right)


def _range(*bounds: int) -> range:
    turns = range(*bounds)
    if len(turns) > _MOST_ITEMS:
        raise ExpressionTooLargeError(f"a range of more than {_MOST_ITEMS} numbers")
    return turns
