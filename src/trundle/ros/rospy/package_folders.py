"""Folders of the ROS packages around the running program, and the Python modules in them."""

import os
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from trundle.robots.packages import Packages

_MANIFESTS = ("package.xml", "manifest.xml", ".catkin_workspace")
_MAX_PARENTS = 8


def find_package(name: str) -> Path | None:
    """Find the folder of a ROS package on ROS_PACKAGE_PATH or around the running program."""
    return next((folder for packages in _packages() if (folder := packages.find_package(name)) is not None), None)


def find_module(name: str) -> Path | None:
    """Find a top-level Python module of a ROS package: the folder of a package, or a file.

    As after catkin's build: the modules that setup.py lists; without setup.py `src/NAME` of the package NAME.
    """
    return _modules().get(name)


@cache
def _packages() -> "tuple[Packages, ...]":
    """Package indexes around the program's folder and the working directory; none outside of ROS workspaces."""
    starts = [folder for folder in dict.fromkeys((_program_folder(), Path.cwd())) if folder is not None]
    if "ROS_PACKAGE_PATH" not in os.environ:
        starts = [folder for folder in starts if _is_in_workspace(folder)]
    if not starts:
        return ()
    from trundle.robots.packages import Packages

    first = Packages(os.environ, start=starts[0])
    return (first, *(Packages(os.environ, start=start, fallback=first) for start in starts[1:]))


def _program_folder() -> Path | None:
    """Folder of the running script; None if there is none."""
    script = sys.argv[0] if getattr(sys, "argv", None) else ""
    return Path(os.path.realpath(script)).parent if os.path.isfile(script) else None


def _is_in_workspace(folder: Path) -> bool:
    parents = [folder, *folder.parents][:_MAX_PARENTS]
    return any(os.path.exists(parent / name) for parent in parents for name in _MANIFESTS) or any(
        os.path.isfile(parent / "src/CMakeLists.txt") for parent in parents
    )


@cache
def _modules() -> "Mapping[str, Path]":
    modules: dict[str, Path] = {}
    for packages in _packages():
        for name, folder in packages.ros_packages().items():
            for module, path in package_modules(name, folder):
                modules.setdefault(module, path)
    return modules


def package_modules(package: str, folder: Path) -> "Iterator[tuple[str, Path]]":
    """Yield the top-level modules of a ROS package with their paths."""
    if os.path.isfile(folder / "setup.py"):
        from .setup_file import read_setup

        yield from read_setup(folder / "setup.py")
    source = folder / "src" / package
    if os.path.isfile(source / "__init__.py"):
        yield package, source
