"""Workspaces: their spaces and packages, and the CMakeLists.txt at the top of the sources."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.robots.packages import Packages, build_dependencies

_TOPLEVEL = "share/catkin/cmake/toplevel.cmake"
_TOPLEVEL_TEXT = """\
# Top of a catkin workspace: catkin, once it is installed, builds all packages below in one go.
cmake_minimum_required(VERSION 3.0.2)
project(Project)
set(CATKIN_TOPLEVEL TRUE)
find_package(catkin REQUIRED)
catkin_workspace()
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Workspace:
    """Spaces of a workspace."""

    base: Path
    source: Path
    build: Path
    devel: Path
    install: Path

    def packages(self) -> dict[str, Path]:
        """Return the packages of the sources, each after its build dependencies."""
        reachable = Packages({"ROS_PACKAGE_PATH": str(self.source)}, start=self.source).ros_packages()
        packages = {
            name: folder
            for name, folder in reachable.items()
            if folder.is_relative_to(self.source) and (folder / "package.xml").is_file()  # not rosbuild's manifest.xml
        }
        return {name: packages[name] for name in _in_order(packages)}


def _in_order(packages: Mapping[str, Path]) -> list[str]:
    """Return packages in topological order; those of a cycle by name."""
    needs = {name: {*build_dependencies(folder)} & packages.keys() - {name} for name, folder in packages.items()}
    ordered: list[str] = []
    while needs:
        free = sorted(name for name, waiting in needs.items() if waiting.isdisjoint(needs)) or sorted(needs)
        for name in free:
            del needs[name]
        ordered += free
    return ordered


def open_workspace(
    base: Path,
    *,
    source: str | None = None,
    build: str | None = None,
    devel: str | None = None,
    install: str | None = None,
) -> Workspace:
    """Return the workspace of a folder; its spaces are named relative to it.

    Raises:
        UsageError: the folder is not a workspace, in catkin_make's words.
    """
    if not base.is_dir():
        raise UsageError(f'The specified base path "{base}" does not exist')
    if (base / "package.xml").exists():
        raise UsageError(
            f'The specified base path "{base}" contains a package but "catkin_make" must be invoked in the root of '
            "workspace"
        )
    spaces = Workspace(
        base=base,
        source=base / (source or "src"),
        build=base / (build or "build"),
        devel=base / (devel or "devel"),
        install=base / (install or "install"),
    )
    if not spaces.source.is_dir():
        raise UsageError(f'The specified source space "{spaces.source}" does not exist')
    if spaces.source.resolve() != base.resolve() and (base / "CMakeLists.txt").exists():
        raise UsageError(
            f'The specified base path "{base}" contains a CMakeLists.txt but "catkin_make" must be invoked in the '
            "root of workspace"
        )
    return spaces


def init_workspace(source: Path, environment: Mapping[str, str]) -> str:
    """Create the CMakeLists.txt at the top of the sources and return a line about it.

    It is a link to an installed catkin's file, as with catkin; or a file if catkin is not installed.

    Raises:
        UsageError: it exists or cannot be written.
    """
    target = source / "CMakeLists.txt"
    if target.exists():
        raise UsageError(f'File "{target}" already exists')
    try:
        if target.is_symlink():  # a link to a catkin that is no longer installed
            target.unlink()
        installed = _installed_toplevel(environment)
        if installed is None:
            target.write_text(_TOPLEVEL_TEXT)
            return f'Creating file "{target}"'
        target.symlink_to(installed)
    except OSError as error:
        raise UsageError(f"cannot write {target}: {error.strerror}") from None
    return f'Creating symlink "{target}" pointing to "{installed}"'


def _installed_toplevel(environment: Mapping[str, str]) -> Path | None:
    prefixes = [prefix for prefix in environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if prefix]
    files = (Path(prefix, _TOPLEVEL) for prefix in (*prefixes, "/usr"))
    return next((file for file in files if os.path.isfile(file)), None)
