"""Write a package, robot, world, plugin, node, launch file or message that runs at once; or a package for MoveIt."""

import argparse
import os
from pathlib import Path

from trundle.base.diagnostics import UsageError

EXAMPLES = """
  trundle new package my_robot                        a ROS package with a node, its launch file and its test; --cpp
  trundle new robot rover                             a robot with two driven wheels; also --kind car|arm|quadruped
  trundle new world yard
  trundle new plugin hover                            a model, and its plugin in Python; --cpp: in C++, for Gazebo
  trundle new node patrol                             in a package, as the next two; --cpp: in C++
  trundle new launch bringup
  trundle new message WheelSpeed
  trundle new moveit_config arm_moveit_config --urdf arm.urdf.xacro
"""
_ROBOTS = ("differential", "car", "arm", "quadruped")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    kinds = ("package", "robot", "world", "plugin", "node", "launch", "message", "moveit_config")
    parser.add_argument("what", choices=kinds, metavar="KIND", help=" | ".join(kinds))
    parser.add_argument("name", help="letters, digits and _; for a message in camel case, such as WheelSpeed")
    parser.add_argument("--kind", choices=_ROBOTS, help="kind of robot (differential)")
    parser.add_argument("--cpp", action="store_true", help="package or node in C++, or plugin, as for Gazebo")
    parser.add_argument("--urdf", metavar="FILE", help="URDF or xacro of a moveit_config, or package://NAME/FILE")
    directory = "folder to write to (this one, which is a package for a node or message)"
    parser.add_argument("-C", "--directory", type=Path, default=Path(), metavar="DIR", help=directory)


def main(args: argparse.Namespace) -> int:
    """Write the files, and print them with the commands that run them; nothing is overwritten."""
    from trundle.app.scaffold import append_target, next_steps, scaffolds, write_scaffold

    if args.kind is not None and args.what != "robot":
        raise UsageError(f"--kind is only for robots, not for a {args.what}")
    if (args.urdf is not None) != (args.what == "moveit_config"):
        raise UsageError("a moveit_config needs --urdf FILE; nothing else takes it")
    if args.cpp and args.what == "moveit_config":
        raise UsageError("--cpp is for packages, nodes and plugins, not for a moveit_config")
    if args.what == "moveit_config":
        return _write_moveit_config(args.urdf, args.name, args.directory)
    scaffold = scaffolds(args.kind or _ROBOTS[0], is_cpp=args.cpp).get(args.what)
    if scaffold is None:
        raise UsageError(f"--cpp is for packages, nodes and plugins, not for a {args.what}")
    folder = args.directory
    if args.what == "package":
        package, folder = args.name, folder / args.name
        _check_unused(folder)
    else:
        package = _package_of(folder)
    if scaffold.needs_package and package is None:
        raise UsageError(
            f"a {args.what} belongs in a package, and {folder.absolute()} has no package.xml; "
            "'trundle new package NAME' makes one"
        )
    paths = write_scaffold(scaffold, args.name, folder, package=package or "")
    if args.what == "package":
        paths = [*_write_package(args.directory, args.name, is_cpp=args.cpp), *paths]
    for path in paths:
        print(f"Created file {path}")
    changed = append_target(scaffold, args.name, folder, package=package or "")
    if changed is not None and changed not in paths:
        print(f"Changed file {changed}")
    print("\n".join(f"  {step}" for step in next_steps(scaffold, args.name, package or "")))
    return 0


def _write_moveit_config(urdf: str, name: str, parent: Path) -> int:
    import sys

    from trundle.app.scaffold.moveit_package import write_moveit_package
    from trundle.base.diagnostics import Diagnostics

    report = Diagnostics()
    try:
        paths = write_moveit_package(urdf, name, parent, dict(os.environ), report)
    finally:
        for warning in report.printed_warnings():
            print(warning, file=sys.stderr)
    for path in paths:
        print(f"Created file {path}")
    print(f"  trundle launch {parent / name / 'launch' / 'demo.launch'}")
    return 0


def _check_unused(folder: Path) -> None:
    if os.path.lexists(folder):
        raise UsageError(f"{folder} exists; nothing is written")


def _write_package(parent: Path, name: str, *, is_cpp: bool) -> list[Path]:
    from trundle.ros.catkin import NewPackage, create_package

    needs = ("geometry_msgs", *(["roscpp"] if is_cpp else []), "rospy", "rosunit")
    for _ in create_package(parent, NewPackage(name=name, dependencies=needs)):
        pass  # catkin_create_pkg prints these lines
    return [parent / name / "package.xml", parent / name / "CMakeLists.txt"]


def _package_of(folder: Path) -> str | None:
    """Return the name of the package in a folder; None if there is none."""
    from trundle.robots.packages import Packages

    if not os.path.isfile(folder / "package.xml"):
        return None
    known = Packages(os.environ, start=folder / "package.xml").ros_packages()
    return next((name for name, path in known.items() if path.resolve() == folder.resolve()), None)
