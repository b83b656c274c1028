"""Run the tests of launch files, as rostest does."""

import argparse
from pathlib import Path

from .graph_command import interrupted_by_signals
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle test my_robot drive.test                    a package and a file in it
  trundle test drive.test --junit results.xml         for a CI server
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("words", nargs="+", metavar="[PKG] FILE [ARG:=VALUE]", help="which tests, and their arguments")
    where = "where to write the results as JUnit XML (rostest's place: ROS_TEST_RESULTS_DIR or ~/.ros/test_results)"
    parser.add_argument("--junit", type=Path, metavar="FILE", help=where)
    text = "show the output of every node; leave no files of results"
    parser.add_argument("-t", "--text", action="store_true", help=text)
    parser.add_argument("--package", metavar="PKG", help="whose results they are (the package that FILE lies in)")
    parser.add_argument("--pkgdir", type=Path, metavar="DIR", help="the package's folder, to name the results by FILE")
    parser.add_argument(
        "--results-filename", type=_file_name, metavar="NAME", help="of the results, in rostest's place"
    )
    where = "has a folder of results for each package, instead of ROS_TEST_RESULTS_DIR"
    parser.add_argument("--results-base-dir", type=Path, metavar="DIR", help=where)
    reuse = "test on the graph of ROS_MASTER_URI, not on one of each test's own"
    parser.add_argument("-r", "--reuse-master", action="store_true", help=reuse)
    parser.add_argument("-c", "--clear", action="store_true", help="with -r: delete its parameters before each test")
    parser.add_argument("--strict", action="store_true", help="a warning about the file is an error")


def main(args: argparse.Namespace) -> int:
    """Run each test in a launch of its own; 0 when all passed, 1 when one did not run, 2 when a case failed."""
    with quiet_imports():
        from trundle.bringup.launch.options import LaunchOptions
        from trundle.bringup.launch.test_options import LaunchTestOptions
        from trundle.bringup.launch.tests import run_tests

    options = LaunchOptions(headless=True, output="screen" if args.text else None, strict=args.strict)
    how = LaunchTestOptions(
        junit=args.junit,
        text=args.text,
        package=args.package,
        package_folder=args.pkgdir,
        results_name=args.results_filename,
        results_folder=args.results_base_dir,
        reuse_master=args.reuse_master,
        clear=args.clear,
    )
    with interrupted_by_signals():
        return run_tests(args.words, options, how)


def _file_name(text: str) -> str:
    if not text or Path(text).name != text:
        raise argparse.ArgumentTypeError(f"{text!r} is no file name; --results-base-dir takes the folder")
    return text
