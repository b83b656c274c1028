"""`trundle sweep` and `trundle.sweep`: all rows of a plan."""

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trundle.base.console import say
from trundle.base.diagnostics import TrundleError
from trundle.base.signals import stop_flag
from trundle.base.workers import Progress, check_workers
from trundle.studies.plan_files.lock import lock_folder

from .argument_rows import argument_rows
from .launch_row_runner import LaunchRowRunner
from .plan import Plan
from .plan_digest import RunInputs, plan_digest
from .plan_reader import load_plan
from .processes import run_in_processes
from .results import Results
from .row_runner import RowRunner, runner_of
from .rows import Rows
from .table import Table


@dataclass(frozen=True, slots=True)
class SweepResult:
    """Results of a sweep."""

    __module__ = "trundle"

    folder: Path
    counts: dict[str, int]
    """Status → number of rows: ok, failed (a criterion is not met), error, timeout, memory, lost."""
    total: int
    """Number of rows of the plan."""
    rate: float
    """Rows run per second of wall time in this call [1/s]."""
    interrupted: bool
    """True after Ctrl-C; the same sweep resumes the run."""
    _results: Results

    @property
    def table(self) -> Any:
        """`pyarrow.Table` of all rows, sorted by number; `.to_pandas()` returns a data frame."""
        return self._results.read()

    @property
    def done(self) -> int:
        """Number of rows with a result."""
        return sum(self.counts.values())

    def summary(self) -> str:
        """Return a summary in one line."""
        sorted_counts = sorted(self.counts.items(), key=lambda item: -item[1])
        counts = ", ".join(f"{count} {status}" for status, count in sorted_counts)
        return f"{self.done} of {self.total} runs: {counts or 'none'}"


def results_folder(plan: Plan, output: Path | None) -> Path:
    """Return the folder of a plan's results: `output`, or next to its file."""
    return output or Path(plan.file).with_suffix(".sweep")


def open_results(plan: Plan, rows: Rows, folder: Path, runner: RowRunner | LaunchRowRunner) -> Results:
    """Open the results of a plan in a folder.

    Args:
        plan: plan of the sweep.
        rows: rows of the plan.
        folder: folder of the results.
        runner: runner of the rows.

    Raises:
        UsageError: the folder has the results of another plan, or cannot be written.
    """
    digest = plan_digest(plan, _inputs(plan, rows, runner))
    return Results(folder, Table.of_plan(plan, rows), rows=len(rows), digest=digest, text=plan.text)


def _inputs(plan: Plan, rows: Rows, runner: RowRunner | LaunchRowRunner) -> Iterator[RunInputs]:
    first, *others = argument_rows(plan, rows)
    yield runner.inputs(first)
    for row in others:
        with suppress(TrundleError):  # the row reports the error
            yield runner.inputs(row)


def run_sweep(
    plan: Plan,
    *,
    output: Path | None = None,
    workers: int | None = None,
    address: str | None = None,
) -> SweepResult:
    """Run the rows of a plan without a result.

    Args:
        plan: plan to run.
        output: folder of the results; None: next to the plan.
        workers: number of processes; None: one per processor.
        address: address of a Ray cluster; None: this machine, without Ray.

    Raises:
        TrundleError: the plan cannot be run, or its results cannot be written.
    """
    check_workers(workers)
    rows, runner = Rows(plan), runner_of(plan)
    for warning in runner.check(rows.row(0)):
        say(warning, sys.stderr)
    folder = results_folder(plan, output)
    with lock_folder(folder), stop_flag() as stop:
        results = open_results(plan, rows, folder, runner)
        progress = Progress(len(rows), results.done)
        with closing(results):
            run_in_processes(plan, results, progress, workers=workers, address=address, is_ending=stop.is_set)
        return SweepResult(folder, results.counts, len(rows), progress.rate, stop.is_set(), results)


def sweep(
    plan: "str | os.PathLike[str] | Mapping[str, object]",
    *,
    output: "str | os.PathLike[str] | None" = None,
    workers: int | None = None,
    address: str | None = None,
) -> SweepResult:
    """Run a world many times with different values; needs the extra `sweep`.

    A call with the same plan continues the interrupted one.

    Args:
        plan: plan file, or its content as a dictionary, with paths relative to the working directory.
        output: folder of the results; None: next to the plan's file, or `plan.sweep` in the working directory.
        workers: number of processes; None: one for each processor.
        address: address of a Ray cluster, "auto" for this machine's cluster, "local" for a new one; None: processes of
            this machine, without Ray.

    Raises:
        TrundleError: one sentence with file and line.
        KeyboardInterrupt: Ctrl-C; finished runs are kept.
    """
    folder = None if output is None else Path(output)
    result = run_sweep(load_plan(plan), output=folder, workers=workers, address=address)
    if result.interrupted:
        raise KeyboardInterrupt
    return result
