"""Create a package, as catkin_create_pkg does."""

import argparse
import sys
from pathlib import Path

EXAMPLES = """
  catkin_create_pkg my_robot rospy std_msgs
  catkin_create_pkg my_robot roscpp -D "My first robot" -l MIT
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("name", help="The name for the package")
    parser.add_argument("dependencies", nargs="*", help="Catkin package Dependencies")
    parser.add_argument("--meta", action="store_true", help="Creates meta-package files")
    parser.add_argument("-s", "--sys-deps", nargs="*", default=[], help="System Dependencies")
    parser.add_argument("-b", "--boost-comps", nargs="*", default=[], help="Boost Components")
    parser.add_argument("-V", "--pkg_version", default="0.0.0", help="Initial Package version")
    parser.add_argument("-D", "--description", default="", help="Description")
    parser.add_argument("-l", "--license", action="append", default=[], help="Name for License, (e.g. BSD, MIT, …)")
    parser.add_argument(
        "-a", "--author", action="append", default=[], help="A single author, may be used multiple times"
    )
    maintainer = "A single maintainer, may be used multiple times"
    parser.add_argument("-m", "--maintainer", action="append", default=[], help=maintainer)
    parser.add_argument("--rosdistro", help="The ROS distro (without effect: the files are the same)")
    parser.set_defaults(refuse=parser.error)


def main(args: argparse.Namespace) -> int:
    """Write the files; nothing is overwritten."""
    from trundle.base.diagnostics import UsageError
    from trundle.ros.catkin import NewPackage, create_package, package_warnings

    package = NewPackage(
        name=args.name,
        dependencies=tuple(args.dependencies),
        system_dependencies=tuple(args.sys_deps),
        boost_components=tuple(args.boost_comps),
        version=args.pkg_version,
        description=args.description,
        licences=tuple(args.license),
        authors=tuple(args.author),
        maintainers=tuple(args.maintainer),
        is_metapackage=args.meta,
    )
    for warning in package_warnings(package):
        print(f"WARNING: {warning}", file=sys.stderr)
    try:
        for line in create_package(Path.cwd(), package):
            print(line)
    except UsageError as error:
        args.refuse(str(error))
    return 0
