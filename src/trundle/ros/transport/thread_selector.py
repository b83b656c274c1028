"""Selector of a thread that waits for its sockets and reads them itself."""

import contextlib
import logging
import selectors
import socket
import threading
from collections.abc import Callable

_log = logging.getLogger(__name__)
_Selector = getattr(selectors, "PollSelector", selectors.SelectSelector)
"""As fast as epoll for the few publishers of a topic, without a file descriptor of its own."""


class ThreadSelector:
    """Sockets that one thread reads; other threads add and remove sockets, and wake it."""

    def __init__(self) -> None:
        self.is_waiting = False
        """True from the thread's decision to wait until it is awake."""
        self._selector = _Selector()
        self._readers: dict[int, Callable[[], object]] = {}
        """Readers by file descriptor."""
        self._lock = threading.RLock()
        """Held while a socket is read, added or removed."""
        self._waker, self._woken = socket.socketpair()
        self._waker.setblocking(False)
        self.add_reader(self._woken, lambda: self._woken.recv(64))

    def add_reader(self, sock: socket.socket, readable: Callable[[], object]) -> None:
        """Call `readable` in the thread whenever the socket is readable or closed, until `remove_reader`."""
        with self._lock:
            if self._waker.fileno() < 0:  # closed
                return
            self._selector.register(sock, selectors.EVENT_READ)
            self._readers[sock.fileno()] = readable
        self.wake()  # to wait for this socket, too

    def remove_reader(self, sock: socket.socket) -> None:
        """Stop calling the socket's reader, which does not run any more; call before closing the socket."""
        with self._lock:
            if self._readers.pop(sock.fileno(), None) is not None:
                self._selector.unregister(sock)

    def wake(self) -> None:
        """End the thread's wait; thread-safe."""
        if self.is_waiting:
            self.is_waiting = False
            with contextlib.suppress(OSError):  # it has ended
                self._waker.send(b"\0")

    def read(self, timeout: float | None) -> bool:
        """Wait for readable sockets, and call their readers; False if none was readable within the timeout [s]."""
        try:
            ready = self._selector.select(timeout)
        except OSError:  # on Windows, a socket was closed meanwhile
            return False
        finally:
            self.is_waiting = False
        for key, _ in ready:
            with self._lock:
                if (readable := self._readers.get(key.fd)) is None:
                    continue  # removed meanwhile
                try:
                    readable()
                except Exception:  # as in asyncio, the thread goes on
                    _log.exception("a connection could not be read")
        return bool(ready)

    def close(self) -> None:
        """Forget all sockets; in the thread."""
        with self._lock:
            self._readers.clear()
            self._selector.close()
            self._waker.close()
            self._woken.close()
