"""Budget of time and memory for the expressions of one document.

Every operation is charged for its worst case before it runs, so that no single one is long; a clock bounds their
sum. A file can choose numbers and tuples as keys whose hashes all collide, so looking one up is charged a fraction of a
comparison with every key of the dictionary. Text is exempt: its hashes are randomized per process.
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
_STEPS_PER_CHARGE = 20
"""Steps that each call of `spend` adds until the clock is next read; they do not count toward the budget."""
_MAX_DEPTH = 100
"""Nesting depth of iterators."""

_Item = TypeVar("_Item")
VIEWS = (type({}.keys()), type({}.items()))
"""Views of dictionaries that compare and combine as sets."""
_KEYED = (set, frozenset, *VIEWS)
_GROUPS = (list, tuple, type({}.values()), *_KEYED)
_SMALL = 1 << 61
"""Bound below which an integer is its own hash."""
_FLOAT_LENGTH = 8
"""Usual characters of a float as text. Writing a float takes as long as traversing three values."""


class ExpressionError(ValueError):
    """Refused expression, with the reason."""


class Budget:
    """Remaining steps and memory of one document."""

    def __init__(self, steps: int = _MAX_STEPS, octets: int = _MAX_OCTETS, cpu_s: float = _MAX_CPU_S) -> None:
        self._steps, self._octets, self._cpu_s = steps, octets, cpu_s
        self._max_steps, self._max_octets, self._max_cpu_s = steps, octets, cpu_s
        self._until_check = 0
        self._evaluations, self._deadline_s = 0, math.inf
        self.depth = 0
        """Nesting depth of iterators in progress."""

    @property
    def spent(self) -> tuple[int, int]:
        """Steps and bytes used."""
        return self._max_steps - self._steps, self._max_octets - self._octets

    def spend(self, steps: int) -> None:
        """Charge for steps.

        Raises:
            ExpressionError: the budget of steps or of time is exhausted.
        """
        self._steps -= steps
        self._until_check -= steps + _STEPS_PER_CHARGE
        if self._until_check < 0:
            self._check()

    def _check(self) -> None:
        if self._steps < 0:
            raise ExpressionError(f"the expressions of one file may take at most {self._max_steps} steps")
        if time.thread_time() > self._deadline_s:
            raise ExpressionError(
                f"the expressions of one file may take at most {self._max_cpu_s:g} s of the processor"
            )
        self._until_check = min(_STEPS_BETWEEN_CHECKS, self._steps)

    def start_clock(self) -> None:
        """Count the processor time of this thread until `stop_clock`; evaluations may nest."""
        if not self._evaluations:
            self._deadline_s = time.thread_time() + self._cpu_s
        self._evaluations += 1

    def stop_clock(self) -> None:
        """End what `start_clock` started."""
        self._evaluations -= 1
        if not self._evaluations:
            self._cpu_s, self._deadline_s = self._deadline_s - time.thread_time(), math.inf

    def allocate(self, octets: int) -> None:
        """Charge for memory. It is never refunded, because an xacro property may keep any value.

        Raises:
            ExpressionError: the budget is exhausted.
        """
        self._octets -= octets
        if self._octets < 0:
            raise ExpressionError(
                f"the expressions of one file may make at most {self._max_octets >> 20} MiB of values"
            )

    def allocate_generator(self) -> None:
        """Charge for the steps and memory of a generator object."""
        self.spend(20)
        self.allocate(800)

    def lazy(self, items: Iterator[object]) -> "LazyIterator":
        """Wrap a lazily evaluated iterator for use by expressions."""
        self.allocate_generator()
        return LazyIterator(self, items)

    def allocate_text(self, text: str) -> str:
        """Charge for the memory of a text that was just created."""
        self.allocate(50 + (len(text) if text.isascii() else 4 * len(text)))
        return text

    def iterate(self, items: Iterable[_Item], steps: int = 1) -> Iterator[_Item]:
        """Iterate with a cost in steps per item."""
        for item in items:
            self.spend(steps)
            yield item

    def collect(self, items: Iterable[_Item]) -> list[_Item]:
        """Return the items of an iterable as a list."""
        collected: list[_Item] = []
        for item in items:
            self.spend(1)
            self.allocate(40)
            collected.append(item)
        bound_length(len(collected))
        return collected

    def spend_traversal(self, value: object) -> int:
        """Charge for traversing a value, counting shared parts each time; return its length as text.

        Raises:
            ExpressionError: it exceeds the maximum length, or is infinite.
        """
        size, pending = 0, [value]
        while pending:
            item = pending.pop()
            if isinstance(item, str):
                size += len(item) + 2
            elif isinstance(item, dict):
                size += 4 * len(item)
                if size <= MAX_ITEMS:
                    self.spend_keys(dict.keys(item))
                    pending.extend(dict.keys(item))
                    pending.extend(dict.values(item))
            elif isinstance(item, _GROUPS):
                size += 2 * len(item)
                if size <= MAX_ITEMS:
                    if isinstance(item, _KEYED):
                        self.spend_keys(item)
                    pending.extend(list.__iter__(item) if isinstance(item, list) else item)
            elif isinstance(item, float | complex):
                size += _FLOAT_LENGTH
                self.spend(2)
            elif isinstance(item, slice):
                size += 8
                pending += [item.start, item.stop, item.step]
            else:
                size += item.bit_length() // 3 + 1 if isinstance(item, int) else 1
            if size > MAX_ITEMS:
                raise ExpressionError(f"a value of more than {MAX_ITEMS} characters or items")
            self.spend(1)
        self.spend(size >> 6)
        return size

    def spend_lookup(self, key: _Item, size: int) -> _Item:
        """Charge for looking up a key in a dictionary or set of `size` keys."""
        if key.__class__ is not str:
            self.spend(size * self._weigh(key) >> 5)
        return key

    def spend_keys(self, *groups: Collection[object]) -> None:
        """Charge for combining or comparing dictionaries or sets, by looking up all keys of each in the others."""
        chosen = [key for keys in groups for key in keys if key.__class__ is not str]
        self.spend(sum(map(len, groups)) >> 2)
        self.spend(len(chosen) * sum(map(self._weigh, chosen)) >> 5)

    def _weigh(self, key: object) -> int:
        """Return an upper bound of the cost of comparing a key, in comparisons of numbers (about 10 ns)."""
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
        keys = [part for key in keys for part in _parts(key)]
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
        case frozenset():  # the hashes of its keys may collide, too
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
