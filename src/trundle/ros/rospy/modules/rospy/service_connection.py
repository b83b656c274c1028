"""A client's connection to a service."""

import contextlib
import socket
import struct
from collections.abc import Mapping
from typing import Any

from trundle.ros.errors import WireError
from trundle.ros.transport.headers import MAX_HEADER_BYTES, MAX_MESSAGE_BYTES, decode_header, encode_header

from . import core
from .exceptions import TransportInitError, TransportTerminated

_CONNECT_S = 60.0
_POLL_S = 0.5


class ServiceConnection:
    """TCPROS connection that carries one request at a time; blocking."""

    def __init__(self, address: tuple[str, int], header: Mapping[str, str]) -> None:
        """Connect and exchange headers.

        Raises:
            TransportInitError: refused.
        """
        try:
            self._socket = socket.create_connection(address, timeout=_CONNECT_S)
        except OSError as error:
            raise TransportInitError(f"unable to connect to {address[0]}:{address[1]}: {error}") from None
        try:
            self._socket.settimeout(_POLL_S)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._socket.sendall(encode_header(header))
            self.header = decode_header(self._frame(MAX_HEADER_BYTES))
        except (OSError, WireError, TransportTerminated) as error:
            self.close()
            raise TransportInitError(str(error)) from None
        if "error" in self.header:
            self.close()
            raise TransportInitError(f"remote error reported: {self.header['error']}")

    def exchange(self, request: tuple[bytes | memoryview, ...]) -> tuple[bool, bytes]:
        """Send a request after its length; returns success and the response or the error's text.

        Raises:
            TransportTerminated: the connection broke, or this node was shut down.
        """
        try:
            self._send(b"".join(request))
            is_good = self._exactly(1) == b"\x01"
            return is_good, self._frame(MAX_MESSAGE_BYTES)
        except OSError as error:
            raise TransportTerminated(
                f"unable to receive data from sender, check sender's logs for details: {error}"
            ) from None

    def close(self) -> None:
        """Close the connection."""
        with contextlib.suppress(OSError):
            self._socket.close()

    def _send(self, data: bytes) -> None:
        view = memoryview(data)
        while view:
            try:
                view = view[self._socket.send(view) :]
            except TimeoutError:
                _refuse_shutdown()

    def _frame(self, limit: int) -> bytes:
        (size,) = struct.unpack("<I", self._exactly(4))
        if size > limit:
            raise TransportTerminated(f"{size} bytes are announced, more than the {limit} accepted")
        return self._exactly(size)

    def _exactly(self, size: int) -> bytes:
        parts: list[Any] = []
        while size:
            try:
                part = self._socket.recv(min(size, 1 << 20))
            except TimeoutError:
                _refuse_shutdown()
                continue
            if not part:
                raise TransportTerminated("unable to receive data from sender, check sender's logs for details")
            parts.append(part)
            size -= len(part)
        return b"".join(parts)


def _refuse_shutdown() -> None:
    if core.is_shutdown():
        raise TransportTerminated("the node was shut down")
