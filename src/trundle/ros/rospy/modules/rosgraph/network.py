"""Addresses of this machine, and the header of a TCPROS connection."""

import socket
import struct
from collections.abc import Mapping
from io import BytesIO
from typing import Any
from urllib.parse import urlparse

from trundle.ros.errors import WireError
from trundle.ros.transport.headers import decode_header, encode_header
from trundle.ros.transport.network import server_address

ROS_IP = "ROS_IP"
ROS_IPV6 = "ROS_IPV6"
ROS_HOSTNAME = "ROS_HOSTNAME"
SCHEMES = {"http": 80, "https": 443}


class ROSHandshakeException(Exception):
    """The peer's header is invalid, or it closed the connection."""


def parse_http_host_and_port(url: str) -> tuple[str, int]:
    """Split a URL into host and port.

    Raises:
        ValueError: not a URL.
    """
    parts = urlparse(url or "")
    if not parts.scheme or not parts.hostname:
        raise ValueError(f"not a valid URL: {url}")
    return parts.hostname, parts.port or SCHEMES.get(parts.scheme, 80)


def get_host_name() -> str:
    """Host in this machine's URIs."""
    return server_address().advertise


def get_address_override() -> str | None:
    """ROS_HOSTNAME or ROS_IP, if set."""
    import os

    return os.environ.get(ROS_HOSTNAME) or os.environ.get(ROS_IP) or None


def get_local_address() -> str:
    """Address of this machine."""
    return server_address().advertise


def get_local_addresses() -> list[str]:
    """Addresses of this machine."""
    try:
        addresses = {str(info[4][0]) for info in socket.getaddrinfo(socket.gethostname(), None)}
    except OSError:
        addresses = set[str]()
    return sorted({*addresses, "127.0.0.1"})


def get_bind_address(address: str | None = None) -> str:
    """Address that servers listen on."""
    return server_address(address).bind


def is_local_address(hostname: str) -> bool:
    """True if a host is this machine."""
    try:
        addresses = {str(info[4][0]) for info in socket.getaddrinfo(hostname, None)}
    except OSError:
        return False
    is_loopback = any(address.startswith("127.") for address in addresses)
    return is_loopback or bool(addresses & set(get_local_addresses()))


def use_ipv6() -> bool:
    """True if ROS_IPV6 is on."""
    import os

    return os.environ.get(ROS_IPV6) == "on"


def create_local_xmlrpc_uri(port: int) -> str:
    """URI of a server on this machine."""
    return f"http://{get_host_name()}:{port}/"


def decode_ros_handshake_header(header_str: bytes) -> dict[str, str]:
    """Decode a header after its length; spaces around names are removed.

    Raises:
        ROSHandshakeException: it is invalid.
    """
    (size,) = struct.unpack("<I", header_str[:4])
    if size > len(header_str) - 4:
        raise ROSHandshakeException(f"Incomplete header. Expected {size} bytes but only have {len(header_str) - 4}")
    try:
        return {name.strip(): value for name, value in decode_header(header_str[4 : 4 + size]).items()}
    except WireError as error:
        raise ROSHandshakeException(str(error)) from None


def encode_ros_handshake_header(header: Mapping[Any, Any]) -> bytes:
    """Encode a header after its length, with fields sorted by name."""
    fields = {_as_text(name): _as_text(value) for name, value in header.items()}
    return encode_header(dict(sorted(fields.items())))


def _as_text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def read_ros_handshake_header(sock: socket.socket, b: BytesIO, buff_size: int) -> dict[str, str]:
    """Read a header from a socket; `b` holds data received before and after it.

    Raises:
        ROSHandshakeException: the peer closed the connection, or its header is invalid.
    """
    while True:
        data = b.getvalue()
        if len(data) >= 4 and len(data) >= 4 + struct.unpack("<I", data[:4])[0]:
            break
        more = sock.recv(buff_size)
        if not more:
            raise ROSHandshakeException("connection from sender terminated before handshake header received.")
        b.seek(0, 2)
        b.write(more)
    (size,) = struct.unpack("<I", data[:4])
    b.seek(0)
    b.truncate(0)
    b.write(data[4 + size :])
    return decode_ros_handshake_header(data[: 4 + size])


def write_ros_handshake_header(sock: socket.socket, header: Mapping[str, Any]) -> int:
    """Write a header to a socket; returns its size [bytes]."""
    data = encode_ros_handshake_header(header)
    sock.sendall(data)
    return len(data)
