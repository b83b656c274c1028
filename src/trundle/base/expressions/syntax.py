"""Compiler from an expression to nested functions; syntax that is not listed is refused."""

import ast
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, TypeVar

from .budget import ExpressionError, bound_bits, bound_length
from .comprehensions import Comprehension, Loop
from .containers import item_of, mapping_of, set_of
from .formatting import converted, formatted
from .frames import Code, Evaluator, Frame, Lambda, Scopes, assignment, local_lookup, targets
from .operators import BINARY, COMPARISONS, FLOAT_OPERATORS, UNARY

_Part = TypeVar("_Part")


def compile_expression(text: str) -> tuple[Code, int, list[str]]:
    """Compile an expression; return its code, its number of operations, and its forbidden names.

    Raises:
        SyntaxError: it is not an expression.
        ExpressionError: it contains syntax that is refused.
        RecursionError, MemoryError: it is nested too deeply.
    """
    with warnings.catch_warnings():  # "1or 2" is legal, but Python warns
        warnings.simplefilter("ignore", SyntaxWarning)
        tree = ast.parse(text, "<expression>", "eval")
    compiler = _Compiler()
    code = compiler.visit(tree.body)
    return code, compiler.count, sorted(compiler.hidden)


class _Compiler(ast.NodeVisitor):
    """Visitor with a method per allowed kind of syntax."""

    def __init__(self) -> None:
        self._scopes: Scopes = ()
        self.count = 0
        """Operations so far."""
        self.hidden: set[str] = set()

    def visit(self, node: ast.AST) -> Any:
        """Compile a node."""
        self.count += 1
        return super().visit(node)

    def generic_visit(self, node: ast.AST) -> Any:
        """Refuse other syntax."""
        raise ExpressionError(f"{ast.unparse(node)[:100]!r} is not allowed in an expression")

    def _all(self, nodes: Sequence[ast.expr]) -> list[Code]:
        return [self.visit(node) for node in nodes]

    def _optional(self, node: ast.expr | None) -> Code:
        return _nothing if node is None else self.visit(node)

    def _within(self, names: Iterable[str], compile_part: Callable[[], _Part]) -> tuple[_Part, int]:
        """Compile a repeated part in its own frame; return it and its number of operations."""
        scopes, before = self._scopes, self.count
        self._scopes = (frozenset(map(self._visible, names)), *scopes)
        try:
            return compile_part(), self.count - before + 1
        finally:
            self._scopes = scopes

    def _visible(self, name: str) -> str:
        if name.startswith("__") and name != "__len__":
            self.hidden.add(name)
        return name

    def visit_Constant(self, node: ast.Constant) -> Code:
        value = node.value
        if not (value is None or isinstance(value, str | int | float | complex)):
            raise ExpressionError(f"{ast.unparse(node)[:100]!r} is not allowed in an expression")
        bound_bits(value.bit_length() if isinstance(value, int) else 0)
        return lambda _running, _frame: value

    def visit_Name(self, node: ast.Name) -> Code:
        name = self._visible(node.id)
        for depth, names in enumerate(self._scopes):
            if name in names:
                return local_lookup(name, depth)
        return lambda running, _frame: running.look_up(name)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> Code:
        operand, operation = self.visit(node.operand), UNARY[type(node.op)]
        return lambda running, frame: operation(running.budget, operand(running, frame))

    def visit_BinOp(self, node: ast.BinOp) -> Code:
        left, right = self.visit(node.left), self.visit(node.right)
        operation, on_floats = BINARY.get(type(node.op)), FLOAT_OPERATORS.get(type(node.op))
        if operation is None:
            raise ExpressionError("products of matrices are not allowed in an expression")
        if on_floats is None:
            return lambda running, frame: operation(running.budget, left(running, frame), right(running, frame))

        def code(running: Evaluator, frame: Frame) -> Any:
            a, b = left(running, frame), right(running, frame)
            if a.__class__ is float or b.__class__ is float:
                return on_floats(a, b)
            return operation(running.budget, a, b)

        return code

    def visit_BoolOp(self, node: ast.BoolOp) -> Code:
        conjunction, values = isinstance(node.op, ast.And), self._all(node.values)

        def code(running: Evaluator, frame: Frame) -> Any:
            value: Any = conjunction
            for item in values:
                value = item(running, frame)
                if bool(value) is not conjunction:
                    break
            return value

        return code

    def visit_Compare(self, node: ast.Compare) -> Code:
        first = self.visit(node.left)
        rest = [(COMPARISONS[type(op)], self.visit(item)) for op, item in zip(node.ops, node.comparators, strict=True)]

        def code(running: Evaluator, frame: Frame) -> Any:
            left, result = first(running, frame), True
            for comparison, item in rest:
                right = item(running, frame)
                result = comparison(running.budget, left, right)
                if not result:
                    break
                left = right
            return result

        return code

    def visit_IfExp(self, node: ast.IfExp) -> Code:
        test, body, orelse = self._all([node.test, node.body, node.orelse])
        return lambda running, frame: body(running, frame) if test(running, frame) else orelse(running, frame)

    def visit_Attribute(self, node: ast.Attribute) -> Code:
        owner, name = self.visit(node.value), self._visible(node.attr)
        return lambda running, frame: running.attribute(owner(running, frame), name)

    def visit_Subscript(self, node: ast.Subscript) -> Code:
        owner, index = self.visit(node.value), self.visit(node.slice)
        return lambda running, frame: item_of(running, owner(running, frame), index(running, frame))

    def visit_Slice(self, node: ast.Slice) -> Code:
        parts = [self._optional(part) for part in (node.lower, node.upper, node.step)]
        return lambda running, frame: slice(*(part(running, frame) for part in parts))

    def _items(self, nodes: Sequence[ast.expr]) -> Callable[[Evaluator, Frame], list[Any]]:
        """Compile list items or call arguments, including `*several`."""
        if not any(isinstance(node, ast.Starred) for node in nodes):
            codes = self._all(nodes)
            return lambda running, frame: [code(running, frame) for code in codes]
        parts = [
            (isinstance(node, ast.Starred), self.visit(node.value if isinstance(node, ast.Starred) else node))
            for node in nodes
        ]

        def code(running: Evaluator, frame: Frame) -> list[Any]:
            result: list[Any] = []
            for several, part in parts:
                value = part(running, frame)
                result += running.budget.collect(value) if several else [value]
                bound_length(len(result))
            return result

        return code

    def visit_List(self, node: ast.List) -> Code:
        return self._display(node.elts, list)

    def visit_Tuple(self, node: ast.Tuple) -> Code:
        return self._display(node.elts, tuple)

    def visit_Set(self, node: ast.Set) -> Code:
        return self._display(node.elts, set)

    def _display(self, nodes: Sequence[ast.expr], kind: type) -> Code:
        items = self._items(nodes)

        def code(running: Evaluator, frame: Frame) -> Any:
            result = items(running, frame)
            running.budget.allocate(60 + 8 * len(result))
            return result if kind is list else tuple(result) if kind is tuple else set_of(running, result)

        return code

    def visit_Dict(self, node: ast.Dict) -> Code:
        pairs = [
            (key is not None, self._optional(key), self.visit(value))
            for key, value in zip(node.keys, node.values, strict=True)
        ]

        def code(running: Evaluator, frame: Frame) -> dict[Any, Any]:
            result: dict[Any, Any] = {}
            running.budget.allocate(64 + 100 * len(pairs))
            for single, key, value in pairs:
                if single:
                    result[running.budget.spend_lookup(key(running, frame), len(result))] = value(running, frame)
                else:
                    more = mapping_of(running, value(running, frame))
                    running.budget.spend_keys(result, more)
                    result.update(more)
                    bound_length(len(result))
            return result

        return code

    def visit_Call(self, node: ast.Call) -> Code:
        callee, values = self.visit(node.func), self._items(node.args)
        if not node.keywords:
            return lambda running, frame: running.call(callee(running, frame), values(running, frame), {})
        words = [(word.arg, self.visit(word.value)) for word in node.keywords]

        def code(running: Evaluator, frame: Frame) -> Any:
            function, arguments, named = callee(running, frame), values(running, frame), dict[str, Any]()
            for name, word in words:
                more = {name: word(running, frame)} if name else mapping_of(running, word(running, frame))
                if duplicates := named.keys() & more.keys():
                    raise TypeError(f"got multiple values for keyword argument {min(duplicates)!r}")
                named.update(more)
            return running.call(function, arguments, named)

        return code

    def visit_Lambda(self, node: ast.Lambda) -> Code:
        arguments = node.args
        all_arguments = (
            *arguments.posonlyargs,
            *arguments.args,
            *arguments.kwonlyargs,
            arguments.vararg,
            arguments.kwarg,
        )
        names = [argument.arg for argument in all_arguments if argument]
        defaults = {argument.arg: self.visit(value) for argument, value in _defaults(arguments)}
        body, cost = self._within(names, lambda: self.visit(node.body))

        def code(running: Evaluator, frame: Frame) -> Lambda:
            values = {name: default(running, frame) for name, default in defaults.items()}
            running.budget.allocate(200 + 100 * len(values))
            return Lambda(arguments, values, body, cost, running, frame)

        return code

    def visit_ListComp(self, node: ast.ListComp) -> Code:
        comprehension = self._comprehension([node.elt], node.generators)
        return lambda running, frame: [value for (value,) in comprehension.evaluate(running, frame)]

    def visit_SetComp(self, node: ast.SetComp) -> Code:
        comprehension = self._comprehension([node.elt], node.generators)
        return lambda running, frame: set_of(running, (value for (value,) in comprehension.evaluate(running, frame)))

    def visit_GeneratorExp(self, node: ast.GeneratorExp) -> Code:
        comprehension = self._comprehension([node.elt], node.generators)

        def code(running: Evaluator, frame: Frame) -> Iterator[Any]:
            rows = comprehension.evaluate(running, frame)
            return running.budget.lazy(value for (value,) in rows)

        return code

    def visit_DictComp(self, node: ast.DictComp) -> Code:
        comprehension = self._comprehension([node.key, node.value], node.generators)

        def code(running: Evaluator, frame: Frame) -> dict[Any, Any]:
            result: dict[Any, Any] = {}
            for key, value in comprehension.evaluate(running, frame):
                running.budget.allocate(100)
                result[running.budget.spend_lookup(key, len(result))] = value
            return result

        return code

    def _comprehension(self, elements: list[ast.expr], generators: list[ast.comprehension]) -> Comprehension:
        if any(generator.is_async for generator in generators):
            raise ExpressionError("'async' is not allowed in an expression")
        names = {name for generator in generators for name in targets(generator.target)}
        first = self.visit(generators[0].iter)  # in the enclosing frame, as in Python

        def compile_parts() -> tuple[list[Loop], list[Code]]:
            loops = [
                Loop(self.visit(part.iter) if index else first, assignment(part.target), self._all(part.ifs))
                for index, part in enumerate(generators)
            ]
            return loops, self._all(elements)

        (loops, codes), cost = self._within(names, compile_parts)
        return Comprehension(loops, codes, cost)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> Code:
        parts = self._all(node.values)

        def code(running: Evaluator, frame: Frame) -> str:
            texts = [part(running, frame) for part in parts]
            bound_length(sum(map(len, texts)))
            return running.budget.allocate_text("".join(texts))

        return code

    def visit_FormattedValue(self, node: ast.FormattedValue) -> Code:
        value, spec = self.visit(node.value), self._optional(node.format_spec)
        conversion = None if node.conversion < 0 else chr(node.conversion)

        def code(running: Evaluator, frame: Frame) -> str:
            converted_value = converted(running.budget, value(running, frame), conversion)
            return formatted(running.budget, converted_value, spec(running, frame) or "")

        return code


def _nothing(*_: object) -> None:
    return None


def _defaults(arguments: ast.arguments) -> Iterable[tuple[ast.arg, ast.expr]]:
    """Yield the arguments of a lambda that have a default."""
    positional = [*arguments.posonlyargs, *arguments.args]
    last = positional[len(positional) - len(arguments.defaults) :]
    by_name = zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    yield from zip(last, arguments.defaults, strict=True)
    yield from ((argument, value) for argument, value in by_name if value is not None)
