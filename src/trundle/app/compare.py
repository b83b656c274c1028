"""`trundle compare`: differences of two state logs."""

from pathlib import Path

import numpy as np

from trundle.base.diagnostics import DescriptionError, Source, UsageError
from trundle.sim.comparison import Comparison, Trajectory
from trundle.sim.simulation import read_state_log

from .run_differences import RunDifferences, file_names

_RESTING = 1e-12
"""Largest difference [m, rad] of what counts as one pose."""


def compare_logs(run: Path, reference: Path) -> RunDifferences:
    """Compare two state logs at the same times since their starts.

    Raises:
        DescriptionError: a file is not a state log, is empty, or is damaged.
        UsageError: the logs have no model in common.
        OSError: a file cannot be read.
    """
    one, other = _read(run), _read(reference)
    models = [model for model in one.models if model in other.models]
    if not models:
        raise UsageError(f"{run} and {reference} have no model in common: {_names(one)} and {_names(other)}")
    joints = [joint for joint in one.joints if joint in other.joints]
    names = file_names(run.name, reference.name, (str(run), str(reference)))
    alone = [
        tuple(model for model in some.models if model not in others.models)
        for some, others in ((one, other), (other, one))
    ]
    one, other = one.only(models, joints), other.only(models, joints)
    comparison = Comparison(other, start=one.start)
    comparison.add_run(one)
    duration = float(min(one.times[-1], other.times[-1]))
    moving = _moving(one) | _moving(other)
    found = [
        row
        for row in comparison.differences(one.start + duration)
        if row.name in moving or (row.maximum or 0.0) > _RESTING
    ]
    return RunDifferences(
        duration=duration,
        rows=tuple(sorted(found, key=lambda row: (row.quantity == "position", -(row.maximum or 0.0)))),
        unit=" [m, rad]",
        only=tuple((name, some) for name, some in zip(names, alone, strict=True) if some),
    )


def _read(file: Path) -> Trajectory:
    log = read_state_log(file)
    if len(log.times_s) == 0:
        raise DescriptionError(Source(str(file)), "nothing was recorded")
    return Trajectory.of_log(log)


def _names(trajectory: Trajectory) -> str:
    return ", ".join(trajectory.models) or "no models"


def _moving(trajectory: Trajectory) -> set[str]:
    """Return the models and joints that move."""
    poses = np.ptp(trajectory.poses, axis=0).max(axis=-1, initial=0.0)
    positions = np.ptp(trajectory.positions, axis=0)
    return {
        name
        for names, ranges in ((trajectory.models, poses), (trajectory.joints, positions))
        for name, extent in zip(names, ranges.tolist(), strict=True)
        if extent > _RESTING
    }
