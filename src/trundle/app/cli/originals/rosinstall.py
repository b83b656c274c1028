"""Fetch the repositories of a .rosinstall file into a workspace, as rosinstall does."""

import argparse
from pathlib import Path

from trundle.base.files import read_text

from ..repository_list import fetch_list

EXAMPLES = """
  rosinstall src my_robot.rosinstall
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("folder", type=Path, help="folder of the repositories")
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help=".rosinstall files")
    parser.add_argument("-n", "--nobuild", action="store_true", help=argparse.SUPPRESS)


def main(args: argparse.Namespace) -> int:
    """Fetch them into the folder."""
    return max((fetch_list(read_text(file), str(file), args.folder) for file in args.files), default=0)
