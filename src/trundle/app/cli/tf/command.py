"""Print, draw and measure transforms, as tf's tools do."""

import argparse
from collections.abc import Callable
from importlib import import_module

from ..graph_command import ros_errors

EXAMPLES = """
  trundle tf echo odom base_link
  trundle tf tree
  trundle tf tree -o frames.svg
  trundle tf monitor
  trundle tf static 0 0 0.1 0 0 0 base_link laser
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    add = commands.add_parser("echo", help="print the transform between two frames, periodically")
    add.add_argument("source", help="parent frame")
    add.add_argument("target", help="child frame")
    add.add_argument("rate", nargs="?", type=float, help="rate [Hz] (1); also _rate:=5, _precision:=6")
    add.add_argument("-n", dest="count", type=int, metavar="COUNT", help="stop after COUNT transforms")
    add.set_defaults(run=_import_on_use("echo"))
    add = commands.add_parser("tree", help="all frames as a tree, as view_frames does")
    add.add_argument("-t", "--time", type=float, default=5.0, metavar="SEC", help="listening time (5)")
    add.add_argument("-o", "--output", metavar="FILE", help="an image (.svg) or Graphviz text (.gv, .dot)")
    add.set_defaults(run=_import_on_use("tree"))
    add = commands.add_parser("monitor", help="delays and rates of frames and broadcasters, every second")
    add.add_argument("frames", nargs="*", metavar="FRAME", help="two frames: only their chain, and its delay")
    add.add_argument("-n", dest="count", type=int, metavar="COUNT", help="stop after COUNT tables")
    add.set_defaults(run=_import_on_use("monitor"), refuse=add.error)
    add = commands.add_parser("static", help="publish a static transform, as tf2_ros does")
    add.add_argument(
        "numbers", nargs="+", metavar="X Y Z (YAW PITCH ROLL | QX QY QZ QW) FRAME CHILD", help="[m], [rad]"
    )
    add.set_defaults(run=_import_on_use("static"))


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _import_on_use(module: str) -> Callable[[argparse.Namespace], int]:
    """Return a command function that imports its module when called."""

    def run(args: argparse.Namespace) -> int:
        return import_module(f".{module}", __package__).main(args)

    return run
