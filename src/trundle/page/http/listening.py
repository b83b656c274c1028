"""Listening socket of the page."""

import os
import socket

from trundle.base.http.page_address import PageAddress

_DEFAULT_PORT = 8080
_PORTS_TRIED = 200
_BACKLOG = 128


class AddressError(Exception):
    """The address cannot be bound; the text is the reason."""


def listen(at: PageAddress) -> socket.socket:
    """Bind the requested port, by default 8080 or the next free one.

    Raises:
        AddressError: there is no such host, or the port is in use.
    """
    try:
        family, _, _, _, (address, *_) = socket.getaddrinfo(at.host, None, type=socket.SOCK_STREAM)[0]
    except OSError as error:
        raise AddressError(f"cannot serve the page at host '{at.host}': {error.strerror or error}") from None
    if at.port is not None:
        try:
            return _bind(family, str(address), at.port)
        except OSError as error:
            raise AddressError(
                f"cannot serve the page at {at.host}:{at.port}: {error.strerror}; "
                "leave out the port to take the next free one, or give another"
            ) from None
    last = _DEFAULT_PORT + _PORTS_TRIED - 1
    for port in range(_DEFAULT_PORT, last + 1):
        if port in at.reserved_ports:
            continue
        try:
            return _bind(family, str(address), port)
        except OSError:
            continue
    raise AddressError(f"no port from {_DEFAULT_PORT} to {last} is free at {at.host}; give one with --port")


def _bind(family: socket.AddressFamily, address: str, port: int) -> socket.socket:
    """Bind and listen.

    Raises:
        OSError: the port is in use.
    """
    listening = socket.socket(family, socket.SOCK_STREAM)
    try:
        if os.name == "posix":
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind((address, port))
        listening.listen(_BACKLOG)
    except OSError:
        listening.close()
        raise
    return listening
