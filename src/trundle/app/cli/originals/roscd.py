"""Print the folder of a package, for the shell function roscd."""

import argparse
import os

from .package_folder import USAGE_SUFFIX, find_location, workspace_folder

EXAMPLES = """
  roscd my_robot                the package's folder
  roscd my_robot/launch         a folder in it
  roscd log                     the folder of all logs
  roscd                         the workspace
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("package", nargs="?", metavar=USAGE_SUFFIX, help="package, and a folder in it")


def main(args: argparse.Namespace) -> int:
    """Print the folder."""
    print(find_location(args.package, os.environ) if args.package else workspace_folder(os.environ))
    return 0
