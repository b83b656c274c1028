"""Write a package, robot, world, plugin, node, launch file or message that runs at once, with a test."""

import argparse
import os
from pathlib import Path

from trundle.base.diagnostics import UsageError

EXAMPLES = """
  trundle new package my_robot                        a ROS package with a node, its launch file and its test
  trundle new robot rover                             a robot with two driven wheels; also --kind car|arm|quadruped
  trundle new world yard
  trundle new plugin hover                            a model, and its plugin in Python
  trundle new node patrol                             in a package, as the next two
  trundle new launch bringup
  trundle new message WheelSpeed
"""
_ROBOTS = ("differential", "car", "arm", "quadruped")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    kinds = ("package", "robot", "world", "plugin", "node", "launch", "message")
    parser.add_argument("what", choices=kinds, metavar="KIND", help=" | ".join(kinds))
    parser.add_argument("name", help="letters, digits and _; a message's is like WheelSpeed")
    parser.add_argument("--kind", choices=_ROBOTS, help="kind of robot (differential)")
    where = "folder to write to (this one, which is a package for a node or message)"
    parser.add_argument("-C", "--directory", type=Path, default=Path(), metavar="DIR", help=where)


def main(args: argparse.Namespace) -> int:
    """Write the files, and print them with the commands that run them; nothing is overwritten."""
    from trundle.app.scaffold import next_steps, scaffolds, write_scaffold

    if args.kind is not None and args.what != "robot":
        raise UsageError(f"--kind is a robot's; a {args.what} has none")
    scaffold = scaffolds(args.kind or _ROBOTS[0])[args.what]
    folder = args.directory
    if args.what == "package":
        package, folder = args.name, folder / args.name
        _refuse_used(folder)
    else:
        package = _package_of(folder)
    if scaffold.needs_package and package is None:
        raise UsageError(
            f"a {args.what} belongs into a package, and {folder.absolute()} has no package.xml; "
            "'trundle new package NAME' makes one"
        )
    written = write_scaffold(scaffold, args.name, folder, package=package or "")
    if args.what == "package":
        written = [*_write_package(args.directory, args.name), *written]
    for path in written:
        print(f"Created file {path}")
    print("\n".join(f"  {step}" for step in next_steps(scaffold, args.name, package or "")))
    return 0


def _refuse_used(folder: Path) -> None:
    if os.path.lexists(folder):
        raise UsageError(f"{folder} exists already; nothing is written")


def _write_package(parent: Path, name: str) -> list[Path]:
    from trundle.ros.catkin import NewPackage, create_package

    needs = ("geometry_msgs", "rospy", "rosunit")
    for _ in create_package(parent, NewPackage(name=name, dependencies=needs)):
        pass  # its lines are those of catkin_create_pkg
    return [parent / name / "package.xml", parent / name / "CMakeLists.txt"]


def _package_of(folder: Path) -> str | None:
    """Return the name in a folder's package.xml, if there is one."""
    from trundle.robots.packages import Packages

    if not os.path.isfile(folder / "package.xml"):
        return None
    known = Packages(os.environ, start=folder / "package.xml").ros_packages()
    return next((name for name, each in known.items() if each.resolve() == folder.resolve()), None)
