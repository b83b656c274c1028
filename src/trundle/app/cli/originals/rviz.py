"""Show the graph in the browser, with rviz' name and options; wait for a master, as rviz does."""

import argparse

from trundle.robots.names import parse_arguments

from .waiting import wait_for_master

EXAMPLES = """
  rviz
  rviz -d robot.rviz            with the displays of a file
  rviz -f odom                  with this fixed frame
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-d", "--display-config", metavar="FILE", help="an .rviz file")
    parser.add_argument("-f", "--fixed-frame", metavar="FRAME", help="fixed frame")
    parser.add_argument("file", nargs="?", help="an .rviz file, as with -d")
    # rviz' options for its window and its log have no effect here.
    for option in (("-s", "--splash-screen"), ("-t", "--help-file"), ("--opengl",)):
        parser.add_argument(*option, metavar="X", help=argparse.SUPPRESS)
    flags = ("-l", "--ogre-log"), ("-n", "--no-stereo"), ("-v", "--verbose"), ("--disable-anti-aliasing",)
    for option in (*flags, ("--fullscreen",), ("--in-mc-wrapper",)):
        parser.add_argument(*option, action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("remappings", nargs="*", help=argparse.SUPPRESS)


def main(args: argparse.Namespace) -> int:
    """Show until Ctrl-C."""
    files = parse_arguments([word for word in (args.file, *args.remappings) if word]).rest
    config = args.display_config or next(iter(files), None)
    wait_for_master("rviz")
    words = [*(["-d", config] if config else []), *(["-f", args.fixed_frame] if args.fixed_frame else [])]
    return args.run_command(("view",), words)
