"""Local names of lambdas and comprehensions."""

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Protocol

from .budget import ExpressionError
from .values import Callee, Caller

Frame = dict[Any, Any] | None
"""Local values of a lambda or comprehension; the key None holds the enclosing frame."""
Scopes = tuple[frozenset[str], ...]
"""Names of every frame, innermost first."""


class Evaluator(Caller, Protocol):
    """Evaluation, as seen by its operations."""

    def look_up(self, name: str) -> object:
        """Return the value of a document's name."""
        ...

    def attribute(self, owner: object, name: str) -> object:
        """Return an attribute of a value."""
        ...


Code = Callable[[Evaluator, Frame], Any]
Assignment = Callable[[Evaluator, dict[object, object], object], None]


def local_lookup(name: str, depth: int) -> Code:
    """Return code that looks up a name `depth` frames out."""

    def code(_running: Evaluator, frame: Frame) -> Any:
        for _ in range(depth):
            frame = frame[None] if frame is not None else None
        if frame is None or name not in frame:
            raise NameError(f"name {name!r} is not defined")
        return frame[name]

    return code


def targets(target: ast.expr) -> Iterator[str]:
    """Names that `for TARGET in …` sets."""
    match target:
        case ast.Name(id=name):
            yield name
        case ast.Tuple(elts=items) | ast.List(elts=items):
            for item in items:
                yield from targets(item)
        case ast.Starred(value=value):
            yield from targets(value)
        case _:
            raise ExpressionError(f"{ast.unparse(target)[:100]!r} cannot be set in an expression")


def assignment(target: ast.expr) -> Assignment:
    """Compile the assignment of `for TARGET in …`."""
    if isinstance(target, ast.Name):
        name = target.id

        def set_one(_running: Evaluator, frame: dict[Any, Any], item: Any) -> None:
            frame[name] = item

        return set_one
    if not isinstance(target, ast.Tuple | ast.List):
        raise ExpressionError(f"{ast.unparse(target)[:100]!r} cannot be set in an expression")
    stars = [index for index, element in enumerate(target.elts) if isinstance(element, ast.Starred)]
    parts = [assignment(elem.value if isinstance(elem, ast.Starred) else elem) for elem in target.elts]

    def set_several(running: Evaluator, frame: dict[Any, Any], item: Any) -> None:
        values = running.budget.collect(item)
        if stars and len(values) >= len(parts) - 1:
            stop = len(values) - (len(parts) - 1 - stars[0])
            values[stars[0] : stop] = [values[stars[0] : stop]]
        if len(values) < len(parts):
            raise ValueError(f"not enough values to unpack (expected {len(parts)}, got {len(values)})")
        if len(values) > len(parts):
            raise ValueError(f"too many values to unpack (expected {len(parts)})")
        for part, value in zip(parts, values, strict=True):
            part(running, frame, value)

    return set_several


_STEPS_PER_CALL = 15


class Lambda(Callee):
    """Function created by an expression."""

    __slots__ = ("_body", "_cost", "_defaults", "_enclosing", "_running", "_signature")

    def __init__(
        self,
        signature: ast.arguments,
        defaults: Mapping[str, object],
        body: Code,
        cost: int,
        running: Evaluator,
        enclosing: Frame,
    ) -> None:
        self._signature, self._defaults, self._body, self._cost = signature, defaults, body, cost
        self._running, self._enclosing = running, enclosing

    def call(self, _caller: Caller, values: Sequence[object], named: Mapping[str, object], /) -> object:
        arguments = self._signature
        positional = [argument.arg for argument in (*arguments.posonlyargs, *arguments.args)]
        count = len(positional) + len(arguments.kwonlyargs) + len(named)
        self._running.budget.spend(_STEPS_PER_CALL + self._cost + len(values) + count)
        self._running.budget.allocate(100 * count + 8 * len(values))  # a value that outlives the call may use the frame
        frame: dict[Any, Any] = {None: self._enclosing, **self._defaults}
        frame.update(zip(positional, values, strict=False))
        surplus = tuple(values[len(positional) :])
        if arguments.vararg:
            frame[arguments.vararg.arg] = surplus
        elif surplus:
            raise TypeError(f"<lambda>() takes {len(positional)} positional arguments but {len(values)} were given")
        by_name = {argument.arg for argument in (*arguments.args, *arguments.kwonlyargs)} - set(
            positional[: len(values)]
        )
        unexpected = {name: value for name, value in named.items() if name not in by_name}
        if arguments.kwarg:
            frame[arguments.kwarg.arg] = unexpected
        elif unexpected:
            raise TypeError(f"<lambda>() got an unexpected or second argument {min(unexpected)!r}")
        frame.update((name, value) for name, value in named.items() if name in by_name)
        if missing := [
            name for name in (*positional, *(argument.arg for argument in arguments.kwonlyargs)) if name not in frame
        ]:
            raise TypeError(f"<lambda>() missing the argument {missing[0]!r}")
        return self._body(self._running, frame)

    def __repr__(self) -> str:
        return "<function <lambda>>"
