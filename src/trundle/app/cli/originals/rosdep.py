"""Fetch the packages that a workspace's packages need, as rosdep installs them."""

import argparse
import os
import sys
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.robots.packages import Packages, build_dependencies, run_dependencies

from ..fetching import add_fetch_options, fetch_folder, fetch_packages, make_fetcher, print_plan

EXAMPLES = """
  rosdep install --from-paths src --ignore-src -r -y      what the packages of a workspace need
  rosdep install turtlebot3_gazebo                        what one package needs
  rosdep check --from-paths src --ignore-src              the same, printed only
  rosdep keys --from-paths src                            names that they depend on
  rosdep update                                           nothing to do: the index is part of Trundle
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("command", choices=("install", "check", "keys", "resolve", "update", "init"), help="what to do")
    parser.add_argument("names", nargs="*", metavar="NAME", help="packages; for resolve: keys")
    parser.add_argument("--from-paths", action="store_true", help="the names are folders of packages")
    parser.add_argument("-i", "--ignore-src", action="store_true", help="leave out packages on ROS_PACKAGE_PATH too")
    parser.add_argument("--skip-keys", action="append", default=[], metavar="KEYS", help="leave out these names")
    parser.add_argument("-s", "--simulate", action="store_true", help="print what would be fetched")
    for option in ("-r", "-q", "-a"):  # an error never stops other packages here
        parser.add_argument(option, action="store_true", help=argparse.SUPPRESS)
    for option in ("--os", "--dependency-types", "-t"):
        parser.add_argument(option, dest="unused", metavar="X", help=argparse.SUPPRESS)
    add_fetch_options(parser)


def main(args: argparse.Namespace) -> int:
    """Fetch what is missing."""
    if args.command in ("update", "init"):
        print("nothing to do: the index of packages is part of Trundle; --index URL|FILE of install reads another")
        return 0
    if args.command == "resolve":
        print_plan(make_fetcher(args).plan(args.names), fetch_folder(args))
        return 0
    names = _dependencies(args)
    if args.command == "keys":
        print("\n".join(names))
        return 0
    if args.command == "check" or args.simulate:
        print_plan(make_fetcher(args).plan(names), fetch_folder(args))
        return 0
    return fetch_packages(names, args)


def _dependencies(args: argparse.Namespace) -> list[str]:
    """Return the names that packages depend on, without the packages themselves."""
    if not args.names:
        raise UsageError("rosdep needs packages, or --from-paths and folders")
    folders = _packages_below(args.names) if args.from_paths else _find_packages(args.names)
    excluded = {*folders, *(name for words in args.skip_keys for name in words.split())}
    names = [name for folder in folders.values() for name in (*build_dependencies(folder), *run_dependencies(folder))]
    return [name for name in dict.fromkeys(names) if name not in excluded]


def _packages_below(paths: list[str]) -> dict[str, Path]:
    """Return the packages below folders."""
    result: dict[str, Path] = {}
    for path in map(Path, paths):
        if not path.is_dir():
            raise UsageError(f"no folder {path}")
        root = path.absolute()
        packages = Packages({**os.environ, "ROS_PACKAGE_PATH": str(root)}, start=root).ros_packages()
        result |= {name: folder for name, folder in packages.items() if folder.is_relative_to(root)}
    if not result:
        print(f"no packages below {' '.join(paths)}", file=sys.stderr)
    return result


def _find_packages(names: list[str]) -> dict[str, Path]:
    packages = Packages(os.environ, start=Path.cwd())
    result = {name: packages.find_package(name) for name in names}
    for name, folder in result.items():
        if folder is None:
            raise UsageError(packages.not_found_message(name))
    return {name: folder for name, folder in result.items() if folder is not None}
