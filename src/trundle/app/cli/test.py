"""Run the tests of launch files, as rostest does, or every variation of a sweep's plan."""

import argparse
from pathlib import Path

from .graph_command import interrupted_by_signals
from .options import read_options
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle test my_robot drive.test                    a package and a file in it
  trundle test drive.test --junit results.xml         for a CI server
  trundle test stands.yaml --junit results.xml        all runs of a sweep's plan must be ok
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "words", nargs="+", metavar="[PKG] FILE [ARG:=VALUE]", help="test file and its arguments, or a plan"
    )
    help_ = "JUnit XML file of the results (as rostest: in ROS_TEST_RESULTS_DIR or ~/.ros/test_results)"
    parser.add_argument("--junit", type=Path, metavar="FILE", help=help_)
    text = "show the output of every node; write no result files"
    parser.add_argument("-t", "--text", action="store_true", help=text)
    parser.add_argument("--package", metavar="PKG", help="package of the results (that of FILE)")
    parser.add_argument(
        "--pkgdir",
        type=Path,
        dest="package_folder",
        metavar="DIR",
        help="package folder, for result names relative to it",
    )
    parser.add_argument(
        "--results-filename",
        type=_file_name,
        dest="results_name",
        metavar="NAME",
        help="name of the results file, in rostest's folder",
    )
    help_ = "folder with a subfolder of results per package, instead of ROS_TEST_RESULTS_DIR"
    parser.add_argument("--results-base-dir", type=Path, dest="results_folder", metavar="DIR", help=help_)
    reuse = "use the master at ROS_MASTER_URI instead of one per test"
    parser.add_argument("-r", "--reuse-master", action="store_true", help=reuse)
    parser.add_argument("-c", "--clear", action="store_true", help="with -r: delete its parameters before each test")
    parser.add_argument("--strict", action="store_true", help="treat warnings about the file as errors")


def main(args: argparse.Namespace) -> int:
    """Run each test in its own launch, or a plan; 0: all passed, 1: a test did not run, 2: a case failed."""
    if len(args.words) == 1 and Path(args.words[0]).suffix in (".yaml", ".yml"):
        with quiet_imports():
            from trundle.studies.sweep.plan_reader import load_plan
            from trundle.studies.sweep.regression import run_plan_test

        return run_plan_test(load_plan(Path(args.words[0])), junit=args.junit)
    with quiet_imports():
        from trundle.live.launch.options import LaunchOptions
        from trundle.live.launch.test_options import LaunchTestOptions
        from trundle.live.launch.tests import run_tests

    options = LaunchOptions(headless=True, output="screen" if args.text else None, strict=args.strict)
    with interrupted_by_signals():
        return run_tests(args.words, options, read_options(LaunchTestOptions, args))


def _file_name(text: str) -> str:
    if not text or Path(text).name != text:
        raise argparse.ArgumentTypeError(f"{text!r} is not a file name; --results-base-dir takes the folder")
    return text
