"""Check a URDF and print its tree of links, as urdfdom's check_urdf does."""

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from trundle.robots.robot import Robot

EXAMPLES = """
  check_urdf robot.urdf
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="URDF_FILE", help="a URDF")


def main(args: argparse.Namespace) -> int:
    """Print the tree; 1 if the file is refused."""
    robot = read_urdf(args.file)
    print(f"robot name is: {robot.name}")
    print("---------- Successfully Parsed XML ---------------")
    children = _children(robot)
    root_children = children.get(robot.root, [])
    print(f"root Link: {robot.root} has {len(root_children)} child(ren)")
    _print_descendants(robot.root, children)
    return 0


def read_urdf(file: str) -> "Robot":
    """Read a URDF as written; print its findings on standard error.

    Raises:
        UsageError: the file is not a URDF.
    """
    from trundle.base.diagnostics import Diagnostics, UsageError
    from trundle.robots.description import load
    from trundle.robots.packages import Packages

    report = Diagnostics()
    loaded = load(file, report, packages=Packages(dict(os.environ), start=Path(file)))
    for finding in report.findings:
        print(finding, file=sys.stderr)
    if loaded.robot is None:
        raise UsageError(f"{file} is not a URDF; 'trundle check' also reads SDF")
    return loaded.robot


def _children(robot: "Robot") -> dict[str, list[str]]:
    """Return link → children, sorted by joint name, as in urdfdom."""
    children: dict[str, list[str]] = {}
    for joint in sorted(robot.joints, key=lambda joint: joint.name):
        children.setdefault(joint.parent, []).append(joint.child)
    return children


def _print_descendants(root: str, children: dict[str, list[str]]) -> None:
    """Print the links below the root, each with its number among its siblings."""
    stack = [(link, number, 1) for number, link in reversed(list(enumerate(children.get(root, []), 1)))]
    while stack:
        link, number, level = stack.pop()
        print(f"{'    ' * level}child({number}):  {link}")
        link_children = children.get(link, [])
        stack += [(child, i, level + 1) for i, child in reversed(list(enumerate(link_children, 1)))]
