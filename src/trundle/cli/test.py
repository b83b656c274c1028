"""Run the tests of launch files, as rostest does."""

import argparse
from pathlib import Path

from .main import quiet_imports

EXAMPLES = """
  trundle test my_robot drive.test                    a package and a file in it
  trundle test drive.test --junit results.xml         for a CI server
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("words", nargs="+", metavar="[PKG] FILE [ARG:=VALUE]", help="which tests, and their arguments")
    where = "where to write the results as JUnit XML (rostest's place: ROS_TEST_RESULTS_DIR or ~/.ros/test_results)"
    parser.add_argument("--junit", type=Path, metavar="FILE", help=where)
    parser.add_argument("-t", "--text", action="store_true", help="show the output of every node")
    parser.add_argument("--strict", action="store_true", help="a warning about the file is an error")


def main(args: argparse.Namespace) -> int:
    """Run each test in a launch of its own; 0 when all passed, 1 when one did not run, 2 when a case failed."""
    with quiet_imports():
        from trundle.bringup.launch_options import LaunchOptions
        from trundle.bringup.launch_tests import run_tests

    options = LaunchOptions(headless=True, output="screen" if args.text else None, strict=args.strict)
    return run_tests(args.words, options, junit=args.junit)
