"""Differences of a run's poses and joints from a reference, while the run goes on or for a recorded one."""

import numpy as np
from numpy.typing import NDArray

from .difference import Difference, Quantity, differences, listed
from .run_samples import RunSamples
from .trajectory import Trajectory

_Array = NDArray[np.float64]


class Comparison(RunSamples):
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
        width = 2 * len(reference.models) + len(reference.joints)
        super().__init__(start=start, duration=float(reference.times[-1]), width=width)
        self.reference = reference

    def row(self, poses: _Array, positions: _Array) -> _Array:
        """Return a run's row of (models, 7) poses and (joints,) positions."""
        return np.concatenate([poses.reshape(-1), positions])

    def add_run(self, run: Trajectory) -> None:
        """Add all samples of a recorded run that has the reference's models and joints."""
        times = (run.times + run.start).tolist()
        rows = np.concatenate([run.poses.reshape(len(times), -1), run.positions], axis=1)
        for time, row in zip(times, rows, strict=True):
            self.add(time, row)

    def differences(self, time: float, row: _Array | None = None) -> list[Difference]:
        """Return the differences at a time of the run [s], and over the samples up to it; `row` as in `sums`."""
        return listed(self._names, self.sums(time, row))

    @property
    def _names(self) -> list[tuple[str, Quantity]]:
        models, joints = self.reference.models, self.reference.joints
        return [
            *((model, "distance") for model in models),
            *((model, "angle") for model in models),
            *((joint, "position") for joint in joints),
        ]

    def differences_at(self, times: _Array, rows: _Array) -> _Array:
        width = 7 * len(self.reference.models)
        poses = rows[:, :width].reshape(len(rows), -1, 7)
        return differences(poses, rows[:, width:], *self.reference.at(times))
