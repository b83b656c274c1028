"""Connections read as soon as the system names them, past what asyncio does between that and a protocol."""

import logging
import os
import select
import selectors
import socket
from collections.abc import Callable

_log = logging.getLogger(__name__)
_AT_ONCE = 64
"""As many sockets as are looked at before others get their turn on the loop."""


class FastSelector(selectors.DefaultSelector):
    """A selector for an asyncio loop, which has some sockets of its own: it calls their readers itself."""

    def __init__(self) -> None:
        super().__init__()
        self._readers: dict[int, Callable[[], None]] = {}
        """By the socket's number."""
        has_epoll = hasattr(select, "epoll")
        self._epoll = select.epoll.fromfd(os.dup(self.fileno())) if has_epoll else None
        """The selector's own, to ask it directly: the way through its keys takes as long as reading a message."""

    def add_reader(self, sock: socket.socket, readable: Callable[[], None]) -> None:
        """Call `readable` on the loop whenever a socket has something to read, or has ended, until `forget`."""
        self.register(sock, selectors.EVENT_READ)
        self._readers[sock.fileno()] = readable

    def remove_reader(self, sock: socket.socket) -> None:
        """Leave a socket alone from now on; before it is closed."""
        del self._readers[sock.fileno()]
        self.unregister(sock)

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """As the loop calls it, who hears of its own sockets only."""
        if self._epoll is not None:
            events, ready = self._epoll.poll(timeout, _AT_ONCE), None
        else:
            ready = super().select(timeout)
            events = [(key.fd, mask) for key, mask in ready]
        has_more = False
        for number, _ in events:
            if (readable := self._readers.get(number)) is None:
                has_more = True
                continue
            try:
                readable()
            except Exception:  # as in asyncio, the loop goes on
                _log.exception("a connection could not be read")
        if not has_more:
            return []
        return [event for event in ready or super().select(0.0) if event[0].fd not in self._readers]

    def close(self) -> None:
        """Close what the system gave."""
        super().close()
        if self._epoll is not None:
            self._epoll.close()
