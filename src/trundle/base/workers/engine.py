"""Engine of a job: processes of this machine, or actors of a Ray cluster."""

from collections.abc import Callable, Iterator

from trundle.base.diagnostics import UsageError

from .job import Job, JobResult, T
from .local_engine import run_locally
from .progress import Progress


def run_job(
    job: Job[T],
    rows: Iterator[int],
    receive: Callable[[JobResult[T]], bool],
    *,
    count: int,
    progress: Progress,
    workers: int | None,
    address: str | None,
    is_ending: Callable[[], bool],
) -> None:
    """Run rows, show their progress, and pass on each result.

    Args:
        job: work on each row.
        rows: numbers of the rows.
        receive: called with each result; returns True if it is ok.
        count: number of rows; 0: nothing is started.
        progress: progress of the whole job; closed at the end.
        workers: see `run_rows`.
        address: see `run_rows`.
        is_ending: see `run_rows`.

    Raises:
        TrundleError: see `run_rows`.
    """
    try:
        if count:
            for result in run_rows(job, rows, count=count, workers=workers, address=address, is_ending=is_ending):
                if result is not None:
                    progress.add(is_ok=receive(result))
                progress.show()
    finally:
        progress.close()


def check_workers(workers: int | None) -> None:
    """Refuse a number of processes below one.

    Raises:
        UsageError: it is below one.
    """
    if workers is not None and workers < 1:
        raise UsageError(f"{workers} workers; give at least 1")


def run_rows(
    job: Job[T],
    rows: Iterator[int],
    *,
    count: int,
    workers: int | None = None,
    address: str | None = None,
    is_ending: Callable[[], bool],
) -> "Iterator[JobResult[T] | None]":
    """Yield the results of rows as they arrive, and None in between, until all have arrived or `is_ending`.

    The results do not depend on the engine, except for their order.

    Args:
        job: work on each row.
        rows: numbers of the rows, read as workers become free.
        count: number of rows.
        workers: number of processes; None: one for each processor.
        address: address of a Ray cluster, whose nodes have the same files; "auto": this machine's cluster; "local": a
            new one on this machine; None: processes of this machine, without Ray.
        is_ending: polled; True ends the workers.

    Raises:
        UsageError: Ray is not installed, or the cluster does not answer.
        TrundleError: a worker does not start.
    """
    if address is None:
        return run_locally(job, rows, count=count, workers=workers, is_ending=is_ending)
    from .ray_engine import run_on_ray

    return run_on_ray(job, rows, count=count, address=address, workers=workers, is_ending=is_ending)
