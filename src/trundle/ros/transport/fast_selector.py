"""Selector that reads connections directly, bypassing asyncio's dispatch to protocols."""

import logging
import os
import select
import selectors
import socket
from collections.abc import Callable

_log = logging.getLogger(__name__)
_MAX_EVENTS = 64
"""Maximum sockets read per poll, for fairness to other work on the loop."""


class FastSelector(selectors.DefaultSelector):
    """Selector of an asyncio loop that itself calls the readers of sockets added with `add_reader`."""

    def __init__(self) -> None:
        super().__init__()
        self._readers: dict[int, Callable[[], object]] = {}
        """Readers by file descriptor."""
        has_epoll = hasattr(select, "epoll")
        self._epoll = select.epoll.fromfd(os.dup(self.fileno())) if has_epoll else None
        """Duplicate of the selector's epoll, polled directly: the lookup of keys takes as long as reading a message."""

    def add_reader(self, sock: socket.socket, readable: Callable[[], object]) -> None:
        """Call `readable` on the loop whenever the socket is readable or closed, until `remove_reader`."""
        self.register(sock, selectors.EVENT_READ)
        self._readers[sock.fileno()] = readable

    def remove_reader(self, sock: socket.socket) -> None:
        """Stop calling the socket's reader; call before closing the socket."""
        del self._readers[sock.fileno()]
        self.unregister(sock)

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Poll; call the readers and return only the loop's events."""
        if self._epoll is not None:
            events, ready = self._epoll.poll(timeout, _MAX_EVENTS), None
        else:
            ready = super().select(timeout)
            events = [(key.fd, mask) for key, mask in ready]
        has_loop_events = False
        for number, _ in events:
            if (readable := self._readers.get(number)) is None:
                has_loop_events = True
                continue
            try:
                readable()
            except Exception:  # as in asyncio, the loop goes on
                _log.exception("a connection could not be read")
        if not has_loop_events:
            return []
        return [event for event in ready or super().select(0.0) if event[0].fd not in self._readers]

    def close(self) -> None:
        """Close both epoll file descriptors."""
        super().close()
        if self._epoll is not None:
            self._epoll.close()
