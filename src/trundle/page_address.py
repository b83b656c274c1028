"""Where a page is served, and under which names: what a command is told; the rules are those of `access`."""

import ipaddress
import re
from dataclasses import dataclass

from .diagnostics import UsageError

_ORIGIN = re.compile(r"https?://[^][:/@;,'\s]+(?::\d{1,5})?/?")
AUTHORITY = re.compile(r"(\[[0-9a-f:.%]+\]|[^][:/@\s]+)(?::\d{1,5})?")
"""The host, and perhaps the port, of a URL in lower case; the host is its first group."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AllowedNames:
    """Hosts and origins served beside the usual ones: `--allow-host`, `--allow-origin`."""

    hosts: tuple[str, ...] = ()
    """Names that the page is opened at: `robot.example`."""
    origins: tuple[str, ...] = ()
    """Origins of other web pages: `https://robot.example:8443`."""

    def __post_init__(self) -> None:
        """Check them.

        Raises:
            UsageError: one is no name, or no origin.
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
    """Where a page is to be served, and to whom."""

    host: str = "127.0.0.1"
    port: int | None = None
    """None: 8080 or the next free one."""
    allowed: AllowedNames = NONE_ALLOWED


def is_loopback(host: str) -> bool:
    """Tell whether a server bound there is reached from this machine only."""
    if is_address(host):
        return ipaddress.ip_address(host).is_loopback
    return host.lower() == "localhost"


def is_address(name: str) -> bool:
    """Tell an address from the name of a host."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
