"""Evaluates the Python expressions of `$(eval …)` and `rad(…)` without Python's own eval.

Only the syntax, names and text methods that launch files use are known: no attribute of an object can be reached,
nothing can be imported, and no value can grow without bound, so a file from the network is safe to read.
"""

import ast
import operator
import warnings
from collections.abc import Callable, Mapping
from typing import Any

from .bounded import ExpressionError, check_format, limit, limit_all_of

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
    ast.LShift: operator.lshift,
    ast.RShift: operator.rshift,
}
_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.Not: operator.not_,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
    ast.Invert: operator.invert,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda a, b: a in b,
    ast.NotIn: lambda a, b: a not in b,
}
_METHODS = frozenset(
    {
        "capitalize",
        "count",
        "endswith",
        "find",
        "format",
        "get",
        "index",
        "isalnum",
        "isalpha",
        "isdigit",
        "items",
        "join",
        "keys",
        "lower",
        "lstrip",
        "replace",
        "rsplit",
        "rstrip",
        "split",
        "startswith",
        "strip",
        "title",
        "upper",
        "values",
        "zfill",
    }
)


def evaluate(text: str, names: Mapping[str, Any]) -> Any:
    """Evaluate an expression.

    Raises:
        ExpressionError: bad syntax, something not allowed, an unknown name, or an error of the arithmetic itself.
    """
    # roslaunch's own rule, and its own words.
    if "__" in text:
        raise ExpressionError("may not contain double underscores")
    try:
        with warnings.catch_warnings():  # "1or 2" is legal, and Python says what it thinks of it
            warnings.simplefilter("ignore", SyntaxWarning)
            tree = ast.parse(text.strip(), mode="eval")
        value = _Evaluation(names).visit(tree.body)
        limit_all_of(value)
        return value
    except SyntaxError as error:
        raise ExpressionError(f"not a Python expression: {error.msg}") from None
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        raise ExpressionError(str(error) or type(error).__name__) from None
    except (RecursionError, MemoryError):
        raise ExpressionError("nested too deeply") from None


class _Evaluation:
    """One walk over one syntax tree."""

    def __init__(self, names: Mapping[str, Any]) -> None:
        self._names = names

    def visit(self, node: ast.expr) -> Any:
        match node:
            case ast.Constant(value=value) if isinstance(value, str | int | float | bool) or value is None:
                return value
            case ast.Name(id=name):
                if name not in self._names:
                    raise ExpressionError(f"unknown name {name!r}")
                return self._names[name]
            case ast.UnaryOp(op=op, operand=operand):
                return _UNARY[type(op)](self.visit(operand))
            case ast.BinOp(left=left, op=op, right=right):
                return self._binary(op, self.visit(left), self.visit(right))
            case ast.BoolOp(op=op, values=values):
                return self._boolean(isinstance(op, ast.And), values)
            case ast.Compare():
                return self._compare(node)
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self.visit(body) if self.visit(test) else self.visit(orelse)
            case ast.List(elts=items):
                return [self.visit(item) for item in items]
            case ast.Tuple(elts=items):
                return tuple(self.visit(item) for item in items)
            case ast.Dict(keys=keys, values=values) if all(key is not None for key in keys):
                return {self.visit(k): self.visit(v) for k, v in zip(keys, values, strict=True) if k is not None}
            case ast.Subscript(value=value, slice=index):
                return self.visit(value)[self._index(index)]
            case ast.Call(func=function, args=arguments, keywords=named) if all(word.arg for word in named):
                values = {str(word.arg): self.visit(word.value) for word in named}
                return self._call(function, [self.visit(argument) for argument in arguments], values)
            case _:
                raise ExpressionError(f"{ast.unparse(node)!r} is not allowed here")

    def _index(self, node: ast.expr) -> Any:
        if isinstance(node, ast.Slice):
            return slice(*(None if part is None else self.visit(part) for part in (node.lower, node.upper, node.step)))
        return self.visit(node)

    def _binary(self, op: ast.operator, left: Any, right: Any) -> Any:
        if type(op) not in _BINARY:
            raise ExpressionError("matrix products are not allowed here")
        if isinstance(op, ast.Mod) and isinstance(left, str):
            check_format(left, right if isinstance(right, tuple) else (right,))
        if isinstance(op, ast.LShift) and isinstance(right, int):
            limit(right)
        if isinstance(op, ast.Pow) and isinstance(left, int) and isinstance(right, int):
            limit(left.bit_length() * abs(right))
        if isinstance(op, ast.Mult):
            for sequence, count in ((left, right), (right, left)):
                if isinstance(sequence, str | list | tuple) and isinstance(count, int):
                    limit(len(sequence) * count)
        value = _BINARY[type(op)](left, right)
        limit(value.bit_length() if isinstance(value, int) else len(value) if hasattr(value, "__len__") else 0)
        return value

    def _boolean(self, conjunction: bool, values: list[ast.expr]) -> Any:
        value: Any = conjunction
        for item in values:
            value = self.visit(item)
            if bool(value) is not conjunction:
                break
        return value

    def _compare(self, node: ast.Compare) -> bool:
        left = self.visit(node.left)
        for op, item in zip(node.ops, node.comparators, strict=True):
            right = self.visit(item)
            if not _COMPARE[type(op)](left, right):
                return False
            left = right
        return True

    def _call(self, function: ast.expr, arguments: list[Any], named: dict[str, Any]) -> Any:
        match function:
            case ast.Name(id=name):
                callee = self.visit(function)
                if not callable(callee):
                    raise ExpressionError(f"{name!r} is not a function")
                if named and name != "dict":
                    raise ExpressionError(f"{name!r} takes no named arguments here")
                value = callee(*arguments, **named)
            case ast.Attribute(value=owner, attr=name) if name in _METHODS:
                subject = self.visit(owner)
                if not isinstance(subject, str | list | tuple | dict):
                    raise ExpressionError(f"{ast.unparse(function)!r} is not allowed here")
                if name == "replace":  # the longest text it can make
                    limit(len(subject) * sum(len(str(a)) for a in arguments))
                if name == "join" and arguments:
                    limit(sum(len(subject) + len(item) for item in arguments[0]))
                if name == "zfill":
                    limit(*arguments)
                if name == "format" and isinstance(subject, str):
                    check_format(subject, (*arguments, *named.values()))
                value = getattr(subject, name)(*arguments, **named)
            case _:
                raise ExpressionError(f"{ast.unparse(function)!r} may not be called here")
        return value
