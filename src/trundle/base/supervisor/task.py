"""Job that runs as a coroutine of this process."""

import asyncio
import traceback
from collections.abc import Callable, Coroutine

from trundle.base.diagnostics import TrundleError

from .job import StopTimeouts


class TaskJob:
    """Runs a coroutine function that returns the exit code."""

    def __init__(self, name: str, run: Callable[[], Coroutine[object, object, int]]) -> None:
        self.name = name
        self._run = run
        self._task: asyncio.Task[int] | None = None
        self._last: list[str] = []

    async def start(self) -> str:
        self._last = []
        self._task = asyncio.get_running_loop().create_task(self._run(), name=self.name)
        return "within this process"

    async def wait(self) -> int:
        assert self._task is not None, "start() comes before wait()"
        await asyncio.wait([self._task])
        if self._task.cancelled():
            return 0
        error = self._task.exception()
        if error is None:
            return self._task.result()
        # A TrundleError is a sentence for the user; anything else is a bug and needs its traceback.
        self._last = (str(error) if isinstance(error, TrundleError) else _trace(error)).splitlines()
        return 1

    async def stop(self, timeouts: StopTimeouts) -> None:
        if self._task is None or self._task.done():
            return
        self._task.cancel()
        await asyncio.wait([self._task], timeout=timeouts.terminate_s)

    def last_output(self) -> list[str]:
        return self._last


def _trace(error: BaseException) -> str:
    return "".join(traceback.format_exception(error))
