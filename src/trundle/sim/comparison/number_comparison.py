"""Differences of numbers over time, such as a message's, from those of a reference."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .difference import Difference, Quantity, listed
from .run_samples import RunSamples
from .trajectory import interpolation

_Array = NDArray[np.float64]


class Numbers(Struct, frozen=True, eq=False, kw_only=True):
    """Numbers over time."""

    names: tuple[str, ...]
    times: _Array
    """(samples,) ascending [s]: time since the recording's start."""
    values: _Array
    """(samples, names)"""
    is_held: NDArray[np.bool_]
    """(names,) True: a value holds until the next one, as that of an integer; False: values between are linear."""

    def at(self, times: _Array) -> _Array:
        """Return (rows, names) at times (rows,) [s], held before the first sample and after the last."""
        before, after, ratio = interpolation(self.times, times)
        start = self.values[before]
        with np.errstate(invalid="ignore"):  # between two infinities
            step = (self.values[after] - start) * ratio[:, None]
        return start + np.where(self.is_held | ~np.isfinite(step), 0.0, step)


class NumberComparison(RunSamples):
    """Samples of a run's numbers and their differences from a reference's; a row has a number for each name."""

    def __init__(self, reference: Numbers, *, start: float, duration: float) -> None:
        """Begin without a sample.

        Args:
            reference: numbers to compare.
            start: the run's start [s], at which the reference starts.
            duration: the reference's duration [s].
        """
        super().__init__(start=start, duration=duration, width=len(reference.names))
        self.reference = reference

    def differences(self, time: float, row: _Array | None = None) -> list[Difference]:
        """Return the differences at a time of the run [s], and over the samples up to it; `row` as in `sums`."""
        names: list[tuple[str, Quantity]] = [(name, "value") for name in self.reference.names]
        return listed(names, self.sums(time, row))

    def differences_at(self, times: _Array, rows: _Array) -> _Array:
        with np.errstate(invalid="ignore"):
            return np.abs(rows - self.reference.at(times))
