"""Open the page of a running gzserver, as gzclient opens its window."""

import argparse
import sys

from trundle.base.diagnostics import UsageError

from ..graph_command import running_node
from .waiting import wait_for_master

EXAMPLES = """
  gzclient                      beside a gzserver
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-g", "--gui-client-plugin", action="append", help=argparse.SUPPRESS)
    parser.add_argument("--verbose", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("remappings", nargs="*", help=argparse.SUPPRESS)


def main(_: argparse.Namespace) -> int:
    """Open the page, and wait until Ctrl-C or the end of the server, which keeps the page."""
    from trundle.live.gazebo.standalone import OPEN_WINDOW, open_window
    from trundle.ros import ServiceError

    wait_for_master("gzclient")
    with running_node("gzclient") as (loop, node):
        print("gzclient: looking for a gzserver", file=sys.stderr)
        loop.run(node.wait_for_service(OPEN_WINDOW), None)
        try:
            url = open_window(loop, node)
        except ServiceError as error:
            raise UsageError(f"gzserver does not open its page: {error}") from None
        if url is None:
            raise UsageError("gzserver cannot serve its page; it says why")
        print(f"see it at {url}", flush=True)
        loop.run(node.closed.wait(), None)
    return 0
