"""Create the CMakeLists.txt of a workspace's source folder, as catkin_init_workspace does."""

import argparse
import os
from pathlib import Path

EXAMPLES = """
  catkin_init_workspace         in the folder src of a workspace
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("workspace", nargs="?", type=Path, default=Path(), help="folder of the sources (this one)")


def main(args: argparse.Namespace) -> int:
    """Create the file; nothing is overwritten."""
    from trundle.ros.catkin import init_workspace

    print(init_workspace(Path(os.path.abspath(args.workspace)), os.environ))
    return 0
