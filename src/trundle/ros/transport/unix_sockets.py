"""A shorter way between Trundle's programs on one machine: Unix sockets, several times as fast as TCP over loopback.

A subscriber offers UNIXROS after TCPROS; a publisher that knows it puts a name behind the host and port it answers
anyway. What travels is the same. Where that fails, as between two machines or two users, TCP is used.
"""

import os
import secrets
import socket
import struct
import sys
from asyncio import AbstractEventLoop
from collections.abc import Sequence

UNIXROS = "UNIXROS"
_PREFIX = "trundle-"
"""Nobody can lead us to a socket of another program."""
_CREDENTIALS = struct.Struct("3i")
"""Process, user, group: unix(7), SO_PEERCRED."""


def listen_unix() -> tuple[socket.socket, str] | None:
    """Make a socket to listen at, with its name; None where the system has no names without files."""
    if sys.platform != "linux":
        return None
    name = _PREFIX + secrets.token_hex(16)
    listening = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        listening.bind(f"\0{name}")
    except OSError:  # a sandbox may forbid it
        listening.close()
        return None
    return listening, name


def unix_address(offered: Sequence[object]) -> str | None:
    """Return where to connect, out of what a publisher says after host and port."""
    match offered:
        case [str(name), *_] if name.startswith(_PREFIX) and name.isascii() and sys.platform == "linux":
            return f"\0{name}"
        case _:
            return None


async def connect_unix(loop: AbstractEventLoop, address: str) -> socket.socket:
    """Connect to a socket of this user.

    Raises:
        OSError: it is not here, or another user's.
    """
    sock = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        sock.setblocking(False)
        await loop.sock_connect(sock, address)
        if not is_of_this_user(sock):
            raise PermissionError("the socket is another user's")
    except BaseException:
        sock.close()
        raise
    return sock


def is_of_this_user(connected: socket.socket) -> bool:
    """Tell whether the other end is a process of this user; the names of sockets are no secret on a machine."""
    return _credentials(connected)[1] == os.geteuid()


def peer_process(connected: socket.socket) -> int | None:
    """Return the number of the process at the other end; None where it is another user's, or not to be seen."""
    process, user = _credentials(connected)
    return process if process > 0 and user == os.geteuid() else None


def _credentials(connected: socket.socket) -> tuple[int, int]:
    process, user, _ = _CREDENTIALS.unpack(
        connected.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, _CREDENTIALS.size)
    )
    return process, user
