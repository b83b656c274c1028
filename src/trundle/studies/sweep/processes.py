"""Rows of a sweep in processes: of this machine, or of a Ray cluster."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.workers import Job, JobResult, Progress, run_job

from .plan import Plan
from .results import Results
from .row_result import RowResult
from .row_runner import RowOutcome, run_row


def run_in_processes(
    plan: Plan,
    results: Results,
    progress: Progress,
    *,
    workers: int | None,
    address: str | None,
    is_ending: Callable[[], bool],
) -> None:
    """Run the rows of a plan that have no result yet, and add theirs; see `run_job`."""
    job = Job(make=partial(run_row, plan), time_limit_s=plan.time_limit_s, memory_limit_bytes=plan.memory_limit_bytes)

    def add_outcome(outcome: JobResult[RowOutcome]) -> bool:
        result = _kept(outcome, results.folder)
        results.add(result)
        return result.status == "ok"

    run_job(
        job,
        results.missing(),
        add_outcome,
        count=progress.remaining,
        progress=progress,
        workers=workers,
        address=address,
        is_ending=is_ending,
    )


def _kept(outcome: JobResult[RowOutcome], folder: Path) -> RowResult:
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
