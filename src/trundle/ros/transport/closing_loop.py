"""An event loop that closes what was opened in it, and its servers."""

import asyncio
from collections.abc import Mapping
from typing import Any
from weakref import WeakSet

from .fast_selector import FastSelector

_OPENING_S, _ENDING_S = 1.0, 1.0
"""How long servers may take to open, and tasks to end, when the loop is left."""
_ENDING_ROUNDS = 10
"""How often the loop looks again for what came while the rest was ended."""
_PASSES = 5
"""Passes of the loop in which a transport has opened or closed its socket."""


class ClosingLoop(asyncio.SelectorEventLoop):
    """An event loop that can close whatever was opened in it, however far that had come."""

    def __init__(self, selector: FastSelector) -> None:
        super().__init__(selector)
        self._servers: WeakSet[asyncio.Server] = WeakSet()
        """Those that listen: the loop's readers keep them."""
        self._opening: set[asyncio.Task[asyncio.Server]] = set()

    async def create_server(self, *args: Any, **options: Any) -> asyncio.Server:
        """As asyncio's, but a server is closed in the end even if whoever asked for it is cancelled meanwhile."""
        task = self.create_task(super().create_server(*args, **options))
        self._opening.add(task)
        task.add_done_callback(self._opened)
        return await asyncio.shield(task)

    async def close_all(self) -> None:
        """Close servers, end tasks, drop connections; in this order, so that little new comes in between.

        What does is ended in the next round, however slow the machine is; a task that will not end is left.
        """
        told: set[asyncio.Task[Any]] = set()
        for _ in range(_ENDING_ROUNDS):
            await self._close_servers()
            others = self._others()
            for task in others - told:
                task.cancel()
            told |= others
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
            for task in opened:  # their own callbacks may come only after this
                self._opened(task)
        while self._servers:
            await close_server(self._servers.pop())

    def _others(self) -> "set[asyncio.Task[Any]]":
        """Tasks beside the one that asks; half made, a server could not be closed."""
        return asyncio.all_tasks() - self._opening - {asyncio.current_task()}

    def _connected(self) -> list[asyncio.Transport]:
        # asyncio keeps the list to itself before Python 3.12.
        transports: Mapping[int, asyncio.Transport] = getattr(self, "_transports", {})
        return [transport for transport in list(transports.values()) if not transport.is_closing()]

    def _opened(self, task: "asyncio.Task[asyncio.Server]") -> None:
        self._opening.discard(task)
        if not task.cancelled() and task.exception() is None:
            self._servers.add(task.result())


async def close_server(server: asyncio.Server) -> None:
    """Close a server once nobody is at its door.

    A connection that was accepted just now becomes a transport in a pass of its own. asyncio forgets one whose server
    is closed by then, with its socket open.
    """
    loop = asyncio.get_running_loop()
    for socket in server.sockets:
        loop.remove_reader(socket.fileno())
    await _passes()
    server.close()


async def _passes() -> None:
    """Let the loop go round a few times: transports open and close their sockets in passes of their own."""
    for _ in range(_PASSES):
        await asyncio.sleep(0)
