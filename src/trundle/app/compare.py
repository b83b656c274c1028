"""`trundle compare`: the differences of two recorded runs as a table."""

import csv
import io
from pathlib import Path

import numpy as np
from msgspec import Struct

from trundle.base.diagnostics import DescriptionError, Source, UsageError, printable
from trundle.sim.comparison import Comparison, Difference, Trajectory
from trundle.sim.simulation import read_state_log

_HEADER = ("name", "quantity", "maximum [m, rad]", "at [s]", "RMS [m, rad]", "at the end [m, rad]")
_RESTING = 1e-12
"""Largest difference [m, rad] of what counts as one pose."""


class RunDifferences(Struct, frozen=True, kw_only=True):
    """Differences of a recorded run from another."""

    duration: float
    """Time that both have [s]."""
    rows: tuple[Difference, ...]
    """Models and joints that move or differ: models first, the largest differences first."""
    only: tuple[tuple[str, tuple[str, ...]], ...]
    """Name of a log, and the models that it alone has."""

    def exceed(self, tolerance: float) -> tuple[Difference, ...]:
        """Return the rows whose maximum is above a tolerance [m, rad]."""
        return tuple(row for row in self.rows if (row.maximum or 0.0) > tolerance)


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
    names = [run.name, reference.name] if run.name != reference.name else [str(run), str(reference)]
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
        only=tuple((name, some) for name, some in zip(names, alone, strict=True) if some),
    )


def table(found: RunDifferences) -> str:
    """Return the rows as columns."""
    cells = [_HEADER, *(_cells(row, "{:.6f}", "{:.2f}") for row in found.rows)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    form = "  ".join(f"{{:{'<' if at < 2 else '>'}{width}}}" for at, width in enumerate(widths))
    return "\n".join(form.format(*row).rstrip() for row in cells)


def csv_table(found: RunDifferences) -> str:
    """Return the rows as comma-separated values."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows((_HEADER, *(_cells(row, "{}", "{}") for row in found.rows)))
    return text.getvalue()


def _cells(row: Difference, value: str, time: str) -> tuple[str, ...]:
    numbers = ((value, row.maximum), (time, row.maximum_time), (value, row.rms), (value, row.now))
    return (
        printable(row.name),
        row.quantity,
        *("" if number is None else form.format(number) for form, number in numbers),
    )


def _read(file: Path) -> Trajectory:
    log = read_state_log(file)
    if len(log.times) == 0:
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
