"""Print the version of a package or of ROS."""

import argparse
import os
from pathlib import Path

from trundle.base.diagnostics import UsageError

EXAMPLES = """
  rosversion my_robot           the version in its package.xml
  rosversion -d                 the name of the ROS distribution
  rosversion --all              every package and its version
"""
_DEFAULT_DISTRO = "noetic"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    choice = parser.add_mutually_exclusive_group(required=True)
    choice.add_argument("-d", "--distro", action="store_true", help="name of the ROS distribution")
    choice.add_argument("-a", "--all", action="store_true", help="all packages with their versions")
    choice.add_argument("package", nargs="?", help="name of a package")
    parser.add_argument("-s", "--skip-newline", action="store_true", help="no newline at the end")


def main(args: argparse.Namespace) -> int:
    """Print the version."""
    from trundle.robots.packages import Packages

    end = "" if args.skip_newline else "\n"
    if args.distro:
        print(_distro(), end=end)
        return 0
    packages = Packages(os.environ, start=Path.cwd())
    if args.all:
        for name, folder in sorted(packages.ros_packages().items()):
            print(f"{name}: {_version(folder)}")
        return 0
    folder = packages.find_package(args.package)
    if folder is None:
        raise UsageError(f"Cannot locate [{args.package}]; {packages.not_found_message(args.package)}")
    print(_version(folder), end=end)
    return 0


def _distro() -> str:
    """Return the running master's distribution, or ROS_DISTRO's."""
    from trundle.ros import MasterProxy, RosError

    try:
        return str(MasterProxy(caller_id="/rosversion", timeout_s=0.5).call("getParam", "/rosdistro")).strip()
    except RosError:
        return os.environ.get("ROS_DISTRO") or _DEFAULT_DISTRO


def _version(folder: Path) -> str:
    """Return the version in a package.xml or stack.xml; `<unversioned>` if there is none, as in rosversion."""
    from trundle.base.diagnostics import DescriptionError
    from trundle.base.files import read_text
    from trundle.base.xmlnode import parse_xml

    manifest = folder / "package.xml"
    if not os.path.isfile(manifest):
        return "<unversioned>"
    try:
        element = parse_xml(read_text(manifest), name=str(manifest)).find("version")
    except (OSError, DescriptionError):
        return "<unversioned>"
    return "<unversioned>" if element is None else element.text.strip()
