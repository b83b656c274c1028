"""Show a running ROS graph in the browser, as rviz does."""

import argparse

from .options import add_allow_outside, add_page_access, page_access
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle view                                        the graph of ROS_MASTER_URI
  trundle view -f odom                                with fixed frame odom
  trundle view -d robot.rviz                          with the displays of an rviz config
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-d", "--display-config", metavar="FILE", help="an .rviz file")
    parser.add_argument("-f", "--fixed-frame", metavar="FRAME", help="fixed frame")
    parser.add_argument("--port", type=int, metavar="N", help="the page's port (8080, or the next free one)")
    parser.add_argument("--host", default="127.0.0.1", help="address that the page binds (127.0.0.1)")
    add_page_access(parser)
    add_allow_outside(parser)


def main(args: argparse.Namespace) -> int:
    """Show until Ctrl-C."""
    with quiet_imports():
        from trundle.app.view import ViewOptions, view

    options = ViewOptions(
        config=args.display_config,
        fixed_frame=args.fixed_frame,
        host=args.host,
        port=args.port,
        allowed=page_access(args),
        view_only=args.view_only,
        opens_browser=not args.no_browser,
    )
    return view(options)
