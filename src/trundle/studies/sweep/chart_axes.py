"""Axes of a report's charts: round ticks, linear or logarithmic."""

import math
from collections.abc import Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)


class Axis(Struct, frozen=True):
    """Range of values along a side of a chart."""

    low: float
    high: float
    first: float
    """Coordinate of `low` [px]."""
    last: float
    is_log: bool = False

    def place(self, values: NDArray[np.float64]) -> list[float]:
        """Return the coordinates of (N,) values [px]."""
        low, high, found = self.low, self.high, np.asarray(values, dtype=np.float64)
        if self.is_log:
            low, high, found = math.log(low), math.log(high), np.log(found)
        share = (found - low) / (high - low) if high > low else np.full(len(found), 0.5)
        return (self.first + share * (self.last - self.first)).tolist()

    def ticks(self, count: int) -> list[float]:
        """Return at most some round values within the range; its ends where there are fewer than two."""
        found = self._decades() if self.is_log else _round_ticks(self.low, self.high, count)
        return found[:: -(-len(found) // count)] if len(found) >= 2 else sorted({self.low, self.high})

    def _decades(self) -> list[float]:
        """Return the powers of ten, and twice and five times those where they are few."""
        powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        found = [
            [
                tick
                for power in powers
                for tick in (each * 10.0**power for each in steps)
                if self.low <= tick <= self.high
            ]
            for steps in ((1.0,), (1.0, 2.0, 5.0))
        ]
        return found[0] if len(found[0]) >= 3 else found[1]


def axis_of(values: NDArray[np.float64], first: float, last: float, *, is_log: bool = False) -> Axis:
    """Return an axis that holds (N,) finite values; a logarithm needs positive ones."""
    low, high = float(values.min()), float(values.max())
    return Axis(low, high, first, last, is_log and low > 0.0)


def tick_texts(ticks: Sequence[float]) -> list[str]:
    """Return ticks as short texts."""
    return [f"{0.0 if abs(tick) < 1e-12 * max(map(abs, ticks)) else tick:.4g}" for tick in ticks]


def _round_ticks(low: float, high: float, count: int) -> list[float]:
    if not high > low:
        return []
    least = (high - low) / count
    scale = 10.0 ** math.floor(math.log10(least))
    step = next(each * scale for each in _STEPS if each * scale >= least * (1 - 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [i * step for i in range(first, last + 1)]
