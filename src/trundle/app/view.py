"""`trundle view`: shows any ROS graph in the browser."""

import asyncio
import os
import sys
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.http.page_address import AllowedNames, PageAddress
from trundle.base.signals import stop_flag
from trundle.page import GraphAddress
from trundle.page.bag.compared_bag import compared_bag
from trundle.page.graph_page import GraphPage
from trundle.page.network_warning import warn_of_network
from trundle.page.shared_page import SharedPage
from trundle.robots.names import anonymous_name
from trundle.ros import GraphLoop, MasterProxy, MasterUnreachableError, Node, follow_time, master_uri_from_env


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewOptions:
    """Options of `trundle view`."""

    config: str | None = None
    """An .rviz file."""
    fixed_frame: str | None = None
    compare: Path | None = None
    """Bag to compare the graph's topics with."""
    host: str = "127.0.0.1"
    port: int | None = None
    """Port of the page; None: 8080 or the next free one."""
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves besides its own."""
    view_only: bool = False
    """True: print a second link, which is view-only."""
    opens_browser: bool = True
    """True: open the page where there is a display; False: only print its URL."""


def view(options: ViewOptions, environment: Mapping[str, str] | None = None) -> int:
    """Show the graph of ROS_MASTER_URI until Ctrl-C; return the exit code.

    Raises:
        BagError: the bag to compare with is damaged.
        UsageError: no master answers there, or the file to compare with is no bag.
    """
    reference = None if options.compare is None else compared_bag(options.compare)
    if options.compare is not None and reference is None:
        raise UsageError(f"{options.compare} is no bag, and topics can only be compared with a bag")
    env = dict(os.environ if environment is None else environment)
    uri = env.get("ROS_MASTER_URI") or master_uri_from_env()
    try:
        MasterProxy(uri).call("getPid")
    except MasterUnreachableError:
        raise UsageError(
            f"no ROS master answers at {uri}; start one with 'trundle core' or 'trundle launch', or set ROS_MASTER_URI"
        ) from None
    report = Diagnostics()
    show = Console(sys.stderr, report)
    warn_of_network(options.host, show.line)
    with stop_flag() as stop, ExitStack() as resources:
        loop = resources.enter_context(GraphLoop())
        # Anonymous like rviz: a second node named rviz would shut down a launch's.
        node = Node(anonymous_name("rviz"), loop=loop, master_uri=uri, host=options.host)
        loop.run(follow_time(node))
        at = PageAddress(host=options.host, port=options.port, allowed=options.allowed, view_only=options.view_only)
        graph = GraphAddress(master_uri=uri, host=options.host)
        shared = SharedPage(say=show.line, at=at, graph=graph, opens_browser=options.opens_browser, reference=reference)
        page = GraphPage(shared)
        resources.callback(page.close)
        showing = loop.spawn(page.show(node, config=options.config, fixed_frame=options.fixed_frame))
        while not stop.wait(0.1):
            show.findings()
            if showing.done():
                return showing.result()
        showing.cancel()
        loop.run(asyncio.sleep(0))
    return 130
