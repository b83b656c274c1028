"""Build a workspace, as catkin of catkin_tools does: `catkin build`, `init`, `list` and `clean`."""

import argparse
import os
import shutil
from pathlib import Path

from trundle.base.diagnostics import UsageError

from . import catkin_make

EXAMPLES = """
  catkin build                  in the workspace, or in a folder of it
  catkin build my_robot -DCMAKE_BUILD_TYPE=Debug
  catkin clean -y
"""
_MARKER = ".catkin_tools"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    build = verbs.add_parser("build", help="build packages (all)")
    build.add_argument("packages", nargs="*", help="only these packages")
    build.add_argument("-j", "--jobs", nargs="?", help="number of compilers that run at the same time")
    build.add_argument("-D", action="append", default=[], dest="definitions", metavar="NAME=VALUE", help="for CMake")
    build.add_argument("--cmake-args", nargs=argparse.REMAINDER, default=[], help="words for CMake")
    for flag in ("--no-deps", "--continue-on-failure", "-c", "--no-status", "--verbose", "-v", "--summarize", "-s"):
        build.add_argument(flag, action="store_true", help=argparse.SUPPRESS)  # without effect here
    clean = verbs.add_parser("clean", help="remove the build and devel spaces")
    clean.add_argument("-y", "--yes", action="store_true", help="do not ask")
    verbs.add_parser("init", help="make the folder of a workspace's settings")
    verbs.add_parser("list", help="list the packages")
    for verb in verbs.choices.values():
        verb.add_argument("-w", "--workspace", type=Path, help="folder of the workspace (this one, or one above)")


def main(args: argparse.Namespace) -> int:
    """Run a verb."""
    from trundle.ros.catkin import open_workspace

    base = _base(args.workspace)
    if args.verb == "init":
        (base / _MARKER).mkdir(parents=True, exist_ok=True)
        (base / "src").mkdir(exist_ok=True)
        print(f"Initialized the workspace {base}")
        return 0
    if args.verb == "build":
        words = argparse.Namespace(
            directory=str(base),
            source=None,
            build=None,
            pkg=args.packages,
            only_pkg_with_deps=[],
            definitions=args.definitions,
            cmake_args=args.cmake_args,
            jobs=args.jobs,
            targets=[],
        )
        return catkin_make.build_workspace(words)
    workspace = open_workspace(base)
    if args.verb == "list":
        print("".join(f"- {name}\n" for name in sorted(workspace.packages())), end="")
        return 0
    spaces = [space for space in (workspace.build, workspace.devel, base / "logs") if space.is_dir()]
    if spaces and not args.yes:
        names = ", ".join(map(str, spaces))
        raise UsageError(f"catkin clean removes {names}; say so with catkin clean -y")
    for space in spaces:
        shutil.rmtree(space)
        print(f"removed {space}")
    return 0


def _base(given: Path | None) -> Path:
    """Return the workspace's folder: the given one, else the next one above that looks like one, else this one."""
    here = Path(os.environ.get("PWD") or Path.cwd())
    if given is not None:
        return Path(os.path.abspath(here / given))
    folders = [folder for folder in (here, *here.parents) if not (folder / "package.xml").exists()]
    marked = next((folder for folder in folders if (folder / _MARKER).is_dir()), None)
    return marked or next((folder for folder in folders if (folder / "src").is_dir()), here)
