"""Connections read as soon as the system names them, past what asyncio does between that and a protocol."""

import logging
import selectors
import socket
from collections.abc import Callable
from typing import Any

_log = logging.getLogger(__name__)


class ReadingSelector(selectors.DefaultSelector):
    """A selector for an asyncio loop, which has some sockets of its own: it calls their readers itself."""

    def read(self, sock: socket.socket, readable: Callable[[], None]) -> None:
        """Call `readable` on the loop whenever a socket has something to read, or has ended, until `forget`."""
        self.register(sock, selectors.EVENT_READ, readable)

    def forget(self, sock: socket.socket) -> None:
        """Leave a socket alone from now on; before it is closed."""
        self.unregister(sock)

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """As the loop calls it, who hears of its own sockets only."""
        ready = super().select(timeout)
        rest: list[tuple[selectors.SelectorKey, int]] = []
        for event in ready:
            data: Any = event[0].data
            if type(data) is tuple:  # asyncio's two handles
                rest.append(event)
                continue
            try:
                data()
            except Exception:  # as in asyncio, the loop goes on
                _log.exception("a connection could not be read")
        return rest
