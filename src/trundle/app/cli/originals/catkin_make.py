"""Build a workspace, as catkin_make does: its devel space, and its C++ by the development kit."""

import argparse
import os
import re
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError

from .system_program import find_system_program, run_system_program

if TYPE_CHECKING:
    from trundle.ros.catkin import CppTarget, PackageBuild, Workspace
    from trundle.ros.sdk import BuildResult

EXAMPLES = """
  catkin_make                   in the workspace, whose packages are in src
  catkin_make -C ~/catkin_ws
  catkin_make --pkg my_robot
  catkin_make -DCMAKE_BUILD_TYPE=Debug
"""
_DEVEL, _INSTALL = "-DCATKIN_DEVEL_PREFIX=", "-DCMAKE_INSTALL_PREFIX="
_LINE = "-- " + "~" * 49
_COMMENT = re.compile(r"#[^\n]*")
_EXPORTED_HEADERS = re.compile(r"\bcatkin_package\s*\([^()]*\bINCLUDE_DIRS\b", re.IGNORECASE)
"""Command of packages whose headers others include, such as nav_core, which has no targets."""
_TESTS = re.compile(r"\b(?:catkin_add_(?:gtest|gmock|nosetests)|add_rostest\w*)\s*\(", re.IGNORECASE)
_CONFIG = "share/roscpp/cmake/roscppConfig.cmake"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-C", "--directory", default=".", help="base path of the workspace (.)")
    parser.add_argument("--source", help="source space (src)")
    parser.add_argument("--build", help="build space (build)")
    parser.add_argument("--pkg", nargs="+", default=[], help="only these packages")
    parser.add_argument(
        "--only-pkg-with-deps", nargs="+", default=[], metavar="PKG", help="these and their dependencies"
    )
    # Options for the display and for other tools have no effect here.
    for flag in ("ninja", "nmake", "gmake"):
        parser.add_argument(f"--use-{flag}", action="store_true", help=argparse.SUPPRESS)
    for flag in ("--force-cmake", "--no-color", "--override-build-tool-check"):
        parser.add_argument(flag, action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("-j", "--jobs", nargs="?", help="number of compilers that run at the same time")
    parser.add_argument("-l", "--load-average", nargs="?", help=argparse.SUPPRESS)
    parser.add_argument("-D", action="append", default=[], dest="definitions", metavar="NAME=VALUE", help="for CMake")
    for option in ("--cmake-args", "--make-args"):
        parser.add_argument(option, nargs=argparse.REMAINDER, default=[], help=argparse.SUPPRESS)
    parser.add_argument("targets", nargs="*", help="targets, such as install (all)")


def main(args: argparse.Namespace) -> int:
    """Build by the original if a ROS is sourced, else by the kit."""
    if (original := _sourced_original()) is not None:
        print(f"-- a ROS is sourced: {original} builds", flush=True)
        return run_system_program("catkin_make", sys.argv[sys.argv.index("catkin_make") + 1 :])
    return build_workspace(args)


def build_workspace(args: argparse.Namespace) -> int:
    """Write the devel space, and build the C++ targets; return 1 if one could not be built."""
    from trundle.robots.packages import write_configured_files
    from trundle.ros.catkin import init_workspace, open_workspace, report_package, underlays, write_devel_space

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
    packages = _select(known, [*args.pkg, *_with_dependencies(known, args.only_pkg_with_deps)])
    if not (workspace.source / "CMakeLists.txt").exists():
        print(init_workspace(workspace.source, os.environ))
    is_written = write_devel_space(workspace, os.environ)
    print(f"-- Using CATKIN_DEVEL_PREFIX: {workspace.devel}")
    if not is_written:
        print(f"-- {workspace.devel} was made by catkin itself; its setup files are kept")
    print(f"{_LINE}\n-- ~~  traversing {len(packages)} packages in topological order:")
    print("".join(f"-- ~~  - {name}\n" for name in packages) + _LINE)
    for folder in packages.values():
        for path in write_configured_files(folder, replace=True):
            print(f"-- configured: {os.path.relpath(path, workspace.base)}")
    made = {
        name
        for name, folder in packages.items()
        if report_package(known, name, os.environ).targets or (_is_tested(args.targets) and _has(_TESTS, folder))
    }
    compiled = {name: folder for name, folder in packages.items() if name in made or _has(_EXPORTED_HEADERS, folder)}
    fault, results = "", {}
    if made:
        try:
            needed = _unbuilt_dependencies(workspace, known, compiled)
            prefixes = underlays(workspace.devel, os.environ)
            results = _build(workspace, known, compiled, needed, args, definitions, prefixes)
        except UsageError as error:
            fault = str(error)
    unbuilt: list[CppTarget] = []
    for name in packages:
        print(f"-- +++ processing catkin package: '{name}'")
        build = report_package(known, name, os.environ)
        remaining = [target for target in build.targets if target.built is None or target.fault is not None]
        print("\n".join(_lines(build, workspace, results.get(name))))
        unbuilt += [] if _is_complete(results.get(name)) else remaining
    if unbuilt:
        them = f"{len(unbuilt)} C++ target{'s are' if len(unbuilt) > 1 else ' is'} not built"
        print(f"-- {them}; all else runs as it is{f'; {fault}' if fault else ''}", file=sys.stderr)
    print(f"-- source {workspace.devel}/setup.bash makes the packages known to this shell")
    return 1 if unbuilt and not fault else 0


def _with_dependencies(known: Mapping[str, Path], names: Iterable[str]) -> list[str]:
    """Return packages, and those of the workspace that they need, directly or through others."""
    from trundle.robots.packages import build_dependencies

    found = list(dict.fromkeys(names))
    for name in found:  # grows
        needs = build_dependencies(known[name]) if name in known else []
        found += [need for need in needs if need in known and need not in found]
    return found


def _unbuilt_dependencies(
    workspace: "Workspace", known: Mapping[str, Path], packages: Mapping[str, Path]
) -> dict[str, Path]:
    """Return the packages that others need, but whose headers or libraries are not yet in the devel space."""
    from trundle.ros.catkin import report_package

    names = set(_with_dependencies(known, packages)) - packages.keys()
    needed: dict[str, Path] = {}
    for name in (name for name in known if name in names):
        targets = report_package(known, name, os.environ).targets
        is_exported = (workspace.devel / f"share/{name}/cmake/{name}Config.cmake").exists()
        if any(target.is_library and target.built is None for target in targets) or (
            not is_exported and (targets or _has(_EXPORTED_HEADERS, known[name]))
        ):
            needed[name] = known[name]
    return needed


def _is_tested(targets: list[str]) -> bool:
    return any(target == "tests" or target.startswith("run_tests") for target in targets)


def _has(command: re.Pattern[str], folder: Path) -> bool:
    """True if a package's CMakeLists.txt has a command."""
    cmake = folder / "CMakeLists.txt"
    text = cmake.read_text(encoding="utf-8", errors="replace") if cmake.is_file() else ""
    return command.search(_COMMENT.sub("", text)) is not None


def _sourced_original() -> str | None:
    """Return the machine's catkin_make if a ROS with roscpp is sourced; else None."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    is_sourced = any(os.path.isfile(os.path.join(prefix, _CONFIG)) for prefix in prefixes if prefix)
    return find_system_program("catkin_make") if is_sourced else None


def _build(
    workspace: "Workspace",
    known: Mapping[str, Path],
    packages: Mapping[str, Path],
    needed: Mapping[str, Path],
    args: argparse.Namespace,
    definitions: list[str],
    underlays: list[str],
) -> "dict[str, BuildResult]":
    """Build packages, before them what they need of others; print what the tools print."""
    from trundle.ros.rospy.environment import with_finder
    from trundle.ros.sdk import (
        Headers,
        PackageBuilder,
        compiled_kit,
        find_toolchain,
        link_programs,
        write_config_headers,
    )

    toolchain = find_toolchain(os.environ)
    kit = compiled_kit(toolchain, os.environ, jobs=args.jobs)
    headers = Headers(known, workspace.devel / "include", kit.folder / "include", provided=kit.sources)
    builder = PackageBuilder(
        kit,
        toolchain,
        build=workspace.build,
        devel=workspace.devel,
        install=workspace.install,
        underlays=underlays,
        definitions=definitions,
        environment=os.environ,
    )
    results: dict[str, BuildResult] = {}
    python = with_finder(os.environ, [workspace.source])
    for name in known:  # a package may include what any other of the workspace generates
        headers.write_package(name)
        for fault in write_config_headers(name, known[name], workspace.devel / "include", python):
            print(fault, file=sys.stderr)
    headers.write_included([*needed.values(), *packages.values()])
    link_programs(kit, known, workspace.devel)
    for name, folder in needed.items():
        print(f"#### configuring package '{name}', which others need", flush=True)
        for line in builder.build_exports(name, folder, jobs=args.jobs):
            print(line, flush=True)
    for name, folder in packages.items():
        print(f"#### building package '{name}'", flush=True)
        for line in builder.build(name, folder, jobs=args.jobs, targets=args.targets):
            if isinstance(line, str):
                print(line, flush=True)
            else:
                results[name] = line
    return results


def _last(words: list[str], prefix: str) -> str | None:
    return next((word.removeprefix(prefix) for word in reversed(words) if word.startswith(prefix)), None)


def _select(packages: Mapping[str, Path], names: list[str]) -> dict[str, Path]:
    unknown = [name for name in names if name not in packages]
    if names and len(unknown) == len(names):
        raise UsageError(f'Packages "{", ".join(unknown)}" not found in the workspace')
    if unknown:
        print(f'Packages "{", ".join(sorted(unknown))}" not found in the workspace - ignoring them', file=sys.stderr)
    return {name: folder for name, folder in packages.items() if not names or name in names}


def _is_complete(result: "BuildResult | None") -> bool:
    """True if all that CMake defined is built; CMakeLists.txt may name more, such as tests."""
    return result is not None and result.is_configured and not result.failures


def _lines(build: "PackageBuild", workspace: "Workspace", result: "BuildResult | None") -> list[str]:
    ready = ", ".join(build.ready) or "nothing to run"
    lines = [f"--   needs no building: {ready}"]
    failures = {} if result is None else result.failures
    for target in build.targets:
        kind = "library" if target.is_library else "program"
        location = f"{os.path.relpath(target.target.file, workspace.base)}:{target.target.line}"
        state = f"built: {target.built}" if target.built is not None else "C++, not built"
        if target.built is None and _is_complete(result):
            state = "not in this build: a test, or CMakeLists.txt has a condition"
        state += f", but not for this machine: {target.fault}" if target.fault is not None else ""
        if failure := failures.get(target.target.target) or failures.get(target.target.name):
            state = f"not built: {failure}"
        lines.append(f"--   {kind} {target.target.name} ({', '.join(target.target.sources)}; {location}): {state}")
    if result is not None and "CMake" in failures:
        lines.append(f"--   CMake stopped: {failures['CMake']}")
    if result is not None and result.missing and failures:
        lines.append(f"--   not found: {', '.join(result.missing)}")
    return lines
