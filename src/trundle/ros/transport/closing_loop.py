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
"""Rounds of closing, since cancelled tasks may open more."""
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
            self._closed = True  # else asyncio's destructor closes pipes that were never opened
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
        task.add_done_callback(self._on_created)
        return await asyncio.shield(task)

    @staticmethod
    async def _create_server(coroutine: Coroutine[Any, Any, asyncio.Server], backlog: int) -> asyncio.Server:
        """Create a server that accepts one connection per pass; the system queues `backlog` more.

        asyncio would accept its whole backlog per pass, without a pause when the process is out of file descriptors,
        and returns a server without sockets if it could open none.
        """
        server = await coroutine
        try:
            if not server.sockets:
                socket.socket().close()
                raise OSError(errno.EAFNOSUPPORT, os.strerror(errno.EAFNOSUPPORT))
            for listener in server.sockets:
                with socket.fromfd(listener.fileno(), listener.family, listener.type) as duplicate:
                    duplicate.listen(backlog)
        except OSError:
            server.close()
            raise
        return server

    def default_exception_handler(self, context: dict[str, Any]) -> None:
        """Report a shortage, such as of file descriptors, in one sentence, and other exceptions as asyncio does."""
        error = context.get("exception")
        if (reason := shortage(error)) is not None:
            if self.time() > self._shortage_s + _SAME_SHORTAGE_S:
                suffix = "; after that, new connections are accepted again" if "socket" in context else ""
                _log.error("%s%s", reason, suffix)
            self._shortage_s = self.time()
        elif not (isinstance(error, ValueError) and "_start_serving" in context["message"]):
            # ValueError: the server was closed before asyncio tried to accept again
            super().default_exception_handler(context)

    async def close_all(self) -> None:
        """Close servers, cancel tasks, abort connections; in this order, so that fewer are opened meanwhile.

        Repeats until nothing is left, up to a limit; tasks that do not end are abandoned.
        """
        cancelled: set[asyncio.Task[Any]] = set()
        for _ in range(_ENDING_ROUNDS):
            await self._close_servers()
            tasks = self._other_tasks()
            for task in tasks - cancelled:
                task.cancel()
            cancelled |= tasks
            if tasks:
                await asyncio.wait(tasks, timeout=_ENDING_S / _ENDING_ROUNDS)
            for transport in self._open_transports():
                transport.abort()
            await _passes()
            if not (self._other_tasks() or self._opening or self._open_transports()):
                return

    async def _close_servers(self) -> None:
        if self._opening:
            done, _ = await asyncio.wait(self._opening, timeout=_OPENING_S / _ENDING_ROUNDS)
            for task in done:  # their done callbacks may run later
                self._on_created(task)
        while servers := list(self._servers):  # strong references: one that is collected meanwhile would leave the set
            self._servers.difference_update(servers)
            for server in servers:
                await close_server(server)

    def _other_tasks(self) -> "set[asyncio.Task[Any]]":
        """Tasks except the current one and those that create servers, which cannot be closed if it is cancelled."""
        return asyncio.all_tasks() - self._opening - {asyncio.current_task()}

    def _open_transports(self) -> list[asyncio.Transport]:
        # private in asyncio before Python 3.12
        transports: Mapping[int, asyncio.Transport] = getattr(self, "_transports", {})
        return [transport for transport in list(transports.values()) if not transport.is_closing()]

    def _on_created(self, task: "asyncio.Task[asyncio.Server]") -> None:
        self._opening.discard(task)
        if not task.cancelled() and task.exception() is None:
            self._servers.add(task.result())


async def close_server(server: asyncio.Server) -> None:
    """Close a server after pending accepts.

    A connection just accepted becomes a transport in a later pass; if its server is closed by then, asyncio leaks its
    socket.
    """
    loop = asyncio.get_running_loop()
    for listener in server.sockets:
        loop.remove_reader(listener.fileno())
    await _passes()
    server.close()


async def _passes() -> None:
    """Let the loop run some passes, in which transports open and close their sockets."""
    for _ in range(_PASSES):
        await asyncio.sleep(0)
