"""`trundle sweep` and `trundle.sweep`: all rows of a plan."""

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import closing, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from trundle.atomic_write import write_atomically
from trundle.diagnostics import TrundleError
from trundle.trials import Plan, Results, RowResult, Rows, Table, load_plan, lock_folder
from trundle.workers import Job, JobResult, Progress, check_workers, run_job

from ..console import say
from ..signals import stop_flag
from .argument_rows import argument_rows
from .digest import RunInputs, plan_digest
from .launch_trial import LaunchTrialRunner
from .trial import Trial, TrialRunner, run_row, runner_of


@dataclass(frozen=True, slots=True)
class SweepResult:
    """Results of a sweep."""

    folder: Path
    counts: dict[str, int]
    """Status → number of rows: ok, failed (a criterion is not met), error, timeout, memory, lost."""
    total: int
    """Rows of the plan."""
    rate: float
    """Rows per second of wall time of this call."""
    interrupted: bool
    """True after Ctrl-C; the same sweep goes on where it was."""
    _results: Results

    @property
    def table(self) -> Any:
        """The `pyarrow.Table` of all rows, in the order of their numbers; `.to_pandas()` makes a data frame."""
        return self._results.read()

    @property
    def done(self) -> int:
        """Number of rows with a result."""
        return sum(self.counts.values())

    def summary(self) -> str:
        """Return what came out, in one line."""
        most_first = sorted(self.counts.items(), key=lambda each: -each[1])
        counts = ", ".join(f"{count} {status}" for status, count in most_first)
        return f"{self.done} of {self.total} runs: {counts or 'none'}"


def results_folder(plan: Plan, output: Path | None) -> Path:
    """Return the folder of a plan's results: beside its file, or as asked for."""
    return output or Path(plan.file).with_suffix(".sweep")


def open_results(plan: Plan, rows: Rows, folder: Path, runner: TrialRunner | LaunchTrialRunner) -> Results:
    """Open the results of a plan in a folder.

    Raises:
        UsageError: the folder has the results of another plan, or cannot be written.
    """
    digest = plan_digest(plan, _inputs(plan, rows, runner))
    return Results(folder, Table.of_plan(plan, rows), rows=len(rows), digest=digest, text=plan.text)


def _inputs(plan: Plan, rows: Rows, runner: TrialRunner | LaunchTrialRunner) -> Iterator[RunInputs]:
    first, *others = argument_rows(plan, rows)
    yield runner.inputs(first)
    for row in others:
        with suppress(TrundleError):  # the row says so
            yield runner.inputs(row)


def sweep(
    plan: Plan, *, output: Path | None = None, workers: int | None = None, address: str | None = None
) -> SweepResult:
    """Run the rows of a plan that have no result yet.

    Args:
        plan: as read.
        output: folder of the results; None: beside the plan.
        workers: number of processes; None: one for each processor.
        address: of a Ray cluster; None: this machine, without Ray.

    Raises:
        TrundleError: the plan cannot be run, or its results not be written.
    """
    check_workers(workers)
    rows, runner = Rows(plan), runner_of(plan)
    for warning in runner.check(rows.row(0)):
        say(warning, sys.stderr)
    folder = results_folder(plan, output)
    job = Job(make=partial(run_row, plan), time_limit_s=plan.time_limit_s, memory_limit_bytes=plan.memory_limit_bytes)
    with lock_folder(folder), stop_flag() as stop:
        results = open_results(plan, rows, folder, runner)
        left = len(rows) - results.done
        progress = Progress(len(rows), results.done)

        def add_outcome(outcome: JobResult[Trial]) -> bool:
            result = _kept(outcome, folder)
            results.add(result)
            return result.status == "ok"

        with closing(results):
            run_job(
                job,
                results.missing(),
                add_outcome,
                count=left,
                progress=progress,
                workers=workers,
                address=address,
                is_ending=stop.is_set,
            )
        return SweepResult(folder, results.counts, len(rows), progress.rate, stop.is_set(), results)


def _kept(outcome: JobResult[Trial], folder: Path) -> RowResult:
    """Write a row's bag, if it has one, and return its result."""
    if outcome.failure is not None:
        return RowResult(outcome.row, outcome.failure, outcome.reason)
    assert outcome.value is not None
    if outcome.value.bag is not None:
        file = bag_file(folder, outcome.row)
        file.parent.mkdir(exist_ok=True)
        write_atomically(file, outcome.value.bag)
    return outcome.value.result


def bag_file(folder: Path, row: int) -> Path:
    """Return the bag of a row in a folder of results."""
    return folder / "bags" / f"row_{row}.bag"


def sweep_plan(
    plan: "str | os.PathLike[str] | Mapping[str, object]",
    *,
    output: Path | None,
    workers: int | None,
    address: str | None,
) -> SweepResult:
    """See `trundle.sweep`."""
    result = sweep(load_plan(plan), output=output, workers=workers, address=address)
    if result.interrupted:
        raise KeyboardInterrupt
    return result
