"""Show a running ROS graph in the browser, as rviz does."""

import argparse

from .options import add_allow_outside, add_compare, add_page_access, field_option, page_access, read_options
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle view                                        the graph of ROS_MASTER_URI
  trundle view -f odom                                with fixed frame odom
  trundle view -d robot.rviz                          with the displays of an rviz config
  trundle view --compare drive.bag                    beside a recording, from now on
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add = field_option(parser)
    add("-d", "--display-config", dest="config", metavar="FILE", help="an .rviz file")
    add("-f", "--fixed-frame", metavar="FRAME", help="fixed frame")
    add_compare(parser)
    add("--port", type=int, metavar="N", help="the page's port (8080, or the next free one)")
    add("--host", help="address that the page binds (127.0.0.1)")
    add_page_access(parser)
    add_allow_outside(parser)


def main(args: argparse.Namespace) -> int:
    """Show until Ctrl-C."""
    with quiet_imports():
        from trundle.app.view import ViewOptions, view

    return view(read_options(ViewOptions, args, allowed=page_access(args)))
