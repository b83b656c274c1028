"""Differences of a run's poses, joints and velocities from a reference, while it goes on or for a recorded one."""

import numpy as np
from numpy.typing import NDArray

from .difference import Difference, Quantity, differences, listed
from .finite_differences import velocities
from .run_samples import RunSamples
from .trajectory import Trajectory, interpolation

_Array = NDArray[np.float64]


class Comparison(RunSamples):
    """Samples of a run and their differences from a reference at the same time since the start.

    A run's row is its models' poses (7 each) and its joints' positions, in the order of the reference's, NaN for what
    the run does not have; with velocities, its models' twists (6 each) follow.
    """

    def __init__(self, reference: Trajectory, *, start: float, has_velocities: bool = False) -> None:
        """Begin without a sample.

        Args:
            reference: models and joints to compare.
            start: the run's start [s], at which the reference starts.
            has_velocities: True: models' velocities are compared as well; recorded ones are differences of poses.
        """
        width = (4 if has_velocities else 2) * len(reference.models) + len(reference.joints)
        super().__init__(start=start, duration=float(reference.times[-1]), width=width)
        self.reference = reference
        self._twists = velocities(reference.times, reference.poses) if has_velocities else None

    def row(self, poses: _Array, positions: _Array, twists: _Array | None = None) -> _Array:
        """Return a run's row of (models, 7) poses, (joints,) positions and, with velocities, (models, 6) twists."""
        parts = [poses.reshape(-1), positions]
        if self._twists is not None:
            assert twists is not None, "velocities are compared"
            parts.append(twists.reshape(-1))
        return np.concatenate(parts)

    def add_run(self, run: Trajectory) -> None:
        """Add all samples of a recorded run that has the reference's models and joints."""
        times = (run.times + run.start).tolist()
        parts = [run.poses.reshape(len(times), -1), run.positions]
        if self._twists is not None:
            parts.append(velocities(run.times, run.poses).reshape(len(times), -1))
        rows = np.concatenate(parts, axis=1)
        for time, row in zip(times, rows, strict=True):
            self.add(time, row)

    def differences(self, time: float, row: _Array | None = None) -> list[Difference]:
        """Return the differences at a time of the run [s], and over the samples up to it; `row` as in `sums`."""
        return listed(self._names, self.sums(time, row))

    @property
    def _names(self) -> list[tuple[str, Quantity]]:
        models, joints = self.reference.models, self.reference.joints
        names: list[tuple[str, Quantity]] = [
            *((model, "distance") for model in models),
            *((model, "angle") for model in models),
            *((joint, "position") for joint in joints),
        ]
        if self._twists is not None:
            names.extend((model, "velocity") for model in models)
            names.extend((model, "angular velocity") for model in models)
        return names

    def differences_at(self, times: _Array, rows: _Array) -> _Array:
        width = 7 * len(self.reference.models)
        poses, others = rows[:, :width].reshape(len(rows), -1, 7), rows[:, width:]
        positions, twists = np.split(others, [len(self.reference.joints)], axis=1)
        found = differences(poses, positions, *self.reference.at(times))
        if self._twists is None:
            return found
        before, after, ratio = interpolation(self.reference.times, times)
        start = self._twists[before]
        apart = twists.reshape(start.shape) - (start + ratio[:, None, None] * (self._twists[after] - start))
        linear, angular = np.linalg.norm(apart[..., :3], axis=-1), np.linalg.norm(apart[..., 3:], axis=-1)
        return np.concatenate([found, linear, angular], axis=1)
