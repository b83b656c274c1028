"""Where servers of this process listen and which address they give out."""

import os
import socket
from dataclasses import dataclass

LOOPBACK, _LOOPBACK_6 = "127.0.0.1", "::1"
DEFAULT_MASTER_URI = "http://localhost:11311"


@dataclass(frozen=True, slots=True, kw_only=True)
class ServerAddress:
    """What a server binds and what its URIs say."""

    bind: str
    advertise: str
    warning: str | None = None
    """What the environment asks for and does not get, in one sentence."""

    def at(self, port: int) -> str:
        """Host and port as a URI has them: an IPv6 address in brackets."""
        return f"[{self.advertise}]:{port}" if ":" in self.advertise else f"{self.advertise}:{port}"


def master_uri_from_env() -> str:
    """Return ROS_MASTER_URI, or the usual address on this machine."""
    return os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER_URI


def server_address(host: str | None = None) -> ServerAddress:
    """Decide where to listen: on loopback, IPv6's if that is asked for, unless `host` says otherwise.

    ROS_HOSTNAME and ROS_IP name the address to give out. They are followed where that address leads to the one
    listened at; a URI that leads nowhere would make the node unreachable.
    """
    wanted = os.environ.get("ROS_HOSTNAME") or os.environ.get("ROS_IP")
    bind = host or LOOPBACK
    if host is None and wanted and not _leads_to(wanted, LOOPBACK) and _leads_to(wanted, _LOOPBACK_6):
        bind = _LOOPBACK_6
    open_to_all = bind in ("0.0.0.0", "::", "")
    if wanted and (open_to_all or _leads_to(wanted, bind)):
        return ServerAddress(bind=bind, advertise=wanted)
    warning = None
    if wanted:
        warning = (
            f"ROS_HOSTNAME or ROS_IP is {wanted!r} but the server listens on {bind}, so {bind} is given out; "
            f"ask for that address (or 0.0.0.0) to be reachable from other machines"
        )
    return ServerAddress(bind=bind, advertise=socket.gethostname() if open_to_all else bind, warning=warning)


def _leads_to(name: str, address: str) -> bool:
    try:
        found = {str(info[4][0]) for info in socket.getaddrinfo(name, None, type=socket.SOCK_STREAM)}
        listening = {str(info[4][0]) for info in socket.getaddrinfo(address, None, type=socket.SOCK_STREAM)}
    except OSError:
        return False
    return bool(found & listening)
