"""Budget of time and memory for the expressions of one document.

Every operation is charged for its worst case before it is done, so that no single one is long; a clock bounds their
sum. Text hashes differently in every process. A file can choose all other keys so that their hashes collide, so a
lookup of such a key is charged a part of a comparison with every key of the dictionary.
"""

import math
import time
from collections.abc import Collection, Iterable, Iterator
from typing import TypeVar, cast

MAX_ITEMS = 1_000_000
"""Characters or items of one value."""
MAX_BITS = 100_000
"""Size of one integer."""
_MAX_STEPS = 3_000_000
"""Step budget; a step is one operation of about 0.2 µs. The PR2, the largest of the published robots, takes 19,000."""
_MAX_OCTETS = 96 * 1024 * 1024
"""Memory budget for all values of one document; the PR2 needs 160,000."""
_MAX_CPU_S = 1.5
"""Processor time of all expressions of one document; the PR2's take some 10 ms."""
_STEPS_BETWEEN_CHECKS = 2000
_STEPS_OF_A_CHARGE = 20
"""Steps by which each charge brings the next look at the clock nearer, whatever it is for."""
_MAX_DEPTH = 100
"""Nesting depth of iterators."""

_Item = TypeVar("_Item")
VIEWS = (type({}.keys()), type({}.items()))
"""Views of dictionaries that compare and combine as sets."""
_KEYED = (set, frozenset, *VIEWS)
_GROUPS = (list, tuple, type({}.values()), *_KEYED)
_SMALL = 1 << 61
"""Bound below which an integer is its own hash."""
_LENGTH_OF_A_FLOAT = 8
"""Usual length; writing one takes as long as traversing three values."""


class ExpressionError(ValueError):
    """Refused expression, with the reason."""


class Budget:
    """Remaining steps and memory of one document."""

    def __init__(self, steps: int = _MAX_STEPS, octets: int = _MAX_OCTETS, cpu_s: float = _MAX_CPU_S) -> None:
        self._steps, self._octets, self._cpu_s = steps, octets, cpu_s
        self._most_steps, self._most_octets, self._most_cpu_s = steps, octets, cpu_s
        self._until_check = 0
        self._evaluations, self._due_s = 0, math.inf
        self.depth = 0
        """Nesting depth of iterators in progress."""

    @property
    def spent(self) -> tuple[int, int]:
        """Steps and octets used."""
        return self._most_steps - self._steps, self._most_octets - self._octets

    def spend(self, steps: int) -> None:
        """Use steps.

        Raises:
            ExpressionError: the budget of steps or of time is exhausted.
        """
        self._steps -= steps
        self._until_check -= steps + _STEPS_OF_A_CHARGE
        if self._until_check < 0:
            self._check()

    def _check(self) -> None:
        if self._steps < 0:
            raise ExpressionError(f"the expressions of one file may take at most {self._most_steps} steps")
        if time.thread_time() > self._due_s:
            raise ExpressionError(
                f"the expressions of one file may take at most {self._most_cpu_s:g} s of the processor"
            )
        self._until_check = min(_STEPS_BETWEEN_CHECKS, self._steps)

    def start_clock(self) -> None:
        """Count the processor time of this thread until `stop_clock`; evaluations may nest."""
        if not self._evaluations:
            self._due_s = time.thread_time() + self._cpu_s
        self._evaluations += 1

    def stop_clock(self) -> None:
        """End what `start_clock` started."""
        self._evaluations -= 1
        if not self._evaluations:
            self._cpu_s, self._due_s = self._due_s - time.thread_time(), math.inf

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
                    self.spend_keys(dict.keys(each))
                    pending.extend(dict.keys(each))
                    pending.extend(dict.values(each))
            elif isinstance(each, _GROUPS):
                size += 2 * len(each)
                if size <= MAX_ITEMS:
                    if isinstance(each, _KEYED):
                        self.spend_keys(each)
                    pending.extend(list.__iter__(each) if isinstance(each, list) else each)
            elif isinstance(each, float | complex):
                size += _LENGTH_OF_A_FLOAT
                self.spend(2)
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
        if key.__class__ is not str:
            self.spend(among * self._weigh(key) >> 5)
        return key

    def spend_keys(self, *groups: Collection[object]) -> None:
        """Use the steps of looking up all keys of dictionaries and sets in one another."""
        chosen = [key for keys in groups for key in keys if key.__class__ is not str]
        self.spend(sum(map(len, groups)) >> 2)
        self.spend(len(chosen) * sum(map(self._weigh, chosen)) >> 5)

    def _weigh(self, key: object) -> int:
        """Return how many comparisons of numbers, of some 10 ns, comparing a key is worth, at most."""
        match key:
            case tuple() | frozenset() | slice():
                self.spend_traversal(key)
                _bound_depth((key,))
                return _weight(key)
            case int() if not -_SMALL < key < _SMALL:
                self.spend(key.bit_length() >> 6)
                return _weight(key)
            case _:
                return 1


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


def _bound_depth(keys: Iterable[object]) -> None:
    """Refuse deeply nested tuples, which Python hashes with unbounded recursion."""
    for _ in range(_MAX_DEPTH):
        keys = [part for each in keys for part in _parts(each)]
        if not keys:
            return
    raise ExpressionError("an expression or a value nested too deeply")


def _parts(key: object) -> Iterable[object]:
    match key:
        case tuple() | frozenset():
            return cast("Iterable[object]", key)
        case slice():
            return key.start, key.stop, key.step
        case _:
            return ()


def _weight(key: object) -> int:
    match key:
        case frozenset():  # its keys may collide, too
            return 1 + len(cast("frozenset[object]", key)) * sum(map(_weight, _parts(key)))
        case tuple() | slice():
            return 1 + sum(map(_weight, _parts(key)))
        case str():
            return 1 + (len(key) >> 8)
        case int():
            return 1 + (key.bit_length() >> 10)
        case _:
            return 1


def bound_length(length: float) -> None:
    """Refuse a text, list or range beyond the maximum length."""
    if length > MAX_ITEMS:
        raise ExpressionError(f"a text, list or range of more than {MAX_ITEMS} items")


def bound_bits(bits: float) -> None:
    """Refuse an integer beyond the maximum number of bits."""
    if bits > MAX_BITS:
        raise ExpressionError(f"a number of more than {MAX_BITS} bits")
