"""A slow connection for tests: forwards TCP connections to a server, at a limited rate from the server to clients."""

import asyncio
import contextlib
import socket
import threading
from types import TracebackType
from typing import Self
from urllib.parse import urlsplit

_CHUNK_S = 0.02
"""Time that one chunk takes at the limited rate."""


class ThrottledLink:
    """Forwards connections to a server, on a thread of its own."""

    def __init__(self, url: str, *, bytes_per_s: float, buffer_bytes: int = 8192) -> None:
        """Create it.

        Args:
            url: address of the server.
            bytes_per_s: rate from the server to a client; it may be changed at any time.
            buffer_bytes: data of the server that the link holds.
        """
        self._server = urlsplit(url)
        self.bytes_per_s = bytes_per_s
        self._buffer_bytes = buffer_bytes
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._listening.setblocking(False)
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._run, name="throttled-link", daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        """Address of the server over the link."""
        port = self._listening.getsockname()[1]
        return self._server._replace(netloc=f"127.0.0.1:{port}").geturl()

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        accepting = self._loop.create_task(self._accept())
        self._loop.run_forever()
        for task in asyncio.all_tasks(self._loop):
            task.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            self._loop.run_until_complete(accepting)
        self._loop.run_until_complete(self._loop.shutdown_asyncgens())
        self._loop.close()

    async def _accept(self) -> None:
        async with asyncio.TaskGroup() as forwarding:
            while True:
                client, _ = await self._loop.sock_accept(self._listening)
                forwarding.create_task(self._forward(client))

    async def _forward(self, client: socket.socket) -> None:
        server = socket.socket()
        server.setblocking(False)
        client.setblocking(False)
        server.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, self._buffer_bytes)
        client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        server.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        with client, server:
            await self._loop.sock_connect(server, (self._server.hostname, self._server.port))
            ways = [
                asyncio.ensure_future(self._copy(client, server, is_limited=False)),
                asyncio.ensure_future(self._copy(server, client, is_limited=True)),
            ]
            try:
                await asyncio.wait(ways, return_when=asyncio.FIRST_COMPLETED)
            finally:
                for way in ways:
                    way.cancel()
                await asyncio.gather(*ways, return_exceptions=True)

    async def _copy(self, source: socket.socket, target: socket.socket, *, is_limited: bool) -> None:
        free_s = self._loop.time()
        with contextlib.suppress(ConnectionError):
            while True:
                size = max(int(self.bytes_per_s * _CHUNK_S), 512) if is_limited else 65536
                data = await self._loop.sock_recv(source, size)
                if not data:
                    return
                if is_limited:
                    free_s = max(free_s, self._loop.time() - _CHUNK_S) + len(data) / self.bytes_per_s
                    await asyncio.sleep(free_s - self._loop.time())
                await self._loop.sock_sendall(target, data)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._listening.close()
