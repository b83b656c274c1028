"""Queue of slave API calls (publisherUpdate, paramUpdate, shutdown), one at a time per node, without blocking.

A call to a slow or suspended node waits until the node answers or its connection breaks.
"""

import asyncio
import logging
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any, TypeAlias

from ..errors import RosError
from ..xmlrpc.rpc_client import call
from ..xmlrpc.xmlrpc_text import FaultError

_log = logging.getLogger(__name__)
Pending: TypeAlias = Callable[[str], AbstractContextManager[None]]
"""Tracks work in progress, by its description."""
_MAX_NODES = 256
"""Maximum number of nodes with a call in progress, since each holds a socket; beyond it the oldest is cancelled."""
_SUPERSEDABLE = ("publisherUpdate", "paramUpdate")
"""Methods whose newest call for a topic or parameter supersedes a queued one."""


class SlaveCalls:
    """One queue of calls per node address."""

    def __init__(self, pending: Pending) -> None:
        self._pending = pending
        self._queues: dict[str, list[tuple[str, tuple[Any, ...]]]] = {}
        self._tasks: dict[asyncio.Task[None], None] = {}
        """One per node, oldest first."""

    def send(self, uri: str, method: str, *arguments: object) -> None:
        """Queue a call; it replaces a queued call about the same topic or parameter."""
        queue = self._queues.get(uri)
        if queue is None:
            self._queues[uri] = queue = []
            if len(self._tasks) >= _MAX_NODES:
                next(iter(self._tasks)).cancel()
            task = asyncio.get_running_loop().create_task(self._run(uri, queue))
            self._tasks[task] = None
            task.add_done_callback(lambda done: self._tasks.pop(done, None))
        if method in _SUPERSEDABLE:
            queue[:] = [(m, a) for m, a in queue if (m, a[:2]) != (method, arguments[:2])]
        queue.append((method, arguments))

    async def stop(self) -> None:
        """Cancel all queued calls."""
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _run(self, uri: str, queue: list[tuple[str, tuple[Any, ...]]]) -> None:
        try:
            with self._pending(f"the answer of the node at {uri} to the ROS master"):
                while queue:
                    method, arguments = queue.pop(0)
                    try:
                        await call(uri, method, *arguments)
                    except (OSError, RosError, FaultError, ValueError) as error:
                        _log.debug("%s of %s: %s", method, uri, error)
        finally:
            self._queues.pop(uri, None)
