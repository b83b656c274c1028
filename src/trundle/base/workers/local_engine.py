"""Engine on this machine: a process for each processor, each fed by a thread."""

import os
import threading
from collections.abc import Callable, Iterator
from queue import Empty, SimpleQueue
from typing import Generic

from .job import Job, JobResult, T
from .worker_process import WorkerProcess

_POLL_S = 0.2
"""Most time between two looks at whether to end."""


def run_here(
    job: Job[T], rows: Iterator[int], *, count: int, workers: int | None, is_ending: Callable[[], bool]
) -> "Iterator[JobResult[T] | None]":
    """See `run_rows`."""
    return _LocalRun(job, rows, min(workers or _processors(), count)).outcomes(is_ending)


class _LocalRun(Generic[T]):
    """Threads that feed processes."""

    def __init__(self, job: Job[T], rows: Iterator[int], workers: int) -> None:
        self._job = job
        self._rows = rows
        self._next = threading.Lock()
        self._is_over = False
        self._news: SimpleQueue[JobResult[T] | Exception | None] = SimpleQueue()
        """Outcomes; errors; None: a thread has ended."""
        self._count = workers

    def outcomes(self, is_ending: Callable[[], bool]) -> "Iterator[JobResult[T] | None]":
        processes = [WorkerProcess(self._job) for _ in range(self._count)]
        threads = [threading.Thread(target=self._feed, args=(each,), daemon=True) for each in processes]
        try:
            for thread in threads:
                thread.start()
            running = len(threads)
            while running and not is_ending():
                try:
                    news = self._news.get(timeout=_POLL_S)
                except Empty:
                    yield None
                    continue
                if isinstance(news, Exception):
                    raise news
                if news is None:
                    running -= 1
                else:
                    yield news
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
                outcome = process.run(row)
                if not self._is_over:
                    self._news.put(outcome)
        except Exception as error:  # the owner's thread raises it
            self._news.put(error)
        self._news.put(None)


def _processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
