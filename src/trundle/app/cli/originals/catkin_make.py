"""Create a workspace's devel space, as catkin_make does, and list the C++ targets, which are not built."""

import argparse
import os
import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError

from .system_program import find_system_program

if TYPE_CHECKING:
    from trundle.ros.catkin import CppTarget, PackageBuild, Workspace

EXAMPLES = """
  catkin_make                   in the workspace, whose packages are in src
  catkin_make -C ~/catkin_ws
  catkin_make --pkg my_robot
"""
_DEVEL, _INSTALL = "-DCATKIN_DEVEL_PREFIX=", "-DCMAKE_INSTALL_PREFIX="
_LINE = "-- " + "~" * 49
_COMPILERS = ("c++", "g++", "clang++")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-C", "--directory", default=".", help="base path of the workspace (.)")
    parser.add_argument("--source", help="source space (src)")
    parser.add_argument("--build", help="build space (build)")
    parser.add_argument("--pkg", nargs="+", default=[], help="only these packages")
    parser.add_argument("--only-pkg-with-deps", nargs="+", default=[], metavar="PKG", help="only these packages")
    # Options for CMake and make have no effect here.
    for flag in ("ninja", "nmake", "gmake"):
        parser.add_argument(f"--use-{flag}", action="store_true", help=argparse.SUPPRESS)
    for flag in ("--force-cmake", "--no-color", "--override-build-tool-check"):
        parser.add_argument(flag, action="store_true", help=argparse.SUPPRESS)
    for option in ("-j", "--jobs", "-l", "--load-average"):
        parser.add_argument(option, nargs="?", dest="unused_limit", help=argparse.SUPPRESS)
    parser.add_argument("-D", action="append", default=[], dest="definitions", metavar="NAME=VALUE", help="for CMake")
    for option in ("--cmake-args", "--make-args"):
        parser.add_argument(option, nargs=argparse.REMAINDER, default=[], help=argparse.SUPPRESS)
    parser.add_argument("targets", nargs="*", help="targets for make: not run")


def main(args: argparse.Namespace) -> int:
    """Write the devel space, and list C++ targets, which are not built."""
    from trundle.robots.packages import write_configured_files
    from trundle.ros.catkin import init_workspace, open_workspace, report_package, write_devel_space

    definitions = [f"-D{definition}" for definition in args.definitions] + args.cmake_args
    base = Path(os.path.abspath(os.path.join(os.environ.get("PWD", "."), args.directory)))
    workspace = open_workspace(
        base,
        source=args.source,
        build=args.build,
        devel=_last(definitions, _DEVEL),
        install=_last(definitions, _INSTALL),
    )
    for name, space in (("Base path", base), ("Source space", workspace.source), ("Build space", workspace.build)):
        print(f"{name}: {space}")
    print(f"Devel space: {workspace.devel}\nInstall space: {workspace.install}")
    known = workspace.packages()
    packages = _select(known, [*args.pkg, *args.only_pkg_with_deps])
    if not (workspace.source / "CMakeLists.txt").exists():
        print(init_workspace(workspace.source, os.environ))
    is_written = write_devel_space(workspace, os.environ)
    print(f"-- Using CATKIN_DEVEL_PREFIX: {workspace.devel}")
    if not is_written:
        print(f"-- {workspace.devel} was made by catkin itself; its setup files are kept")
    print(f"{_LINE}\n-- ~~  traversing {len(packages)} packages in topological order:")
    print("".join(f"-- ~~  - {name}\n" for name in packages) + _LINE)
    unbuilt: list[CppTarget] = []
    missing: list[str] = []
    for name, folder in packages.items():
        print(f"-- +++ processing catkin package: '{name}'")
        for path in write_configured_files(folder, replace=True):
            print(f"--   configured: {os.path.relpath(path, workspace.base)}")
        build = report_package(known, name, os.environ)
        print("\n".join(_lines(build, workspace)))
        remaining = [target for target in build.targets if target.built is None or target.fault is not None]
        unbuilt += remaining
        missing += build.missing if remaining else ()
    for target in args.targets:
        print(f"-- target {target!r} is not run: nothing is compiled here", file=sys.stderr)
    if unbuilt:
        print(_build_advice(len(unbuilt), missing), file=sys.stderr)
    print(f"-- source {workspace.devel}/setup.bash makes the packages known to this shell")
    return 0


def _last(words: list[str], prefix: str) -> str | None:
    return next((word.removeprefix(prefix) for word in reversed(words) if word.startswith(prefix)), None)


def _select(packages: Mapping[str, Path], names: list[str]) -> dict[str, Path]:
    unknown = [name for name in names if name not in packages]
    if names and len(unknown) == len(names):
        raise UsageError(f'Packages "{", ".join(unknown)}" not found in the workspace')
    if unknown:
        print(f'Packages "{", ".join(sorted(unknown))}" not found in the workspace - ignoring them', file=sys.stderr)
    return {name: folder for name, folder in packages.items() if not names or name in names}


def _lines(build: "PackageBuild", workspace: "Workspace") -> list[str]:
    ready = ", ".join(build.ready) or "nothing to run"
    lines = [f"--   needs no building: {ready}"]
    for target in build.targets:
        kind = "library" if target.is_library else "program"
        location = f"{os.path.relpath(target.target.file, workspace.base)}:{target.target.line}"
        state = f"built: {target.built}" if target.built is not None else "C++, not built"
        state += f", but not for this machine: {target.fault}" if target.fault is not None else ""
        lines.append(f"--   {kind} {target.target.name} ({', '.join(target.target.sources)}; {location}): {state}")
    if build.missing and any(target.built is None for target in build.targets):
        lines.append(f"--   to build it, CMake has to find {', '.join(build.missing)}, which this machine lacks")
    return lines


def _build_advice(unbuilt: int, missing: list[str]) -> str:
    """Return a line on how to build the remaining targets here.

    Args:
        unbuilt: number of programs and libraries that are not built.
        missing: dependencies that CMake needs for them and this machine lacks.
    """
    from trundle.ros.catkin import debian_packages

    them = "them" if unbuilt > 1 else "it"
    count = f"{unbuilt} C++ target{'s are' if unbuilt > 1 else ' is'} not built; all else runs as it is"
    original = find_system_program("catkin_make")
    required = list(dict.fromkeys(missing if original else [*missing, "catkin"]))
    packages = debian_packages(required) if required else {}
    if original is not None and not required:
        return f"-- {count}; {original} compiles {them}"
    if len(packages) == len(required):
        install = f"apt install {' '.join(sorted(packages.values()))}"
        return f"-- {count}; {install}, and then {original or '/usr/bin/catkin_make'} compiles {them}"
    if original is not None:
        without = ", ".join(name for name in required if name not in packages)
        return f"-- {count}; {original} compiles {them}, once there is {without}, which apt does not have"
    compiler = next((path for name in _COMPILERS if (path := shutil.which(name))), None)
    has = f"there is a compiler, {compiler}, but no" if compiler else "there is neither a C++ compiler nor"
    return f"-- {count}; {has} catkin here, which ROS 1 brings"
