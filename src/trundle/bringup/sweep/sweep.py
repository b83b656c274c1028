"""`trundle sweep` and `trundle.sweep`: all rows of a plan."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from trundle.diagnostics import UsageError
from trundle.trials import Plan, Results, Rows, load_plan, lock_folder, read_plan

from ..signals import stop_flag
from .local_engine import LocalEngine
from .progress import SweepProgress
from .trial import TrialRunner


@dataclass(frozen=True, slots=True)
class SweepResult:
    """Results of a sweep."""

    folder: Path
    counts: dict[str, int]
    """Status → number of rows: ok, failed (a criterion is not met), error, timeout, lost."""
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


def sweep(plan: Plan, *, output: Path | None = None, workers: int | None = None) -> SweepResult:
    """Run the rows of a plan that have no result yet.

    Args:
        plan: as read.
        output: folder of the results; None: beside the plan.
        workers: number of processes; None: one for each processor.

    Raises:
        TrundleError: the plan cannot be run, or its results not be written.
    """
    if workers is not None and workers < 1:
        raise UsageError(f"{workers} workers; give at least 1")
    rows = Rows(plan)
    TrialRunner(plan).check(rows.row(0))
    folder = results_folder(plan, output)
    with lock_folder(folder), stop_flag() as stop:
        results = Results(plan, rows, folder)
        progress = SweepProgress(len(rows), results.done)
        count = min(workers or _processors(), max(len(rows) - results.done, 1))
        try:
            if results.done < len(rows):
                for result in LocalEngine(plan, workers=count).run(results.missing(), stop):
                    if result is not None:
                        results.add(result)
                        progress.add(is_ok=result.status == "ok")
                    progress.show()
        finally:
            progress.close()
            results.close()
        return SweepResult(folder, results.counts, len(rows), progress.rate, stop.is_set(), results)


def sweep_plan(
    plan: "str | os.PathLike[str] | Mapping[str, object]", *, output: Path | None, workers: int | None
) -> SweepResult:
    """See `trundle.sweep`."""
    if isinstance(plan, str | os.PathLike):
        read = load_plan(Path(plan))
    else:
        text = yaml.safe_dump(dict(plan), sort_keys=False)
        read = read_plan(text, file="plan", folder=Path.cwd())
    result = sweep(read, output=output, workers=workers)
    if result.interrupted:
        raise KeyboardInterrupt
    return result


def _processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
