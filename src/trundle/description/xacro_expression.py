"""xacro's ${…} with bounds: an expression of a hostile file may not take the machine's memory or an hour.

What honest files write gives what xacro gives. Whatever can grow is looked at before it does: sums, products, powers,
shifts, formatted texts and methods of text; turns of comprehensions and of lambdas are counted.
"""

import ast
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache, reduce
from types import CodeType
from typing import Any, NamedTuple, cast

_MOST_BITS = 100_000
_MOST_ITEMS = 1_000_000
"""Of one text, list or range."""
_MOST_TURNS = 1_000_000
"""Of all comprehensions and lambdas of one file together."""
_OPERATIONS: dict[type[ast.operator], str] = {
    ast.Add: "<plus>",
    ast.Mod: "<modulo>",
    ast.Mult: "<times>",
    ast.Pow: "<power>",
    ast.LShift: "<shift>",
}
"""Names that no file can write."""
_GROWING = frozenset(
    ["center", "expandtabs", "format", "format_map", "join", "ljust", "replace", "rjust", "translate", "zfill"]
)
"""Methods of text whose result may be much longer than what they are given."""
_WIDE = r"\d{5}|\*|\{[^{}]*\{|__"
"""In a format: a width beyond all sense, or from elsewhere, or a way to what no name may reach."""

_HARMLESS = {"__len__"}
"""Asked for before xacro 1.13.13 refused all such names: xArm's description has robot_sn.__len__()."""

_LONG: Any = (str, bytes, list, tuple)


class ExpressionTooLargeError(ValueError):
    """An expression whose value no robot needs."""


class _Guarded(NamedTuple):
    code: CodeType
    hidden: list[str]
    """Names that only reach for Python itself."""


class Evaluator:
    """Evaluates the expressions of one file as xacro's `safe_eval` does: no builtins, no names that begin with `__`."""

    def __init__(self) -> None:
        self._turns_left = _MOST_TURNS
        # Where Python looks last: a property that is evaluated amid another expression finds them too.
        self._builtins = {**_GUARDS, "<counted>": self._counted, "<turn>": self._turn}

    def __call__(self, expression: str, symbols: dict[str, Any], local_symbols: Mapping[str, Any] | None = None) -> Any:
        """Evaluate an expression.

        Raises:
            ExpressionTooLargeError: a value or a loop is beyond all sense.
            Exception: whatever the expression itself raises.
        """
        code, hidden = _guarded(expression.strip())
        if hidden:
            raise ValueError(f"Use of invalid name(s): {', '.join(hidden)}")
        symbols.update(__builtins__=self._builtins)
        value = eval(code, symbols, local_symbols)
        if isinstance(value, str | list | tuple | dict):
            _bound_size(cast(object, value))
        return value

    def _turn(self) -> None:
        self._turns_left -= 1
        if self._turns_left < 0:
            raise ExpressionTooLargeError(f"loops of more than {_MOST_TURNS} turns")

    def _counted(self, items: Iterable[object]) -> Iterator[object]:
        for item in items:
            self._turn()
            yield item


@lru_cache
def _guarded(expression: str) -> _Guarded:
    """Macros ask for the same again and again, and most for one name."""
    if expression.isascii() and expression.isidentifier() and expression[0] != "_":
        return _Guarded(compile(expression, "<expression>", "eval"), [])
    tree = ast.parse(expression, "<expression>", "eval")
    may_hide = (
        "__" in expression or not expression.isascii()
    )  # other scripts have underscores that Python takes for ours
    hidden = sorted({name for name in _names(tree) if name.startswith("__")} - _HARMLESS) if may_hide else []
    return _Guarded(compile(ast.fix_missing_locations(_Guard().visit(tree)), "<expression>", "eval"), hidden)


class _Guard(ast.NodeTransformer):
    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        """a ** b becomes <power>(a, b); what is no whole number makes nothing long."""
        self.generic_visit(node)
        name = _OPERATIONS.get(type(node.op))
        if name is None or _is_fraction(node.left) or _is_fraction(node.right):
            return node
        return _call(name, node.left, node.right)

    def visit_comprehension(self, node: ast.comprehension) -> ast.comprehension:
        """Every turn is counted."""
        self.generic_visit(node)
        node.iter = _call("<counted>", node.iter)
        return node

    def visit_Lambda(self, node: ast.Lambda) -> ast.Lambda:
        """Every call is counted."""
        self.generic_visit(node)
        node.body = ast.Subscript(
            value=ast.Tuple(elts=[_call("<turn>"), node.body], ctx=ast.Load()), slice=ast.Constant(1), ctx=ast.Load()
        )
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        """text.join becomes <method>(text, 'join')."""
        self.generic_visit(node)
        return _call("<method>", node.value, ast.Constant(node.attr)) if node.attr in _GROWING else node

    def visit_FormattedValue(self, node: ast.FormattedValue) -> ast.FormattedValue:
        """f'{x:9}' becomes f'{<formatted>(x, "9")}'."""
        self.generic_visit(node)
        if node.format_spec is not None and node.conversion == -1:
            node.value, node.format_spec = _call("<formatted>", node.value, node.format_spec), None
        return node


def _is_fraction(node: ast.expr) -> bool:
    """Whether an operand is a float for certain: a quotient, or written with a point."""
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.Div)
    return isinstance(node, ast.Constant) and isinstance(node.value, float)


def _call(name: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(func=ast.Name(id=name, ctx=ast.Load()), args=list(arguments), keywords=[])


def _names(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr


def _bound_size(value: object) -> None:
    """Refuse what would be too long as text; a list may hold another many times over."""
    left, pending = _MOST_ITEMS, [value]
    while pending:
        each = pending.pop()
        left -= len(each) if isinstance(each, str) else 1
        if left < 0:
            raise ExpressionTooLargeError(f"a value of more than {_MOST_ITEMS} characters or items")
        if isinstance(each, dict):
            pending += cast(dict[object, object], each).values()
        elif isinstance(each, list | tuple):
            pending += cast(list[object], each)[: left + 1]


def _bound_bits(bits: float) -> None:
    if bits > _MOST_BITS:
        raise ExpressionTooLargeError(f"a number of more than {_MOST_BITS} bits")


def _bound_length(length: int) -> None:
    if length > _MOST_ITEMS:
        raise ExpressionTooLargeError(f"a text, list or range of more than {_MOST_ITEMS} items")


def _plus(left: Any, right: Any) -> Any:
    if isinstance(left, _LONG) and isinstance(right, _LONG):
        _bound_length(len(left) + len(right))
    return left + right


def _modulo(left: Any, right: Any) -> Any:
    if isinstance(left, str | bytes):
        _check_format(left)
    return left % right


def _times(left: Any, right: Any) -> Any:
    for many, number in ((left, right), (right, left)):
        if isinstance(number, int) and isinstance(many, _LONG):
            _bound_length(len(many) * number)
    if isinstance(left, int) and isinstance(right, int):
        _bound_bits(left.bit_length() + right.bit_length())
    return left * right


def _power(base: Any, exponent: Any) -> Any:
    if isinstance(base, int) and isinstance(exponent, int):
        _bound_bits(base.bit_length() * abs(exponent))
    return base**exponent


def _shift(left: Any, right: Any) -> Any:
    if isinstance(left, int) and isinstance(right, int):
        _bound_bits(left.bit_length() + right)
    return left << right


def _check_format(text: str | bytes) -> None:
    if re.search(_WIDE, text if isinstance(text, str) else text.decode("latin-1")):
        raise ExpressionTooLargeError(f"the format {text[:50]!r} is not supported")


def _formatted(value: object, spec: str) -> str:
    _check_format(spec)
    return format(value, spec)


def _method(owner: Any, name: str) -> Any:
    if owner in (str, bytes):
        raise ExpressionTooLargeError(f"{owner.__name__}.{name} of no text is not supported")
    if not isinstance(owner, str | bytes):
        return getattr(owner, name)
    text: Any = owner

    def bounded(*arguments: Any, **named: Any) -> Any:
        values: list[Any] = [list(each) if name == "join" else each for each in arguments]
        if name.startswith("format"):
            _check_format(text)
        elif name == "replace":
            _bound_length((len(text) + 1) * (1 + len(values[1])))
        elif name == "join":
            _bound_length(sum(len(each) + len(text) for each in values[0]))
        elif name == "translate":
            _bound_length(len(text) * max([1, *(len(str(each)) for each in values[0].values())]))
        else:
            size = max((each for each in (*values, *named.values()) if isinstance(each, int)), default=8)
            _bound_length(size * (text.count("\t") + 1 if name == "expandtabs" else 1))
        return getattr(text, name)(*values, **named)

    return bounded


def _range(*bounds: int) -> range:
    turns = range(*bounds)
    _bound_length(len(turns))
    return turns


def _of_small(function: Callable[..., int]) -> Callable[..., int]:
    def bounded(*numbers: int) -> int:
        _bound_bits(max((abs(number) * 16 for number in numbers), default=0))
        return function(*numbers)

    return bounded


def _lcm(*numbers: int) -> int:
    _bound_bits(sum(number.bit_length() for number in numbers))
    return math.lcm(*numbers)


def _prod(items: Iterable[Any], *, start: Any = 1) -> Any:
    return reduce(_times, items, start)


_GUARDS: dict[str, Callable[..., Any]] = {
    "<plus>": _plus,
    "<modulo>": _modulo,
    "<times>": _times,
    "<power>": _power,
    "<shift>": _shift,
    "<method>": _method,
    "<formatted>": _formatted,
}
BOUNDED: dict[str, Callable[..., Any]] = {
    "range": _range,
    "factorial": _of_small(math.factorial),
    "comb": _of_small(math.comb),
    "perm": _of_small(math.perm),
    "lcm": _lcm,
    "prod": _prod,
}
"""What takes the place of functions of the same name."""
