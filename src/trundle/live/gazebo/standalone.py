"""`gazebo` and `gzserver`: one world with /gazebo's services, on the running graph or a new one."""

import asyncio
import os
import sys
import time
from collections.abc import Callable, Coroutine, Mapping, Sequence
from pathlib import Path

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics
from trundle.base.http.access import without_query
from trundle.gazebo.nodes import BuiltinReplacement, NodeHost, run_builtin_node
from trundle.page import GraphAddress, read_link_files
from trundle.page.shared_page import SharedPage
from trundle.ros import GraphLoop, Message, Node

from ..graph import Graph
from .world import GazeboWorld

OPEN_WINDOW = "/gazebo/open_window"
"""std_srvs/Trigger service that opens the page and returns its URL, for a gzclient started later.

Every user of the machine may call it, so the URL has no token.
"""
_LOOPBACK = "127.0.0.1"
_POLL_S = 0.5


def run_gazebo(arguments: Sequence[str], environment: Mapping[str, str], *, logs: Path, window: bool) -> int:
    """Simulate until interrupted; return the exit code.

    Args:
        arguments: gzserver's command line arguments.
        environment: ROS_MASTER_URI names the master to join; without it the default one, started if none answers.
        logs: folder for logs and spawned models.
        window: True: open the page at once; False: on request of a gzclient.
    """
    report = Diagnostics()
    console = Console(sys.stderr, report)
    with Graph.open(environment, host=_LOOPBACK) as graph:
        console.line(graph.summary)
        shared = SharedPage(say=console.line, graph=GraphAddress(master_uri=graph.master_uri, host=graph.host))
        reloads = _Reloads()
        world = GazeboWorld(
            graph=graph,
            start=Path.cwd(),
            env=environment,
            report=report,
            folder=logs / "spawned",
            say=console.line,
            page=shared,
            reload=lambda: graph.loop.call_soon(reloads.requested.set),
        )
        kind = BuiltinReplacement(f"trundle.gazebo.nodes.gazebo:{'Gazebo' if window else 'GazeboServer'}")
        printing = graph.loop.spawn(_print_findings(console))
        try:
            return graph.loop.run(reloads.run(lambda: _run_once(graph, world, kind, arguments), shared))
        finally:
            printing.cancel()
            world.close()
            shared.close()
            console.findings()


class _Reloads:
    """Restarts the run on request from the page; on the graph's loop."""

    def __init__(self) -> None:
        self.requested = asyncio.Event()
        """Set to end a run and begin the next."""

    async def run(self, run_once: Callable[[], Coroutine[object, object, int]], page: SharedPage) -> int:
        """Run until a run ends by itself; return its exit code."""
        while True:
            running = asyncio.create_task(run_once())
            waiting = asyncio.create_task(self.requested.wait())
            try:
                await asyncio.wait((running, waiting), return_when=asyncio.FIRST_COMPLETED)
                if running.done():
                    return running.result()
                if page.url is not None:
                    page.acquire(None)  # keeps the page open between two runs
            finally:
                waiting.cancel()
                running.cancel()
                await asyncio.wait((running,))
            self.requested.clear()


async def _run_once(graph: Graph, world: GazeboWorld, kind: BuiltinReplacement, arguments: Sequence[str]) -> int:
    node = Node("gazebo", loop=graph.loop, master_uri=graph.master_uri, host=_LOOPBACK)
    node.advertise_service(OPEN_WINDOW, "std_srvs/Trigger", lambda _: _open_window(world, node))
    return await run_builtin_node(kind, node, list(arguments), NodeHost(simulator=world))


def open_window(loop: GraphLoop, node: Node) -> str | None:
    """Ask a running gazebo for its page, once its world is open; return the link, or None if it cannot be served.

    The link has the token where the page is this user's.
    """
    while True:
        response: Message = loop.run(node.call_service(OPEN_WINDOW, "std_srvs/Trigger", {}, timeout_s=None), None)
        if response.success:
            url = str(response.message)
            links = (page.url for page in read_link_files(os.environ))
            return next((link for link in links if link.startswith(f"{url}/")), url) or None
        time.sleep(_POLL_S)


def _open_window(world: GazeboWorld, node: Node) -> dict[str, object]:
    """Answer with the URL, which is empty if the page cannot be served; `success` is False until the world is open."""
    if not world.is_ready:
        return {"success": False}
    return {"success": True, "message": without_query(world.open_window(node) or "")}


async def _print_findings(console: Console) -> None:
    while True:
        console.findings()
        await asyncio.sleep(_POLL_S)
