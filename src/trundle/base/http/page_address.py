"""Address and allowed names of a page; the rules are in `access`."""

import contextlib
import ipaddress
import re
import socket
from dataclasses import dataclass

from ..diagnostics import UsageError

_ORIGIN = re.compile(r"https?://[^][:/@;,'\s]+(?::\d{1,5})?/?")
_ALL_ADDRESSES = ("", "0.0.0.0", "::")
_DOCUMENTATION_ADDRESS = ("192.0.2.1", 9)
"""Address that belongs to no machine (RFC 5737)."""
AUTHORITY = re.compile(r"(\[[0-9a-f:.%]+\]|[^][:/@\s]+)(?::\d{1,5})?")
"""Host and optional port of a URL in lower case; the host is the first group."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AllowedNames:
    """Hosts and origins served in addition: `--allow-host`, `--allow-origin`."""

    hosts: tuple[str, ...] = ()
    """Host names of the page: `robot.example`."""
    origins: tuple[str, ...] = ()
    """Origins of other web pages: `https://robot.example:8443`."""

    def __post_init__(self) -> None:
        """Validate the names.

        Raises:
            UsageError: one is not a host name, or not an origin.
        """
        for host in self.hosts:
            if not AUTHORITY.fullmatch(host.lower()):
                raise UsageError(f"not the name of a host: '{host}'; one reads like robot.example")
        for origin in self.origins:
            if not _ORIGIN.fullmatch(origin.lower()):
                raise UsageError(f"not the origin of a web page: '{origin}'; one reads like https://robot.example:8443")


NONE_ALLOWED = AllowedNames()


@dataclass(frozen=True, slots=True, kw_only=True)
class PageAddress:
    """Address to serve a page at, and allowed names."""

    host: str = "127.0.0.1"
    port: int | None = None
    """None: 8080 or the next free one."""
    reserved_ports: tuple[int, ...] = ()
    """Ports that the page does not choose by itself."""
    allowed: AllowedNames = NONE_ALLOWED
    view_only: bool = False
    """True: print the view-only link too."""


def is_loopback(host: str) -> bool:
    """True if a server bound to the host is reachable from this machine only."""
    if is_address(host):
        return ipaddress.ip_address(host).is_loopback
    return host.lower() == "localhost"


def network_addresses(host: str) -> tuple[str, ...]:
    """Return the addresses at which other machines reach a server bound to a host; empty: none does.

    For a server bound to all addresses, the first one is that of the default route.
    """
    if host not in _ALL_ADDRESSES:
        return () if is_loopback(host) else (host,)
    addresses: list[str] = []
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.connect(_DOCUMENTATION_ADDRESS)  # sends nothing, but selects this machine's address
        addresses.append(str(probe.getsockname()[0]))
    with contextlib.suppress(OSError):
        entries = socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET, socket.SOCK_STREAM)
        addresses += [str(address[0]) for *_, address in entries]
    return tuple(address for address in dict.fromkeys(addresses) if not is_loopback(address))


def is_address(name: str) -> bool:
    """True for an IP address, False for a host name."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
