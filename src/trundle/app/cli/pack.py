"""Find packages and their dependencies, as rospack does."""

import argparse
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.robots.packages import Packages, run_dependencies

from .fetching import add_fetch_options, fetch_packages

EXAMPLES = """
  trundle pack find smartcar_description
  trundle pack list
  trundle pack list-names
  trundle pack depends smartcar_description
  trundle pack depends1 smartcar_description
  trundle pack depends-on geometry_msgs
  trundle pack depends-on1 geometry_msgs
  trundle pack get turtlebot3_gazebo                 fetch a package, and those that it needs
  trundle pack get --missing my_robot bringup.launch fetch all that a launch file needs
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _configure_query(commands.add_parser("find", help="folder of a package"), _find)
    commands.add_parser("list", help="names and folders of all packages").set_defaults(run=_list)
    commands.add_parser("list-names", help="names of all packages").set_defaults(run=_list_names)
    for name, alias, run, help_ in (
        ("depends", ["deps"], _depends, "packages that a package needs to run, recursively"),
        ("depends1", ["deps1"], _depends1, "packages that a package names itself"),
        ("depends-on", [], _depends_on, "packages that depend on a package, recursively"),
        ("depends-on1", [], _depends_on1, "packages that depend on a package directly"),
    ):
        _configure_query(commands.add_parser(name, aliases=alias, help=help_), run)
    get = commands.add_parser("get", help="fetch packages, and those that they need")
    get.add_argument("names", nargs="*", metavar="NAME", help="packages; with --missing: [PKG] FILE [ARG:=VALUE]")
    get.add_argument("--missing", action="store_true", help="fetch what a launch file needs and is not here")
    add_fetch_options(get)
    get.set_defaults(run=_get)


def _configure_query(parser: argparse.ArgumentParser, run: Callable[[argparse.Namespace, Packages], int]) -> None:
    parser.add_argument("package", nargs="?", help="package of the working directory by default")
    parser.add_argument("-q", dest="quiet", action="store_true", help="suppress error messages")
    parser.set_defaults(run=run)


def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    packages = Packages(os.environ, start=Path.cwd())
    try:
        if getattr(args, "package", "") is None:
            args.package = _current_package(packages)
        return int(args.run(args, packages))
    except TrundleError:
        if getattr(args, "quiet", False):
            return 1
        raise


def _current_package(packages: Packages) -> str:
    for name, folder in packages.ros_packages().items():
        if folder.resolve() == Path.cwd():
            return name
    raise UsageError("give a package; the working directory is not one")


def _find(args: argparse.Namespace, packages: Packages) -> int:
    folder = packages.find_package(args.package)
    if folder is None:
        raise UsageError(packages.not_found_message(args.package))
    print(folder)
    return 0


def _get(args: argparse.Namespace, _: Packages) -> int:
    if not args.names:
        raise UsageError("give packages, or --missing and a launch file")
    if not args.missing:
        return fetch_packages(args.names, args, for_files=True)
    from trundle.live.launch.missing_packages import missing_packages

    fetched: set[str] = set()
    while names := [name for name in missing_packages(args.names, os.environ) if name not in fetched]:
        if code := fetch_packages(names, args, for_files=True):
            return code
        fetched.update(names)
        args.yes = True  # the first fetch includes the dependencies of the fetched packages
    print("nothing is missing" if not fetched else "all available packages are fetched")
    return 0


def _list(_: argparse.Namespace, packages: Packages) -> int:
    for name, folder in sorted(packages.ros_packages().items()):
        print(f"{name} {folder}")
    return 0


def _list_names(_: argparse.Namespace, packages: Packages) -> int:
    _print(sorted(packages.ros_packages()))
    return 0


def _depends(args: argparse.Namespace, packages: Packages) -> int:
    _check_exists(args, packages)
    _print(_dependencies(args.package, packages.ros_packages()))
    return 0


def _depends1(args: argparse.Namespace, packages: Packages) -> int:
    _check_exists(args, packages)
    _print(_direct_dependencies(args.package, packages.ros_packages()))
    return 0


def _depends_on(args: argparse.Namespace, packages: Packages) -> int:
    _check_exists(args, packages)
    known = packages.ros_packages()
    _print(sorted(name for name in known if args.package in _dependencies(name, known)))
    return 0


def _depends_on1(args: argparse.Namespace, packages: Packages) -> int:
    _check_exists(args, packages)
    known = packages.ros_packages()
    _print(sorted(name for name in known if args.package in _direct_dependencies(name, known)))
    return 0


def _check_exists(args: argparse.Namespace, packages: Packages) -> None:
    if args.package not in packages.ros_packages():
        raise UsageError(packages.not_found_message(args.package))


def _direct_dependencies(name: str, known: Mapping[str, Path]) -> list[str]:
    """Return the direct dependencies that are ROS packages; others are system packages."""
    try:
        return [dependency for dependency in run_dependencies(known[name]) if dependency in known]
    except TrundleError as error:
        print(f"WARNING: {error}", file=sys.stderr)
        return []


def _dependencies(name: str, known: Mapping[str, Path]) -> list[str]:
    """Return all dependencies, deepest first."""
    result: dict[str, None] = {}
    stack = [(name, iter(_direct_dependencies(name, known)))]
    entered = {name}
    while stack:
        current, dependencies = stack[-1]
        for dependency in dependencies:
            if dependency not in entered:
                entered.add(dependency)
                stack.append((dependency, iter(_direct_dependencies(dependency, known))))
                break
        else:
            stack.pop()
            result[current] = None
    del result[name]
    return list(result)


def _print(names: Iterable[str]) -> None:
    for name in names:
        print(name)
