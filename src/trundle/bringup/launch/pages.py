"""Pages that a launch's nodes open, and their URLs."""

import time
from collections.abc import Callable, Sequence
from typing import Protocol

from trundle.nodes import CLIENTS, WINDOWS

from .nodes import Launched

_TIMEOUT_S = 20.0
"""A world may take longer to read; its page's URL is then printed on a line of its own."""
_POLL_S = 0.05


class OpeningPage(Protocol):
    """A page that is being opened, or never will be."""

    @property
    def url(self) -> str | None: ...
    @property
    def is_over(self) -> bool: ...


def opening_pages(
    launched: Sequence[Launched], graph: OpeningPage | None, world: OpeningPage | None
) -> Sequence[OpeningPage]:
    """Select the pages that the started nodes open.

    Args:
        launched: the nodes.
        graph: page of the ROS graph, which rviz and the like open; None: headless.
        world: page of the simulated world, which gzclient or gazebo opens.
    """
    started = {(entry.node.package, entry.node.type) for entry in launched if entry.kind == "stand-in"}
    expected = ((world, not CLIENTS.isdisjoint(started)), (graph, not WINDOWS.isdisjoint(started)))
    return [page for page, opens in expected if page is not None and opens]


def await_urls(pages: Sequence[OpeningPage], is_ending: Callable[[], bool]) -> list[str]:
    """Wait until each page is served or will not be; return the URLs."""
    deadline = time.monotonic() + _TIMEOUT_S
    while not is_ending() and time.monotonic() < deadline:
        if all(page.url is not None or page.is_over for page in pages):
            break
        time.sleep(_POLL_S)
    return [page.url for page in pages if page.url is not None]
