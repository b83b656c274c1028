"""Queue of slave API calls (publisherUpdate, paramUpdate, shutdown), one at a time per node, without blocking."""

import asyncio
import logging
from typing import Any

from ..errors import RosError
from ..xmlrpc.rpc_client import call
from ..xmlrpc.xmlrpc import FaultError

_log = logging.getLogger(__name__)
_TIMEOUT_S = 5.0
_SUPERSEDABLE = ("publisherUpdate", "paramUpdate")
"""Methods whose newest call for a topic or parameter supersedes a queued one."""


class SlaveCalls:
    """One queue of calls per node address."""

    def __init__(self) -> None:
        self._waiting: dict[str, list[tuple[str, tuple[Any, ...]]]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def send(self, uri: str, method: str, *arguments: object) -> None:
        """Queue a call; it replaces a queued call about the same topic or parameter."""
        queue = self._waiting.get(uri)
        if queue is None:
            self._waiting[uri] = queue = []
            task = asyncio.get_running_loop().create_task(self._run(uri, queue))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)
        if method in _SUPERSEDABLE:
            queue[:] = [(m, a) for m, a in queue if (m, a[:2]) != (method, arguments[:2])]
        queue.append((method, arguments))

    @property
    def is_busy(self) -> bool:
        """True while calls are queued or in progress."""
        return bool(self._waiting)

    async def stop(self) -> None:
        """Cancel all queued calls."""
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _run(self, uri: str, queue: list[tuple[str, tuple[Any, ...]]]) -> None:
        try:
            while queue:
                method, arguments = queue.pop(0)
                try:
                    await call(uri, method, *arguments, timeout_s=_TIMEOUT_S)
                except (OSError, RosError, FaultError, ValueError) as error:
                    _log.debug("%s of %s: %s", method, uri, error)
        finally:
            self._waiting.pop(uri, None)
