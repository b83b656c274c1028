"""Comprehensions: nested loops with conditions."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from .frames import Assignment, Code, Evaluator, Frame


class Loop(NamedTuple):
    """One `for … in … if …`."""

    items: Code
    assign: Assignment
    conditions: Sequence[Code]


class Comprehension(NamedTuple):
    """Nested loops and the elements of each iteration."""

    loops: Sequence[Loop]
    elements: Sequence[Code]
    cost: int
    """Operations per iteration."""

    def evaluate(self, running: Evaluator, enclosing: Frame) -> Iterator[list[object]]:
        """Evaluate the outermost iterable, and iterate over the elements."""
        running.budget.allocate_generator()
        return self._iterate(running, {None: enclosing}, 0, iter(self.loops[0].items(running, enclosing)))

    def _iterate(self, running: Evaluator, frame: Frame, index: int, items: Iterator[Any]) -> Iterator[list[Any]]:
        assert frame is not None
        _, assign, conditions = self.loops[index]
        for item in items:
            running.budget.spend(self.cost)
            assign(running, frame, item)
            if not all(condition(running, frame) for condition in conditions):
                continue
            if index + 1 < len(self.loops):
                inner = iter(self.loops[index + 1].items(running, frame))
                yield from self._iterate(running, frame, index + 1, inner)
            else:
                running.budget.allocate(64)
                yield [element(running, frame) for element in self.elements]
