"""Queue of a node's calls to the master, executed in order on the loop."""

import asyncio
from collections.abc import Awaitable, Callable
from itertools import count
from typing import TypeAlias

from ..errors import MasterError, MasterUnreachableError, ParameterError
from ..log import print_log
from .clock import WallClock
from .loop import GraphLoop
from .node_log import NodeLog
from .pending_work import WorkItem

Registration: TypeAlias = Callable[[], Awaitable[None]]
_RETRY_S, _FIRST_RETRY_S, _FIRST_RETRIES = 0.5, 0.05, 40
"""Intervals of retries: shorter for the first ones, as a master that starts together with the node answers soon."""


class RegistrationQueue:
    """Queue of master calls, which are retried while no master answers."""

    def __init__(self, loop: GraphLoop, *, log: NodeLog) -> None:
        self._loop = loop
        self._log = log
        self._queue: asyncio.Queue[tuple[Registration, WorkItem]] = asyncio.Queue()
        self._worker: asyncio.Task[None] | None = None
        self._is_started = asyncio.Event()
        self._has_ended = False
        self._waits_for_master = False
        self._current: WorkItem | None = None
        """Work of the call in progress."""

    def add(self, registration: Registration) -> None:
        """Append a call; thread-safe, does not block."""
        work = self._loop.work.start()
        self._loop.call_soon(lambda: self._add(registration, work))

    def start(self, first: Registration) -> None:
        """Start the queue with `first`; call on the loop."""
        work = self._loop.work.start()
        self._worker = asyncio.get_running_loop().create_task(self._run(first, work))
        self._worker.add_done_callback(lambda _: self._loop.work.finish(work))
        self._worker.add_done_callback(self._worker_ended)

    async def wait_done(self) -> None:
        """Wait until all calls added so far are done, or the node shuts down.

        Raises:
            RosError: the node could not start.
            OSError: the system refused it a socket.
        """
        await self._is_started.wait()
        await asyncio.sleep(0)  # lets calls added by other threads enter the queue
        if self._worker is None or self._worker.cancelled():
            return
        if self._worker.done():
            self._worker.result()
        reached: asyncio.Future[None] = asyncio.get_running_loop().create_future()

        async def reach() -> None:
            if not reached.done():
                reached.set_result(None)

        self._queue.put_nowait((reach, self._loop.work.start()))
        await asyncio.wait((reached, self._worker), return_when=asyncio.FIRST_COMPLETED)
        if not reached.done() and not self._worker.cancelled():
            self._worker.result()

    async def close(self) -> None:
        """Drop the remaining calls."""
        self._has_ended = True
        self._is_started.set()
        if self._worker is not None:
            self._worker.cancel()
            await asyncio.gather(self._worker, return_exceptions=True)

    async def retry(self, registration: Registration) -> None:
        """Execute a call, retrying until a master answers; the wait for a master does not count as work in progress."""
        for attempt in count():
            try:
                await registration()
            except MasterUnreachableError as error:
                if not self._waits_for_master:
                    self._waits_for_master = True
                    self._log.warn(f"{error}; {self._log.name} keeps trying")
                if self._current is not None:
                    self._loop.work.finish(self._current)
                await asyncio.sleep(_FIRST_RETRY_S if attempt < _FIRST_RETRIES else _RETRY_S)
                continue
            except (MasterError, ParameterError) as error:
                self._log.error(str(error))
            self._waits_for_master = False
            return

    def _add(self, registration: Registration, work: WorkItem) -> None:
        if self._has_ended or (self._worker is not None and self._worker.done()):  # the worker has ended
            self._loop.work.finish(work)
        else:
            self._queue.put_nowait((registration, work))

    async def _run(self, first: Registration, work: WorkItem) -> None:
        self._current = work
        await first()
        self._is_started.set()
        self._loop.work.finish(work)
        while True:
            registration, self._current = await self._queue.get()
            try:
                await self.retry(registration)
            finally:
                self._loop.work.finish(self._current)

    def _worker_ended(self, worker: "asyncio.Task[None]") -> None:
        while not self._queue.empty():
            self._loop.work.finish(self._queue.get_nowait()[1])
        self._is_started.set()
        if not worker.cancelled() and (error := worker.exception()) is not None and not self._loop.is_ending:
            reason = f"{self._log.name} cannot go on: {error}"
            print_log("fatal", reason, wall_ns=WallClock().now_ns(), sim_ns=None)
