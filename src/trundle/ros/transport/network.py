"""Addresses that servers of this process bind and advertise."""

import os
import socket
from typing import NamedTuple

LOOPBACK, _LOOPBACK_6 = "127.0.0.1", "::1"
DEFAULT_MASTER_URI = "http://localhost:11311"


class ServerAddress(NamedTuple):
    """Address a server binds, and the host its URIs name."""

    bind: str
    advertise: str
    warning: str | None = None
    """Reason why ROS_HOSTNAME or ROS_IP is ignored, in one sentence."""

    def authority(self, port: int) -> str:
        """Authority of a URI, host:port; an IPv6 address is in brackets."""
        return f"[{self.advertise}]:{port}" if ":" in self.advertise else f"{self.advertise}:{port}"


def master_uri_from_env() -> str:
    """ROS_MASTER_URI, or its default."""
    return os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER_URI


def server_address(host: str | None = None) -> ServerAddress:
    """Choose the address to bind: `host`, or loopback (IPv6's if ROS_HOSTNAME or ROS_IP resolves to it).

    ROS_HOSTNAME and ROS_IP name the address to advertise. They are ignored unless they resolve to the bound address,
    since the node would be unreachable.
    """
    name = os.environ.get("ROS_HOSTNAME") or os.environ.get("ROS_IP")
    bind = host or LOOPBACK
    if host is None and name and not _resolves_to(name, LOOPBACK) and _resolves_to(name, _LOOPBACK_6):
        bind = _LOOPBACK_6
    is_wildcard = bind in ("0.0.0.0", "::", "")
    if name and (is_wildcard or _resolves_to(name, bind)):
        return ServerAddress(bind=bind, advertise=name)
    warning = None
    if name:
        warning = (
            f"ROS_HOSTNAME or ROS_IP is {name!r} but the server listens on {bind}, so {bind} is advertised; "
            f"listen on that address (or 0.0.0.0) to be reachable from other machines"
        )
    return ServerAddress(bind=bind, advertise=socket.gethostname() if is_wildcard else bind, warning=warning)


def _resolves_to(name: str, address: str) -> bool:
    try:
        resolved = {str(info[4][0]) for info in socket.getaddrinfo(name, None, type=socket.SOCK_STREAM)}
        bound = {str(info[4][0]) for info in socket.getaddrinfo(address, None, type=socket.SOCK_STREAM)}
    except OSError:
        return False
    return bool(resolved & bound)
