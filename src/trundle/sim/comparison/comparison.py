"""Differences of a run from a reference, while the run goes on or for a recorded one."""

from bisect import bisect_left, bisect_right

import numpy as np
from numpy.typing import NDArray

from .difference import Difference, Quantity, differences
from .trajectory import Trajectory

_Array = NDArray[np.float64]
_SAME_S = 1e-9
_CHUNK_ROWS = 2000
"""Rows that are compared at a time, which bounds the memory."""


class Comparison:
    """Samples of a run and their differences from a reference at the same time since the start.

    A run's row is its models' poses (7 each) and its joints' positions, in the order of the reference's, NaN for what
    the run does not have.
    """

    def __init__(self, reference: Trajectory, *, start: float) -> None:
        """Begin without a sample.

        Args:
            reference: models and joints to compare.
            start: the run's start [s], at which the reference starts.
        """
        self.reference = reference
        self.start = start
        self._offset = 0.0
        self._times: list[float] = []
        self._rows: list[_Array] = []
        self._newest = -np.inf
        self._sums = _Sums(2 * len(reference.models) + len(reference.joints))

    @property
    def offset(self) -> float:
        """Time by which the reference starts after the run [s]."""
        return self._offset

    @offset.setter
    def offset(self, offset: float) -> None:
        self._offset = offset
        self._sums.clear()

    def reference_time(self, time: float) -> float:
        """Return the time since the reference's start [s] at a time of the run [s]."""
        return time - self.start - self._offset

    def row(self, poses: _Array, positions: _Array) -> _Array:
        """Return a run's row of (models, 7) poses and (joints,) positions."""
        return np.concatenate([poses.reshape(-1), positions])

    def add(self, time: float, row: _Array) -> None:
        """Add a sample, unless the reference has no such time; time that passes again replaces its former samples."""
        if not -_SAME_S <= self.reference_time(time) <= self.reference.times[-1] + _SAME_S:
            return
        is_after = time > self._newest
        first = (bisect_right if is_after else bisect_left)(self._times, self._newest if is_after else time)
        last = bisect_right(self._times, time)
        self._newest = time
        if first < self._sums.rows:
            self._sums.clear()
        self._times[first:last] = [time]
        self._rows[first:last] = [row]

    def add_run(self, run: Trajectory) -> None:
        """Add all samples of a recorded run that has the reference's models and joints."""
        times = (run.times + run.start).tolist()
        rows = np.concatenate([run.poses.reshape(len(times), -1), run.positions], axis=1)
        for time, row in zip(times, rows, strict=True):
            self.add(time, row)

    def differences(self, time: float, row: _Array | None = None) -> list[Difference]:
        """Return the differences at a time of the run [s], and over the samples up to it.

        Args:
            time: the run's time [s].
            row: the run's row at that time; None: that of its newest sample.
        """
        count = bisect_right(self._times, time + _SAME_S)
        if count < self._sums.rows:
            self._sums.clear()
        for first in range(self._sums.rows, count, _CHUNK_ROWS):
            last = min(first + _CHUNK_ROWS, count)
            times = np.array(self._times[first:last])
            self._sums.add(times, self._compare(times, np.array(self._rows[first:last])))
        if row is None and count:
            row = self._rows[count - 1]
        now = np.full(self._sums.width, np.nan) if row is None else self._compare(np.array([time]), row[None])[0]
        return [
            Difference(
                name=name,
                quantity=quantity,
                now=_number(now[at]),
                maximum=_number(self._sums.maximum[at]),
                maximum_time=_number(self._sums.maximum_time[at]),
                rms=_number(self._sums.rms[at]),
            )
            for at, (name, quantity) in enumerate(self._names)
        ]

    @property
    def _names(self) -> list[tuple[str, Quantity]]:
        models, joints = self.reference.models, self.reference.joints
        return [
            *((model, "distance") for model in models),
            *((model, "angle") for model in models),
            *((joint, "position") for joint in joints),
        ]

    def _compare(self, times: _Array, rows: _Array) -> _Array:
        """Return (rows, values): the differences of rows at times [s]; NaN where the reference has no such time."""
        reference = self.reference
        since = times - self.start - self._offset
        width = 7 * len(reference.models)
        poses = rows[:, :width].reshape(len(rows), -1, 7)
        values = differences(poses, rows[:, width:], *reference.at(since))
        values[(since < -_SAME_S) | (since > reference.times[-1] + _SAME_S)] = np.nan
        return values


class _Sums:
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


def _number(value: np.float64) -> float | None:
    return float(value) if np.isfinite(value) else None
