"""Samples of a run, and the sums of their differences from a reference."""

from abc import ABC, abstractmethod
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

_Array = NDArray[np.float64]
SAME_S = 1e-9
"""Largest difference between two times that count as one [s]."""
_CHUNK_ROWS = 2000
"""Rows that are compared at a time, which bounds the memory."""


class Sums(Struct, eq=False):
    """Differences of each value at a time, and over the samples up to it; NaN where there is none."""

    now: _Array
    maximum: _Array
    maximum_time: _Array
    """The run's times at the maxima [s]."""
    rms: _Array


class RunSamples(ABC):
    """Rows of a run at its times, to compare with a reference at the same time since the start."""

    def __init__(self, *, start: float, duration: float, width: int) -> None:
        """Begin without a sample.

        Args:
            start: the run's start [s], at which the reference starts.
            duration: the reference's duration [s].
            width: number of differences.
        """
        self.start = start
        self.duration = duration
        self._offset = 0.0
        self._times: list[float] = []
        self._rows: list[_Array] = []
        self._newest = -np.inf
        self._running = _RunningSums(width)

    @property
    def offset(self) -> float:
        """Time by which the reference starts after the run [s]."""
        return self._offset

    @offset.setter
    def offset(self, offset: float) -> None:
        self._offset = offset
        self._running.clear()

    def reference_time(self, time: float) -> float:
        """Return the time since the reference's start [s] at a time of the run [s]."""
        return time - self.start - self._offset

    def add(self, time: float, row: _Array) -> None:
        """Add a sample, unless the reference has no such time; time that passes again replaces its former samples."""
        if not self._has(time):
            return
        is_after = time > self._newest
        first = (bisect_right if is_after else bisect_left)(self._times, self._newest if is_after else time)
        last = bisect_right(self._times, time)
        self._newest = time
        if first < self._running.rows:
            self._running.clear()
        self._times[first:last] = [time]
        self._rows[first:last] = [row]

    def _has(self, time: float) -> bool:
        """True if the reference has a time of the run [s]."""
        return -SAME_S <= self.reference_time(time) <= self.duration + SAME_S

    def sums(self, time: float, row: _Array | None = None) -> Sums:
        """Return the differences at a time of the run [s], and over the samples up to it.

        Args:
            time: the run's time [s].
            row: the run's row at that time; None: its newest sample is compared at the sample's own time.
        """
        running = self._running
        count = bisect_right(self._times, time + SAME_S)
        if count < running.rows:
            running.clear()
        for first in range(running.rows, count, _CHUNK_ROWS):
            last = min(first + _CHUNK_ROWS, count)
            times = np.array(self._times[first:last])
            running.add(times, self._compare(times, np.array(self._rows[first:last])))
        now = np.full(running.width, np.nan)
        if self._has(time) and (row is not None or count):
            at, newest = (time, row) if row is not None else (self._times[count - 1], self._rows[count - 1])
            now = self._compare(np.array([at]), newest[None])[0]
        return Sums(now, running.maximum, running.maximum_time, running.rms)

    def first_above(self, tolerance: float, columns: Sequence[int]) -> float | None:
        """Return the run's first time at which a difference in some columns is above a tolerance [s]; None: never."""
        for first in range(0, len(self._times), _CHUNK_ROWS):
            times = np.array(self._times[first : first + _CHUNK_ROWS])
            rows = np.array(self._rows[first : first + _CHUNK_ROWS])
            above = np.flatnonzero((self._compare(times, rows)[:, columns] > tolerance).any(axis=1))
            if len(above):
                return float(times[above[0]])
        return None

    def _compare(self, times: _Array, rows: _Array) -> _Array:
        """Return (rows, values): the differences of rows at times [s]; NaN where the reference has no such time."""
        since = times - self.start - self._offset
        values = self.differences_at(since, rows)
        values[(since < -SAME_S) | (since > self.duration + SAME_S)] = np.nan
        return values

    @abstractmethod
    def differences_at(self, times: _Array, rows: _Array) -> _Array:
        """Return (rows, values): the differences of rows at times since the reference's start [s]."""


class _RunningSums:
    """Maxima and mean squares of rows, NaN left out."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.clear()

    def clear(self) -> None:
        self.rows = 0
        """Rows that were added."""
        self.maximum: _Array = np.full(self.width, np.nan)
        self.maximum_time: _Array = np.full(self.width, np.nan)
        self._squares = np.zeros(self.width)
        self._counts = np.zeros(self.width)

    def add(self, times: _Array, values: _Array) -> None:
        """Add rows (rows, values) at times (rows,)."""
        self.rows += len(times)
        is_number = np.isfinite(values)
        filled = np.where(is_number, values, -1.0)
        at = filled.argmax(axis=0)
        largest = filled[at, np.arange(self.width)]
        is_larger = (largest >= 0) & ~(largest <= self.maximum)
        self.maximum[is_larger] = largest[is_larger]
        self.maximum_time[is_larger] = times[at[is_larger]]
        self._squares += np.square(np.where(is_number, values, 0.0)).sum(axis=0)
        self._counts += is_number.sum(axis=0)

    @property
    def rms(self) -> _Array:
        """(values,) root mean squares; NaN without a number."""
        return np.sqrt(self._squares / np.where(self._counts > 0, self._counts, np.nan))
