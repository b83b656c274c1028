"""Show a recorded run or a bag in the browser."""

import argparse
from pathlib import Path

from .options import add_allow_outside, add_compare, add_page_access, field_option, page_access, read_options
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle run world.sdf --record run.log              record states at 50 Hz
  trundle play run.log                                show it in a loop
  trundle play run.log --speed 0.2                    slowly
  trundle play run.log --compare other.log            with a second run as a ghost, and their differences
  trundle play drive.bag                              a bag, with its topics in the page's displays
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE", type=Path, help="state log of `trundle run --record`, .bag or .mcap")
    add = field_option(parser)
    add("--speed", type=_positive, metavar="X", help="real-time factor (1)")
    add("--pause", action="store_true", dest="paused", help="start paused")
    add_compare(parser)
    add("--port", type=int, metavar="N", help="the page's port (8080, or the next free one)")
    add("--host", help="address that the page binds (127.0.0.1)")
    add_page_access(parser)
    add_allow_outside(parser)


def main(args: argparse.Namespace) -> int:
    """Play until Ctrl-C."""
    with quiet_imports():
        from trundle.app.play import PlayOptions, play

    return play(args.file, read_options(PlayOptions, args, allowed=page_access(args)))


def _positive(text: str) -> float:
    value = float(text)
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return value
