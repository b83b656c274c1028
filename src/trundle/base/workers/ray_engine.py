"""Engine on a Ray cluster: an actor for each of its processors, which owns a worker process as on one machine.

So limits, retries and results are the same. An actor ends with its node; another node then runs its row.
"""

import pickle
import socket
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, Generic

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.extras import import_extra

from .job import Job, JobResult, T
from .worker_process import WorkerProcess

_POLL_S = 0.2
"""Maximum time between two checks of `is_ending`."""
_CONNECT_S = 10.0
_MAX_NODES = 5
"""Number of nodes that may end while running a row before the row counts as lost, and of consecutive actors that may
fail to start.
"""


class WorkerActor(Generic[T]):
    """Worker process on a node of the cluster."""

    def __init__(self, job: bytes) -> None:
        self._process = WorkerProcess(pickle.loads(job))

    def ready(self) -> None:
        """Return once the actor is placed on a node."""

    def run(self, row: int) -> JobResult[T]:
        """See `WorkerProcess.run`."""
        return self._process.run(row)


def run_on_ray(
    job: Job[T], rows: Iterator[int], *, count: int, address: str, workers: int | None, is_ending: Callable[[], bool]
) -> "Iterator[JobResult[T] | None]":
    """See `run_rows`."""
    ray = import_extra("ray", extra="ray")
    is_owner = not ray.is_initialized()
    if is_owner:
        _check_answers(address)
        try:
            ray.init(address=address, include_dashboard=False if address == "local" else None, logging_level="ERROR")
        except (ConnectionError, ValueError, RuntimeError) as error:
            raise _no_cluster(address, error) from None
    try:
        yield from _RayRun(ray, job, rows, count=count, workers=workers).results(is_ending)
    finally:
        if is_owner:
            ray.shutdown()


def _check_answers(address: str) -> None:
    """Raise an error at once if nothing listens at HOST:PORT; Ray itself retries for minutes."""
    host, colon, port = address.rpartition(":")
    if not colon or "/" in host or not port.isdecimal():
        return
    try:
        socket.create_connection((host, int(port)), timeout=_CONNECT_S).close()
    except (OSError, OverflowError) as error:
        raise _no_cluster(address, error) from None


def _no_cluster(address: str, error: Exception) -> UsageError:
    return UsageError(f"no Ray cluster at {address!r}: {error}; start one: ray start --head")


class _RayRun(Generic[T]):
    """Actors and their rows."""

    def __init__(self, ray: Any, job: Job[T], rows: Iterator[int], *, count: int, workers: int | None) -> None:
        self._ray = ray
        self._job = pickle.dumps(job)
        self._rows = rows
        self._actor = ray.remote(num_cpus=1, max_restarts=0)(WorkerActor)
        self._count = min(workers or max(int(ray.cluster_resources().get("CPU", 1)), 1), count)
        self._pending: dict[Any, tuple[Any, int | None]] = {}
        """Future → (actor, its row; None: the actor is being placed)."""
        self._retries: deque[int] = deque()
        """Rows whose node has ended."""
        self._ends: dict[int, int] = {}
        """Row → number of nodes that ended while running the row."""
        self._failed_starts = 0
        """Consecutive actors that ended before running a row."""

    def results(self, is_ending: Callable[[], bool]) -> "Iterator[JobResult[T] | None]":
        try:
            for _ in range(self._count):
                self._add_actor()
            idle: list[Any] = []
            while not is_ending():
                while idle and (row := self._next_row()) is not None:
                    actor = idle.pop()
                    self._pending[actor.run.remote(row)] = (actor, row)
                if not self._retries and all(row is None for _, row in self._pending.values()) and idle:
                    return
                done, _ = self._ray.wait(list(self._pending), num_returns=1, timeout=_POLL_S)
                if not done:
                    yield None
                for future in done:
                    actor, row = self._pending.pop(future)
                    try:
                        result = self._ray.get(future)
                    except self._ray.exceptions.RayTaskError as error:
                        raise TrundleError(f"a worker of the cluster failed: {error.cause}") from None
                    except self._ray.exceptions.RayError as error:
                        self._ray.kill(actor)
                        self._add_actor()
                        if row is not None:
                            yield from self._end(row, error)
                        else:
                            self._count_failed_start(error)
                        continue
                    self._failed_starts = 0
                    idle.append(actor)
                    if result is not None:
                        yield result
        finally:
            for actor, _ in self._pending.values():
                self._ray.kill(actor)

    def _add_actor(self) -> None:
        """Request an actor; it is placed when a node has a free processor."""
        actor = self._actor.remote(self._job)
        self._pending[actor.ready.remote()] = (actor, None)

    def _count_failed_start(self, error: Exception) -> None:
        self._failed_starts += 1
        if self._failed_starts >= _MAX_NODES:
            raise TrundleError(f"no worker of the cluster starts: {error}") from None

    def _next_row(self) -> int | None:
        return self._retries.popleft() if self._retries else next(self._rows, None)

    def _end(self, row: int, error: Exception) -> Iterator[JobResult[T]]:
        """Retry a row, unless too many nodes ended with it."""
        self._ends[row] = self._ends.get(row, 0) + 1
        if self._ends[row] < _MAX_NODES:
            self._retries.append(row)
        else:
            reason = f"its node ended: {type(error).__name__}"
            yield JobResult(row=row, failure="lost", reason=reason)
