"""Page that a launch's nodes open, and its URL."""

import time
from collections.abc import Callable, Sequence
from typing import Protocol

from trundle.gazebo.nodes import CLIENTS, WINDOWS
from trundle.robots.launch import LaunchPlan

from .nodes import LaunchedNode

_TIMEOUT_S = 20.0
"""Time to wait for the page [s]; if reading the world takes longer, its URL is printed later, on a separate line."""
_POLL_S = 0.05
_VIDEO_SERVER = ("web_video_server", "web_video_server")
_VIDEO_PORT = 8080


class OpeningPage(Protocol):
    """A page that is being opened, or failed to open."""

    @property
    def url(self) -> str | None: ...
    @property
    def is_over(self) -> bool: ...


def opens_page(launched: Sequence[LaunchedNode]) -> bool:
    """Return True if a started node opens the page: rviz, a program of rqt, gzclient, or one with a terminal."""
    started = {(entry.node.package, entry.node.type) for entry in launched if entry.kind == "stand-in"}
    return not (CLIENTS | WINDOWS).isdisjoint(started) or any(entry.terminal is not None for entry in launched)


def await_url(page: OpeningPage, is_ending: Callable[[], bool]) -> str | None:
    """Wait until the page is served or has failed; return its URL."""
    deadline = time.monotonic() + _TIMEOUT_S
    while not is_ending() and time.monotonic() < deadline:
        if page.url is not None or page.is_over:
            break
        time.sleep(_POLL_S)
    return page.url


def reserved_ports(plan: LaunchPlan) -> tuple[int, ...]:
    """Ports of web_video_servers in a launch, which other programs expect; their default is also the page's."""
    ports: list[int] = []
    for node in plan.nodes:
        if (node.package, node.type) == _VIDEO_SERVER:
            name = f"{node.namespace.rstrip('/')}/{node.name}/port"
            port = next((param.value for param in plan.params if param.name == name), _VIDEO_PORT)
            ports += [port] if isinstance(port, int) else []
    return tuple(ports)
