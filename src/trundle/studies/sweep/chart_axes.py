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

    def coordinates(self, values: NDArray[np.float64]) -> list[float]:
        """Return the coordinates of (N,) values [px]."""
        low, high, scaled = self.low, self.high, np.asarray(values, dtype=np.float64)
        if self.is_log:
            low, high, scaled = math.log(low), math.log(high), np.log(scaled)
        ratio = (scaled - low) / (high - low) if high > low else np.full(len(scaled), 0.5)
        return (self.first + ratio * (self.last - self.first)).tolist()

    def ticks(self, count: int) -> list[float]:
        """Return up to `count` round values in the range, or its ends if there are fewer than two."""
        values = self._decades() if self.is_log else _round_ticks(self.low, self.high, count)
        return values[:: -(-len(values) // count)] if len(values) >= 2 else sorted({self.low, self.high})

    def _decades(self) -> list[float]:
        """Return the powers of ten, and their multiples by two and five if fewer than three."""
        powers = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        candidates = [
            [
                tick
                for power in powers
                for tick in (factor * 10.0**power for factor in steps)
                if self.low <= tick <= self.high
            ]
            for steps in ((1.0,), (1.0, 2.0, 5.0))
        ]
        return candidates[0] if len(candidates[0]) >= 3 else candidates[1]


def axis_of(values: NDArray[np.float64], first: float, last: float, *, is_log: bool = False) -> Axis:
    """Return an axis for (N,) finite values; logarithmic only if all are positive."""
    low, high = float(values.min()), float(values.max())
    return Axis(low, high, first, last, is_log and low > 0.0)


def tick_texts(ticks: Sequence[float]) -> list[str]:
    """Return ticks as short texts."""
    return [f"{0.0 if abs(tick) < 1e-12 * max(map(abs, ticks)) else tick:.4g}" for tick in ticks]


def _round_ticks(low: float, high: float, count: int) -> list[float]:
    if not high > low:
        return []
    min_step = (high - low) / count
    scale = 10.0 ** math.floor(math.log10(min_step))
    step = next(factor * scale for factor in _STEPS if factor * scale >= min_step * (1 - 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [i * step for i in range(first, last + 1)]
