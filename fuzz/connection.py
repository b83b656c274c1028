"""Raw connections to servers under test."""

import base64
import os
import socket
import struct
from contextlib import suppress

_HOST = "127.0.0.1"
_PATIENCE_S = 60.0
"""Time in which a working server answers on a busy machine [s]."""
_SHORT_WAIT_S = 0.05
"""Wait for an answer to a request that may be incomplete [s]."""
_CLOSE = 8
SEPARATOR = b"\r\n--\r\n"
"""Separator of the messages of one input."""


def exchange(port: int, data: bytes) -> None:
    """Send bytes, wait briefly for an answer, shut down the connection's sending half, and wait for the server's close.

    Raises:
        TimeoutError: the server does not close the connection.
    """
    with (
        socket.create_connection((_HOST, port), timeout=_PATIENCE_S) as connection,
        suppress(ConnectionError, BrokenPipeError),
    ):
        connection.sendall(data)
        connection.settimeout(_SHORT_WAIT_S)
        with suppress(TimeoutError):
            connection.recv(65536)
        connection.settimeout(_PATIENCE_S)
        connection.shutdown(socket.SHUT_WR)
        while connection.recv(65536):
            pass


def send_only(port: int, data: bytes) -> None:
    """Send bytes to a server that keeps the connection open, wait briefly for an answer, and close it."""
    with (
        socket.create_connection((_HOST, port), timeout=_PATIENCE_S) as connection,
        suppress(ConnectionError, BrokenPipeError),
    ):
        connection.sendall(data)
        connection.shutdown(socket.SHUT_WR)
        connection.settimeout(_SHORT_WAIT_S)
        with suppress(TimeoutError):
            while connection.recv(65536):
                pass


def send_web_socket(port: int, target: str, protocol: str | None, data: bytes) -> None:
    """Send the messages of an input over a WebSocket, and wait until the server has closed it.

    Args:
        port: server's port.
        target: path and query.
        protocol: requested subprotocol.
        data: messages separated by `SEPARATOR`; messages that start with a control character are binary.

    Raises:
        TimeoutError: the server does not close the connection.
        ConnectionError: the server does not accept the WebSocket.
    """
    with socket.create_connection((_HOST, port), timeout=_PATIENCE_S) as connection:
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET {target} HTTP/1.1", f"Host: {_HOST}:{port}", "Upgrade: websocket", "Connection: Upgrade"]
        lines += [f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13"]
        lines += [] if protocol is None else [f"Sec-WebSocket-Protocol: {protocol}"]
        connection.sendall("\r\n".join([*lines, "", ""]).encode())
        answer = b""
        while b"\r\n\r\n" not in answer:
            if not (chunk := connection.recv(65536)):
                break
            answer += chunk
        if b" 101 " not in answer[:20]:
            raise ConnectionError(f"no WebSocket: {answer[:200]!r}")
        with suppress(ConnectionError, BrokenPipeError):
            for message in data.split(SEPARATOR):
                connection.sendall(_frame(1 if message[:1] >= b" " else 2, message))
            connection.sendall(_frame(_CLOSE, struct.pack(">H", 1000)))
            while connection.recv(65536):
                pass


def _frame(opcode: int, payload: bytes) -> bytes:
    """Return a frame of a client; its mask is zero, so that the payload is unchanged."""
    size = len(payload)
    length = bytes([0x80 | size]) if size < 126 else bytes([0xFE]) + struct.pack(">H", size)
    if size > 0xFFFF:
        length = bytes([0xFF]) + struct.pack(">Q", size)
    return bytes([0x80 | opcode]) + length + bytes(4) + payload
