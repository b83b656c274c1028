"""Unix sockets between Trundle's programs on one machine, several times as fast as TCP over loopback.

A subscriber offers UNIXROS after TCPROS; a publisher that supports it appends a socket name to the host and port of its
TCPROS answer. The stream is the same. If connecting fails, as between two machines or users, TCP is used.
"""

import os
import socket
import struct
import sys
from asyncio import AbstractEventLoop
from collections.abc import Sequence

UNIXROS = "UNIXROS"
_PREFIX = "trundle-"
"""Required prefix, so that no peer can direct us to another program's socket."""
_CREDENTIALS = struct.Struct("3i")
"""Process, user and group ID: unix(7), SO_PEERCRED."""


def listen_unix() -> tuple[socket.socket, str] | None:
    """Create a listening socket and its name; None where abstract socket names are not supported."""
    if sys.platform != "linux":
        return None
    name = _PREFIX + os.urandom(16).hex()
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        listener.bind(f"\0{name}")
    except OSError:  # a sandbox may forbid it
        listener.close()
        return None
    return listener, name


def unix_address(protocol_params: Sequence[object]) -> str | None:
    """Socket address in a publisher's protocol parameters after host and port; None if there is none."""
    match protocol_params:
        case [str(name), *_] if name.startswith(_PREFIX) and name.isascii() and sys.platform == "linux":
            return f"\0{name}"
        case _:
            return None


async def connect_unix(loop: AbstractEventLoop, address: str) -> socket.socket:
    """Connect to a socket of this user.

    Raises:
        OSError: no such socket, or it belongs to another user.
    """
    sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        sock.setblocking(False)
        await loop.sock_connect(sock, address)
        if not is_of_this_user(sock):
            raise PermissionError("the socket belongs to another user")
    except BaseException:
        sock.close()
        raise
    return sock


def is_of_this_user(connected: socket.socket) -> bool:
    """True if the peer is a process of this user; abstract socket names are visible to all users."""
    return _credentials(connected)[1] == os.geteuid()


def peer_process(connected: socket.socket) -> int | None:
    """Process ID of the peer; None if it belongs to another user, or is not visible."""
    process, user = _credentials(connected)
    return process if process > 0 and user == os.geteuid() else None


def _credentials(connected: socket.socket) -> tuple[int, int]:
    process, user, _ = _CREDENTIALS.unpack(
        connected.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, _CREDENTIALS.size)
    )
    return process, user
