"""Engine on this machine: a process for each processor, each fed by a thread."""

import os
import threading
from collections.abc import Callable, Iterator
from queue import Empty, SimpleQueue
from typing import Generic

from .job import Job, JobResult, T
from .worker_process import WorkerProcess

_POLL_S = 0.2
"""Maximum time between two checks of `is_ending`."""


def run_locally(
    job: Job[T], rows: Iterator[int], *, count: int, workers: int | None, is_ending: Callable[[], bool]
) -> "Iterator[JobResult[T] | None]":
    """See `run_rows`."""
    return _LocalRun(job, rows, min(workers or _processors(), count)).results(is_ending)


class _LocalRun(Generic[T]):
    """Threads that feed processes."""

    def __init__(self, job: Job[T], rows: Iterator[int], workers: int) -> None:
        self._job = job
        self._rows = rows
        self._next = threading.Lock()
        self._is_over = False
        self._results: SimpleQueue[JobResult[T] | Exception | None] = SimpleQueue()
        """Results; errors; None: a thread has ended."""
        self._count = workers

    def results(self, is_ending: Callable[[], bool]) -> "Iterator[JobResult[T] | None]":
        processes = [WorkerProcess(self._job) for _ in range(self._count)]
        threads = [threading.Thread(target=self._feed, args=(process,), daemon=True) for process in processes]
        try:
            for thread in threads:
                thread.start()
            running = len(threads)
            while running and not is_ending():
                try:
                    result = self._results.get(timeout=_POLL_S)
                except Empty:
                    yield None
                    continue
                if isinstance(result, Exception):
                    raise result
                if result is None:
                    running -= 1
                else:
                    yield result
        finally:
            self._is_over = True
            for process in processes:
                process.close()
            for thread in threads:
                thread.join()

    def _feed(self, process: WorkerProcess[T]) -> None:
        try:
            while True:
                with self._next:
                    row = None if self._is_over else next(self._rows, None)
                if row is None:
                    break
                result = process.run(row)
                if not self._is_over:
                    self._results.put(result)
        except Exception as error:  # `results` raises the error
            self._results.put(error)
        self._results.put(None)


def _processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
