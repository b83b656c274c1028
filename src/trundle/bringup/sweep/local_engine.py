"""Engine of a sweep on this machine: a process for each processor."""

from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack
from queue import Empty, SimpleQueue

from trundle.diagnostics import TrundleError
from trundle.trials import Plan, RowResult

from ..signals import StopFlag
from .worker_process import News, WorkerProcess

_POLL_S = 0.2
"""Most time between two looks at the stop flag and the time limits."""
_ATTEMPTS = 2
"""Processes that may end with the same row before it counts as lost."""


class LocalEngine:
    """Runs rows in processes, which are replaced when they end."""

    def __init__(self, plan: Plan, *, workers: int) -> None:
        self._plan = plan
        self._count = workers
        self._news: SimpleQueue[News] = SimpleQueue()
        self._workers: list[WorkerProcess] = []
        self._again: deque[int] = deque()
        """Rows of workers that ended."""
        self._ends: dict[int, int] = {}
        """Row → number of workers that ended with it."""

    def run(self, rows: Iterator[int], stop: StopFlag) -> Iterator[RowResult | None]:
        """Yield the results of rows as they come, and None in between; end once all have come or the flag is set.

        Raises:
            TrundleError: a worker does not start.
        """
        with ExitStack() as stack:
            stack.callback(self._close)
            self._workers = [WorkerProcess(self._plan, self._news) for _ in range(self._count)]
            has_more = True
            while not stop.is_set():
                has_more = self._assign(rows) and has_more
                if not has_more and not self._again and not any(worker.rows for worker in self._workers):
                    return
                try:
                    worker, result = self._news.get(timeout=_POLL_S)
                except Empty:
                    yield None
                else:
                    if result is not None and worker in self._workers:
                        worker.finish(result.row)
                        yield result
                    elif worker.has_ended and worker in self._workers:
                        yield from self._replace(worker, "lost", f"its process ended: {worker.exit_reason}")
                yield from self._end_overdue()

    def _assign(self, rows: Iterator[int]) -> bool:
        """Assign rows to the workers; return False if there are no more."""
        for worker in self._workers:
            while worker.wants_row:
                row = self._again.popleft() if self._again else next(rows, None)
                if row is None:
                    return False
                worker.assign(row)
        return True

    def _end_overdue(self) -> Iterator[RowResult]:
        limit_s = self._plan.time_limit_s
        for worker in list(self._workers):
            if limit_s is not None and worker.running_s > limit_s:
                yield from self._replace(worker, "timeout", f"longer than the time limit of {limit_s:g} s")

    def _replace(self, worker: WorkerProcess, status: str, reason: str) -> Iterator[RowResult]:
        """Start another worker in place of one, and yield the result of its running row if that is not run again."""
        if not worker.is_ready:
            raise TrundleError(f"a process of the sweep does not start: {worker.exit_reason}; its error is above")
        worker.close()
        self._workers[self._workers.index(worker)] = WorkerProcess(self._plan, self._news)
        if worker.rows:
            row = worker.rows.popleft()
            self._ends[row] = self._ends.get(row, 0) + 1
            if status == "timeout":
                yield RowResult(row, "timeout", reason)
            elif self._ends[row] >= _ATTEMPTS:
                yield RowResult(row, "lost", reason)
            else:
                self._again.append(row)
        self._again.extend(worker.rows)

    def _close(self) -> None:
        for worker in self._workers:
            worker.close()
