"""Execution of rows in processes, on this machine or a Ray cluster."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.workers import Job, JobResult, Progress, run_job

from .plan import Plan
from .results import Results
from .row_result import RowResult
from .row_runner import RowOutput, run_row


def run_in_processes(
    plan: Plan,
    results: Results,
    progress: Progress,
    *,
    workers: int | None,
    address: str | None,
    is_ending: Callable[[], bool],
) -> None:
    """Run the rows of a plan without a result, and add their results; see `run_job`."""
    job = Job(make=partial(run_row, plan), time_limit_s=plan.time_limit_s, memory_limit_bytes=plan.memory_limit_bytes)

    def add_result(job_result: JobResult[RowOutput]) -> bool:
        result = _saved_result(job_result, results.folder)
        results.add(result)
        return result.status == "ok"

    run_job(
        job,
        results.missing(),
        add_result,
        count=progress.remaining,
        progress=progress,
        workers=workers,
        address=address,
        is_ending=is_ending,
    )


def _saved_result(job_result: JobResult[RowOutput], folder: Path) -> RowResult:
    """Write a row's bag, if any, and return its result."""
    if job_result.failure is not None:
        return RowResult(job_result.row, job_result.failure, job_result.reason)
    assert job_result.value is not None
    if job_result.value.bag is not None:
        file = bag_file(folder, job_result.row)
        file.parent.mkdir(exist_ok=True)
        write_atomically(file, job_result.value.bag)
    return job_result.value.result


def bag_file(folder: Path, row: int) -> Path:
    """Return the path of a row's bag in a folder of results."""
    return folder / "bags" / f"row_{row}.bag"
