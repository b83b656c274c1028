"""Fetch the repositories of a .repos or .rosinstall file, as vcstool does."""

import argparse
import sys
from pathlib import Path

from trundle.base.files import read_standard_input, read_text

from ..repository_list import fetch_list

EXAMPLES = """
  vcs import src < my_robot.repos
  vcs import src --input my_robot.rosinstall
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("command", choices=("import",), help="what to do")
    parser.add_argument("folder", nargs="?", type=Path, default=Path(), help="folder of the repositories (this one)")
    parser.add_argument("--input", type=Path, metavar="FILE", help="the file (standard input)")
    parser.add_argument("--skip-existing", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--shallow", action="store_true", help=argparse.SUPPRESS)


def main(args: argparse.Namespace) -> int:
    """Fetch them into the folder."""
    if args.input is None:
        if sys.stdin.isatty():
            print("reading the list from the terminal; Ctrl-D ends it", file=sys.stderr)
        return fetch_list(read_standard_input().decode(errors="replace"), "<stdin>", args.folder)
    return fetch_list(read_text(args.input), str(args.input), args.folder)
