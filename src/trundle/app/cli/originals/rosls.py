"""List the files of a package's folder."""

import argparse
import os
import subprocess

from .package_folder import USAGE_SUFFIX, find_location

EXAMPLES = """
  rosls my_robot
  rosls my_robot/launch
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("package", nargs="?", metavar=USAGE_SUFFIX, help="package, and a folder in it (this folder)")


def main(args: argparse.Namespace) -> int:
    """Run `ls`, whose output depends on the terminal."""
    folder = find_location(args.package, os.environ) if args.package else "."
    return subprocess.run(["ls", "--", str(folder)], check=False).returncode
