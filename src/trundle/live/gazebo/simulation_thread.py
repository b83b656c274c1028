"""Thread of the simulation behind /gazebo."""

import asyncio
import logging
import threading
from collections.abc import Callable

from trundle.base.diagnostics import TrundleError
from trundle.base.waiting import WaitNotice
from trundle.ros import GraphLoop

from ..call_queue import CallQueue

_POLL_S = 0.5
_log = logging.getLogger(__name__)


class SimulationThread:
    """Runs functions that other threads queue, and calls `tick` between them; can be started again after `stop`."""

    def __init__(self, loop: GraphLoop, tick: Callable[[], None], end: Callable[[], None]) -> None:
        """Prepare.

        Args:
            loop: the nodes' event loop.
            tick: called on the thread, over and over.
            end: called on the thread before it ends.
        """
        self._loop = loop
        self._tick = tick
        self._end = end
        self._thread: threading.Thread | None = None
        self._reported: set[str] = set()
        self.calls = CallQueue(loop)
        """Functions for the thread, run between two ticks."""
        self.ending = threading.Event()
        """Set when the thread is to end."""

    @property
    def is_running(self) -> bool:
        """True from `start` to `stop`."""
        return self._thread is not None

    async def start(self, build: Callable[[], None]) -> None:
        """Start the thread, and wait until it has called `build`.

        Raises:
            TrundleError: building failed; the thread keeps running.
        """
        self._thread = threading.Thread(target=self._run, name="trundle-gazebo", daemon=True)
        built = asyncio.get_running_loop().create_future()

        def attempt() -> None:
            error = None
            try:
                build()
            except TrundleError as failure:
                error = failure
            self._loop.call_soon(lambda: settle(error))

        def settle(error: TrundleError | None) -> None:
            if built.done():  # the launch ended meanwhile
                return
            if error is None:
                built.set_result(None)
            else:
                built.set_exception(error)

        self.calls.post(attempt)
        self._thread.start()
        await built

    def stop(self) -> bool:
        """End the thread and drop its functions; return False if none was running."""
        thread, self._thread = self._thread, None
        if thread is None:
            return False
        self.ending.set()
        notice = WaitNotice("the simulation's last step")
        while thread.is_alive():
            thread.join(_POLL_S)
            notice.poll()
        self.calls.clear()
        self.ending.clear()
        return True

    def _run(self) -> None:
        try:
            while not self.ending.is_set():
                try:
                    self.calls.run_pending()
                    self._tick()
                except Exception as error:  # the thread keeps running, to answer service calls
                    self._report(error)
        finally:
            self._end()

    def _report(self, error: Exception) -> None:
        """Log an error with its traceback, once: each tick may raise the same."""
        text = f"{type(error).__name__}: {error}"
        if text not in self._reported:
            self._reported.add(text)
            _log.error("the simulation goes on after an error: %s", text, exc_info=error)
