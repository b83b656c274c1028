"""Budget of time and memory for the expressions of one document."""

from collections.abc import Iterable, Iterator
from typing import TypeVar, cast

MAX_ITEMS = 1_000_000
"""Characters or items of one value."""
MAX_BITS = 100_000
"""Size of one integer."""
_MAX_STEPS = 3_000_000
"""Step budget; a step is one operation of about 0.2 µs. The PR2, the largest of the published robots, takes 19,000."""
_MAX_OCTETS = 96 * 1024 * 1024
"""Memory budget for all values of one document; the PR2 needs 160,000."""
_MAX_DEPTH = 100
"""Nesting depth of iterators."""

_Item = TypeVar("_Item")
_GROUPS = (list, tuple, set, frozenset, type({}.keys()), type({}.values()), type({}.items()))
_SMALL = 1 << 61
"""Bound below which an integer is its own hash."""


class ExpressionError(ValueError):
    """Refused expression, with the reason."""


class Budget:
    """Remaining steps and memory of one document."""

    def __init__(self, steps: int = _MAX_STEPS, octets: int = _MAX_OCTETS) -> None:
        self._steps, self._octets = steps, octets
        self._most_steps, self._most_octets = steps, octets
        self.depth = 0
        """Nesting depth of iterators in progress."""

    @property
    def spent(self) -> tuple[int, int]:
        """Steps and octets used."""
        return self._most_steps - self._steps, self._most_octets - self._octets

    def spend(self, steps: int) -> None:
        """Use steps.

        Raises:
            ExpressionError: the budget is exhausted.
        """
        self._steps -= steps
        if self._steps < 0:
            raise ExpressionError(f"the expressions of one file may take at most {self._most_steps} steps")

    def allocate(self, octets: int) -> None:
        """Use memory, which is never returned, because a property may keep any value.

        Raises:
            ExpressionError: the budget is exhausted.
        """
        self._octets -= octets
        if self._octets < 0:
            raise ExpressionError(
                f"the expressions of one file may make at most {self._most_octets >> 20} MiB of values"
            )

    def allocate_generator(self) -> None:
        """Use the steps and memory of a generator object."""
        self.spend(20)
        self.allocate(800)

    def lazy(self, items: Iterator[object]) -> "LazyIterator":
        """Wrap a lazily evaluated iterator for use by expressions."""
        self.allocate_generator()
        return LazyIterator(self, items)

    def allocate_text(self, text: str) -> str:
        """Use the memory of a text that was just created."""
        self.allocate(50 + (len(text) if text.isascii() else 4 * len(text)))
        return text

    def iterate(self, items: Iterable[_Item], steps: int = 1) -> Iterator[_Item]:
        """Iterate with a cost in steps per item."""
        for item in items:
            self.spend(steps)
            yield item

    def collect(self, items: Iterable[_Item]) -> list[_Item]:
        """Return the items of an iterable as a list."""
        found: list[_Item] = []
        for item in items:
            self.spend(1)
            self.allocate(40)
            found.append(item)
        bound_length(len(found))
        return found

    def spend_traversal(self, value: object) -> int:
        """Use the steps of traversing a value, shared parts as often as they occur; return its length as text.

        Raises:
            ExpressionError: it is longer than a value may be, or infinite.
        """
        size, pending = 0, [value]
        while pending:
            each = pending.pop()
            if isinstance(each, str):
                size += len(each) + 2
            elif isinstance(each, dict):
                size += 4 * len(each)
                if size <= MAX_ITEMS:
                    pending.extend(dict.keys(each))
                    pending.extend(dict.values(each))
            elif isinstance(each, _GROUPS):
                size += 2 * len(each)
                if size <= MAX_ITEMS:
                    pending.extend(list.__iter__(each) if isinstance(each, list) else each)
            elif isinstance(each, slice):
                size += 8
                pending += [each.start, each.stop, each.step]
            else:
                size += each.bit_length() // 3 + 1 if isinstance(each, int) else 1
            if size > MAX_ITEMS:
                raise ExpressionError(f"a value of more than {MAX_ITEMS} characters or items")
            self.spend(1)
        self.spend(size >> 6)
        return size

    def spend_lookup(self, key: _Item, among: int) -> _Item:
        """Use the steps of looking up a key in a dictionary or set of that size."""
        if isinstance(key, tuple | frozenset):
            self.spend_traversal(key)
            _bound_depth(cast("tuple[object, ...]", key))
            self.spend(among >> 4)  # their hashes may all collide
        elif isinstance(key, int) and not -_SMALL < key < _SMALL:
            self.spend(key.bit_length() >> 6)
            self.spend(among >> 4)
        return key


class LazyIterator:
    """Lazy iterator with bounded nesting; Python 3.11 crashes on thousands of nested generators."""

    __slots__ = ("_budget", "_items")

    def __init__(self, budget: Budget, items: Iterator[object]) -> None:
        self._budget, self._items = budget, items

    def __iter__(self) -> Iterator[object]:
        return self

    def __next__(self) -> object:
        self._budget.depth += 1
        try:
            if self._budget.depth > _MAX_DEPTH:
                raise ExpressionError("an expression or a value nested too deeply")
            return next(self._items)
        finally:
            self._budget.depth -= 1


def _bound_depth(key: Iterable[object]) -> None:
    """Refuse deeply nested tuples, which Python hashes with unbounded recursion."""
    for _ in range(_MAX_DEPTH):
        key = [part for each in key if isinstance(each, tuple | frozenset) for part in cast("tuple[object, ...]", each)]
        if not key:
            return
    raise ExpressionError("an expression or a value nested too deeply")


def bound_length(length: float) -> None:
    """Refuse a text, list or range beyond the maximum length."""
    if length > MAX_ITEMS:
        raise ExpressionError(f"a text, list or range of more than {MAX_ITEMS} items")


def bound_bits(bits: float) -> None:
    """Refuse an integer beyond the maximum number of bits."""
    if bits > MAX_BITS:
        raise ExpressionError(f"a number of more than {MAX_BITS} bits")
