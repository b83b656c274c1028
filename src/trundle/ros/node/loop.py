"""asyncio loop in a thread of its own, shared by the nodes of this process."""

import asyncio
import contextlib
import logging
import math
import threading
import time
from collections.abc import Callable, Coroutine
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, Self, TypeVar

from trundle.base.diagnostics import DescriptionError, UsageError
from trundle.base.waiting import WaitNotice

from .. import _message_codec
from ..log import print_log
from ..transport.closing_loop import ClosingLoop
from ..transport.fast_selector import FastSelector
from .local_graph import LocalGraph
from .pending_work import PendingWork

if TYPE_CHECKING:
    from ..messages.message_library import Messages

_T = TypeVar("_T")
_log = logging.getLogger(__name__)
_IDLE_PASSES = 5
"""Passes without a delivery after which deliveries count as flushed: a coroutine callback that awaits nothing outside
the process takes fewer.
"""
_SPIN_PASSES = 200
"""Passes after which `idle` sleeps between passes while work is in progress."""
_POLL_S = 0.001
SLICE_NS = 100_000
"""Linux' shortest time slice: the loop then preempts a busy thread instead of waiting for its 3 ms slice."""
_CHECK_S = 1.0
"""Interval of checks for work that takes long."""
_WAIT_S = 0.5
"""Longest single wait: a signal delivered to another thread does not end the main thread's wait, and Python runs signal
handlers only in the main thread.
"""


class GraphLoop:
    """Loop and its thread, on which nodes are created.

    Its nodes exchange message objects without serialization. Also a context manager.
    """

    def __init__(self, *, messages: "Messages | None" = None) -> None:
        self.messages = messages or _new_messages()
        """Message types of all nodes; loaded on first use."""
        self.local = LocalGraph()
        """Nodes of the loop."""
        self.work = PendingWork()
        self._batch_thread: int | None = None
        """Thread whose calls are batched until `end_batch`."""
        self.loop_threads: set[int | None] = set()
        """IDs of the loop's thread and the batching thread, for which sending directly has no advantage."""
        self._batch: list[Callable[[], object]] = []
        self.publish_timer: Callable[[], contextlib.AbstractContextManager[object]] | None = None
        """Entered while a message is published, in the publishing thread."""
        self._calls = 0
        """Count of calls, for `idle`."""
        self._deliveries = 0
        """Count of delivered batches, for `flush_deliveries`."""
        self._has_new_calls = False
        """True if a function was scheduled since the last flush."""
        self.selector = FastSelector()
        """Selector with sockets that bypass asyncio; used on the loop."""
        self._loop = ClosingLoop(self.selector)
        self._thread = threading.Thread(target=self._run, name="trundle-graph", daemon=True)
        self._tasks: set[asyncio.Task[Any]] = set()
        self._unstarted: dict[Future[Any], Coroutine[Any, Any, Any]] = {}
        """Spawned coroutines without a task yet."""
        self.is_ending = False
        """True once no new node may start."""
        self._has_stopped = False
        """True once nothing new may start."""

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()
        self.loop_threads.add(self._thread.ident)

    def stop(self) -> None:
        """Shut the nodes down, cancel remaining tasks, and join the thread; logs every few seconds that it waits."""
        if not self._thread.is_alive():
            return
        notice = WaitNotice("the nodes of this process to shut down")
        _wait_result(asyncio.run_coroutine_threadsafe(self._shutdown_nodes(), self._loop), None, notice.poll)
        self._loop.call_soon_threadsafe(self._loop.stop)
        while self._thread.is_alive():
            self._thread.join(_WAIT_S)
            notice.poll()

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()

    @property
    def is_this_thread(self) -> bool:
        """True if the caller runs on the loop."""
        return threading.get_ident() == self._thread.ident

    @property
    def processor_ns(self) -> int | None:
        """Processor time of the thread [ns]; None where the system does not measure it, or the thread has ended."""
        if self._thread.ident is None or not self._thread.is_alive() or not hasattr(time, "pthread_getcpuclockid"):
            return None
        return time.clock_gettime_ns(time.pthread_getcpuclockid(self._thread.ident))

    def run(self, coroutine: Coroutine[object, object, _T], timeout_s: float | None = None) -> _T:
        """Run a coroutine on the loop and wait for its result, from another thread.

        While it waits, the loop logs the work in progress every few seconds.

        Raises:
            TimeoutError: timeout; the coroutine is cancelled.
        """
        assert not self.is_this_thread, "run() would wait for itself; await the coroutine"
        self.end_batch()
        future = asyncio.run_coroutine_threadsafe(coroutine, self._loop)
        try:
            return _wait_result(future, timeout_s)
        except TimeoutError:
            future.cancel()
            raise

    def spawn(self, coroutine: Coroutine[object, object, _T]) -> Future[_T]:
        """Start a coroutine on the loop; thread-safe. A failure that is not retrieved is logged."""
        future: Future[_T] = Future()
        self._unstarted[future] = coroutine

        def start() -> None:
            if self._has_stopped or self._unstarted.pop(future, None) is None:
                return
            task = self._loop.create_task(coroutine)
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)
            task.add_done_callback(lambda done: _copy(done, future))
            future.add_done_callback(lambda done: self.call_soon(task.cancel) if done.cancelled() else None)

        self.call_soon(start)
        if self._has_stopped:
            self._drop_unstarted()
        return future

    def _drop_unstarted(self) -> None:
        """Cancel the futures of coroutines the loop never started."""
        with contextlib.suppress(KeyError):  # another thread may cancel them at the same time
            while True:
                future, coroutine = self._unstarted.popitem()
                coroutine.close()
                future.cancel()

    def call_soon(self, function: Callable[[], object]) -> None:
        """Call a function on the loop; thread-safe, ignored once the loop has ended."""
        self._has_new_calls = True
        if self.is_this_thread:
            self._calls += 1
            self._loop.call_soon(function)
            return
        if threading.get_ident() == self._batch_thread:
            self._batch.append(function)
            return
        self._call_soon_threadsafe(function)

    def _call_soon_threadsafe(self, function: Callable[[], object]) -> None:
        try:
            self._loop.call_soon_threadsafe(function)
        except RuntimeError:  # the loop is closed
            _log.debug("the graph has ended; %s is not called", function)

    def deliver_soon(self, function: Callable[[], object]) -> None:
        """`call_soon` for message delivery, which `flush_deliveries` waits for."""

        def count() -> None:
            self._deliveries += 1
            function()

        self.call_soon(count)

    def flush_deliveries(self) -> None:
        """Wait until every message published so far has reached its subscribers in this process.

        Callbacks of nodes with `deliver` are then scheduled, not yet called. For runs at maximum speed, between steps.
        """
        if self._has_new_calls:
            self.run(self._wait_delivered())
            self._has_new_calls = False

    def begin_batch(self) -> None:
        """Batch this thread's calls to the loop until `end_batch`, which submits them in order."""
        self._batch_thread = threading.get_ident()
        self.loop_threads.add(self._batch_thread)

    def end_batch(self) -> None:
        """Submit the batched calls."""
        if self._batch and threading.get_ident() == self._batch_thread:
            batch, self._batch = self._batch, []
            self._call_soon_threadsafe(lambda: [self.call_soon(function) for function in batch])

    def wait_idle(self, *, unless: Callable[[], bool] = lambda: False) -> bool:
        """Wait until no work is in progress; False if `unless`, called on the loop, returned True first."""
        self.end_batch()
        if self._has_new_calls or self.work.is_busy:
            if not self.run(self.idle(unless=unless)):
                return False
            self._has_new_calls = False
        return True

    async def idle(self, *, unless: Callable[[], bool] = lambda: False, passes: int = _IDLE_PASSES) -> bool:
        """`wait_idle` on the loop: idle for `passes` passes, however long each takes."""
        idle_passes, calls, busy_passes = 0, self._calls, 0
        while idle_passes < passes:
            busy_passes += 1
            await asyncio.sleep(0 if idle_passes or busy_passes < _SPIN_PASSES else _POLL_S)
            if unless():
                return False
            idle_passes = 0 if self.work.is_busy or self._calls != calls else idle_passes + 1
            calls = self._calls
        return True

    async def _wait_delivered(self) -> None:
        idle_passes, deliveries = 0, self._deliveries
        while idle_passes < _IDLE_PASSES:
            await asyncio.sleep(0)
            idle_passes = idle_passes + 1 if self._deliveries == deliveries else 0
            deliveries = self._deliveries

    async def _shutdown_nodes(self) -> None:
        """Shut down all nodes."""
        self.is_ending = True
        shutdowns = [asyncio.create_task(node.shutdown()) for node in list(self.local.members)]
        if shutdowns:
            await asyncio.wait(shutdowns)

    def _log_waits(self) -> None:
        """Log every few seconds which work takes long."""
        if (line := self.work.notice()) is not None:
            print_log("info", line, wall_ns=time.time_ns(), sim_ns=None)
        self._loop.call_later(_CHECK_S, self._log_waits)

    def _run(self) -> None:
        _message_codec.request_time_slice(SLICE_NS)
        asyncio.set_event_loop(self._loop)
        self._loop.call_later(_CHECK_S, self._log_waits)
        try:
            self._loop.run_forever()
        finally:
            self._has_stopped = True
            self._loop.run_until_complete(self._loop.close_all())
            self._loop.run_until_complete(self._loop.shutdown_asyncgens())
            self._loop.close()
            self._drop_unstarted()


def _new_messages() -> "Messages":
    from ..messages.message_library import Messages  # lazy: rospy passes its own

    return Messages()


def _copy(task: "asyncio.Task[_T]", future: "Future[_T]") -> None:
    """Copy a task's result or exception to a future."""
    if task.cancelled():
        future.cancel()
        return
    error = task.exception()
    if future.cancelled():
        return
    if error is not None:
        if not isinstance(error, DescriptionError | UsageError):  # reported by the caller in one sentence
            _log.error("a task of the graph failed: %s: %s", type(error).__name__, error, exc_info=error)
        future.set_exception(error)
    else:
        future.set_result(task.result())


def _wait_result(future: Future[_T], timeout_s: float | None, poll: Callable[[], object] = lambda: None) -> _T:
    """Wait for a result, calling `poll` now and then; signals are handled in the main thread meanwhile."""
    end_s = math.inf if timeout_s is None else time.monotonic() + timeout_s
    while True:
        left_s = end_s - time.monotonic()
        try:
            return future.result(max(0.0, min(left_s, _WAIT_S)))
        except TimeoutError:
            if future.done():  # the coroutine has completed meanwhile, or raised TimeoutError itself
                return future.result()
            if left_s <= _WAIT_S:
                raise
            poll()
