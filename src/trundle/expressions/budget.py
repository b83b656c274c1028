"""Bounds the work and the memory that the expressions of one document take together."""

from collections.abc import Iterable, Iterator
from typing import Any, cast

MAX_ITEMS = 1_000_000
"""Characters or items of one value."""
MAX_BITS = 100_000
"""Size of one integer."""
_MAX_STEPS = 3_000_000
"""A step is one operation, some 0.2 µs; the PR2, the most of all published robots, takes 19,000."""
_MAX_OCTETS = 96 * 1024 * 1024
"""Size of all values that were ever made for one document; the PR2's are 160,000."""
_MAX_DEPTH = 100
"""Levels of iterators over iterators."""

_GROUPS = (list, tuple, set, frozenset, type({}.keys()), type({}.values()), type({}.items()))
_SMALL = 1 << 61
"""Below it an integer is its own hash."""


class ExpressionError(ValueError):
    """The expression is refused; the text says why."""


class Budget:
    """The work and memory that one document may still use."""

    def __init__(self, steps: int = _MAX_STEPS, octets: int = _MAX_OCTETS) -> None:
        self._steps, self._octets = steps, octets
        self._most_steps, self._most_octets = steps, octets
        self.depth = 0
        """Iterators that are waiting for one another."""

    @property
    def spent(self) -> tuple[int, int]:
        """Steps and octets so far."""
        return self._most_steps - self._steps, self._most_octets - self._octets

    def spend(self, steps: int) -> None:
        """Take steps.

        Raises:
            ExpressionError: none are left.
        """
        self._steps -= steps
        if self._steps < 0:
            raise ExpressionError(f"the expressions of one file may take at most {self._most_steps} steps")

    def allocate(self, octets: int) -> None:
        """Take memory; it is never given back, for a property may keep every value.

        Raises:
            ExpressionError: none is left.
        """
        self._octets -= octets
        if self._octets < 0:
            raise ExpressionError(
                f"the expressions of one file may make at most {self._most_octets >> 20} MiB of values"
            )

    def allocate_generator(self) -> None:
        """Take what an object that iterates takes."""
        self.spend(20)
        self.allocate(800)

    def lazy(self, items: Iterator[Any]) -> "LazyIterator":
        """Make the value that a file gets for items which are made when they are asked for."""
        self.allocate_generator()
        return LazyIterator(self, items)

    def allocate_text(self, text: str) -> str:
        """Take the memory of a text, which was made already or is one of few."""
        self.allocate(50 + (len(text) if text.isascii() else 4 * len(text)))
        return text

    def iterate(self, items: Iterable[Any], steps: int = 1) -> Iterator[Any]:
        """Iterate; every item takes that many steps."""
        for item in items:
            self.spend(steps)
            yield item

    def collect(self, items: Iterable[Any]) -> list[Any]:
        """List what an iterable gives."""
        found: list[Any] = []
        for item in items:
            self.spend(1)
            self.allocate(40)
            found.append(item)
        bound_length(len(found))
        return found

    def spend_traversal(self, value: object) -> int:
        """Spend what going through a value takes, shared parts as often as they occur; return its length as text.

        Raises:
            ExpressionError: it is longer than any value may be, or without end.
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

    def spend_lookup(self, key: object, among: int) -> Any:
        """Spend what looking for a key takes in a dictionary or set of that many."""
        if isinstance(key, tuple | frozenset):
            self.spend_traversal(key)
            _bound_depth(cast("tuple[object, ...]", key))
            self.spend(among >> 4)  # nothing keeps their hashes from being all the same
        elif isinstance(key, int) and not -_SMALL < key < _SMALL:
            self.spend(key.bit_length() >> 6)
            self.spend(among >> 4)
        return key


class LazyIterator:
    """Items that are made when they are asked for; Python 3.11 crashes where thousands of generators ask each other."""

    __slots__ = ("_budget", "_items")

    def __init__(self, budget: Budget, items: Iterator[Any]) -> None:
        self._budget, self._items = budget, items

    def __iter__(self) -> Iterator[Any]:
        return self

    def __next__(self) -> Any:
        self._budget.depth += 1
        try:
            if self._budget.depth > _MAX_DEPTH:
                raise ExpressionError("an expression or a value nested too deeply")
            return next(self._items)
        finally:
            self._budget.depth -= 1


def _bound_depth(key: Iterable[object]) -> None:
    """Refuse tuples in tuples beyond all sense; to hash them, Python calls itself without a bound."""
    for _ in range(_MAX_DEPTH):
        key = [part for each in key if isinstance(each, tuple | frozenset) for part in cast("tuple[object, ...]", each)]
        if not key:
            return
    raise ExpressionError("an expression or a value nested too deeply")


def bound_length(length: float) -> None:
    """Refuse a text, list or range that long."""
    if length > MAX_ITEMS:
        raise ExpressionError(f"a text, list or range of more than {MAX_ITEMS} items")


def bound_bits(bits: float) -> None:
    """Refuse an integer of that many bits."""
    if bits > MAX_BITS:
        raise ExpressionError(f"a number of more than {MAX_BITS} bits")
