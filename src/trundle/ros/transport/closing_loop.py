"""Event loop that closes everything opened in it, and orderly closing of servers."""

import asyncio
import errno
import logging
import os
import socket
from collections.abc import Coroutine, Mapping
from typing import Any
from weakref import WeakSet

from trundle.base.shortage import shortage

from .fast_selector import FastSelector

_log = logging.getLogger(__name__)
_OPENING_S, _ENDING_S = 1.0, 1.0
"""Timeouts at the loop's end: for servers being opened, and for tasks."""
_ENDING_ROUNDS = 10
"""Rounds of closing, for what is opened meanwhile."""
_PASSES = 5
"""Passes of the loop in which a transport opens or closes its socket."""
_SAME_SHORTAGE_S = 10.0
"""A shortage that recurs within this time is not reported again."""


class ClosingLoop(asyncio.SelectorEventLoop):
    """Event loop that closes all servers, tasks and connections opened in it."""

    def __init__(self, selector: FastSelector) -> None:
        try:
            super().__init__(selector)
        except OSError:
            self._closed = True  # asyncio would close what it did not open
            raise
        self._servers: WeakSet[asyncio.Server] = WeakSet()
        """Listening servers."""
        self._opening: set[asyncio.Task[asyncio.Server]] = set()
        self._shortage_s = -_SAME_SHORTAGE_S
        """Time of the last shortage."""

    async def create_server(self, *args: Any, backlog: int = 100, **options: Any) -> asyncio.Server:
        """Create a server that is closed at the end even if its creator is cancelled."""
        task = self.create_task(self._create_server(super().create_server(*args, backlog=1, **options), backlog))
        self._opening.add(task)
        task.add_done_callback(self._opened)
        return await asyncio.shield(task)

    @staticmethod
    async def _create_server(creating: Coroutine[Any, Any, asyncio.Server], backlog: int) -> asyncio.Server:
        """Let the system queue connections of which asyncio accepts one in each pass.

        It tries to accept as many as it queues, without a pause when the process has no descriptor left, and returns
        a server without sockets if it could open none.
        """
        server = await creating
        try:
            if not server.sockets:
                socket.socket().close()
                raise OSError(errno.EAFNOSUPPORT, os.strerror(errno.EAFNOSUPPORT))
            for listening in server.sockets:
                with socket.fromfd(listening.fileno(), listening.family, listening.type) as same:
                    same.listen(backlog)
        except OSError:
            server.close()
            raise
        return server

    def default_exception_handler(self, context: dict[str, Any]) -> None:
        """Report in one sentence what the process ran out of, anything else as asyncio does."""
        error = context.get("exception")
        if (reason := shortage(error)) is not None:
            if self.time() > self._shortage_s + _SAME_SHORTAGE_S:
                accepts = "; connections are accepted again then" if "socket" in context else ""
                _log.error("%s%s", reason, accepts)
            self._shortage_s = self.time()
        elif not (isinstance(error, ValueError) and "_start_serving" in context["message"]):
            # ValueError: the server was closed before asyncio tried to accept again
            super().default_exception_handler(context)

    async def close_all(self) -> None:
        """Close servers, cancel tasks, abort connections; in this order, to limit what is opened meanwhile.

        Repeats until nothing is left, up to a limit; tasks that do not end are abandoned.
        """
        cancelled: set[asyncio.Task[Any]] = set()
        for _ in range(_ENDING_ROUNDS):
            await self._close_servers()
            others = self._others()
            for task in others - cancelled:
                task.cancel()
            cancelled |= others
            if others:
                await asyncio.wait(others, timeout=_ENDING_S / _ENDING_ROUNDS)
            for transport in self._connected():
                transport.abort()
            await _passes()
            if not (self._others() or self._opening or self._connected()):
                return

    async def _close_servers(self) -> None:
        if self._opening:
            opened, _ = await asyncio.wait(self._opening, timeout=_OPENING_S / _ENDING_ROUNDS)
            for task in opened:  # their done callbacks may run later
                self._opened(task)
        while self._servers:
            await close_server(self._servers.pop())

    def _others(self) -> "set[asyncio.Task[Any]]":
        """Tasks other than the current one and servers being created, which could not be closed."""
        return asyncio.all_tasks() - self._opening - {asyncio.current_task()}

    def _connected(self) -> list[asyncio.Transport]:
        # private in asyncio before Python 3.12
        transports: Mapping[int, asyncio.Transport] = getattr(self, "_transports", {})
        return [transport for transport in list(transports.values()) if not transport.is_closing()]

    def _opened(self, task: "asyncio.Task[asyncio.Server]") -> None:
        self._opening.discard(task)
        if not task.cancelled() and task.exception() is None:
            self._servers.add(task.result())


async def close_server(server: asyncio.Server) -> None:
    """Close a server after pending accepts.

    A connection just accepted becomes a transport in a later pass; if its server is closed by then, asyncio leaks its
    socket.
    """
    loop = asyncio.get_running_loop()
    for listening in server.sockets:
        loop.remove_reader(listening.fileno())
    await _passes()
    server.close()


async def _passes() -> None:
    """Let the loop run some passes, in which transports open and close their sockets."""
    for _ in range(_PASSES):
        await asyncio.sleep(0)
