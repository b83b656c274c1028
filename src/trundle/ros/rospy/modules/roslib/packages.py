"""Folders of packages, and files in them."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from trundle.ros.rospy.package_folders import find_package

PACKAGE_FILE = "package.xml"
_NOT_SEARCHED = frozenset({"__pycache__", "build"})


class ROSPkgException(Exception):
    """Base class."""


class InvalidROSPkgException(ROSPkgException):
    """No such package."""


class MultipleNodesException(ROSPkgException):
    """Several programs have the same name."""


def get_pkg_dir(
    package: str, required: bool = True, ros_root: str | None = None, ros_package_path: str | None = None
) -> str | None:
    """Folder of a package.

    Raises:
        InvalidROSPkgException: it is not found, and required.
    """
    del ros_root, ros_package_path
    folder = find_package(package)
    if folder is None and required:
        raise InvalidROSPkgException(f"Cannot locate installation of package {package}")
    return None if folder is None else str(folder)


def get_dir_pkg(d: str) -> tuple[str | None, str | None]:
    """Folder and name of the package that contains a folder; (None, None) if there is none."""
    for folder in (Path(d).absolute(), *Path(d).absolute().parents):
        if any(os.path.isfile(folder / name) for name in (PACKAGE_FILE, "manifest.xml")):
            return str(folder), folder.name
    return None, None


def get_pkg_subdir(
    package: str, subdir: str, required: bool = True, env: Mapping[str, str] | None = None
) -> str | None:
    """Folder within a package, created if it is missing.

    Raises:
        InvalidROSPkgException: the package is not found, and required.
    """
    del env
    folder = get_pkg_dir(package, required)
    if folder is None:
        return None
    path = os.path.join(folder, subdir)
    os.makedirs(path, exist_ok=True)
    return path


def resource_file(package: str, subdir: str, resource_name: str) -> str:
    """Path of a file in a package's folder."""
    return os.path.join(str(get_pkg_dir(package)), subdir, resource_name)


def find_resource(
    pkg: str, resource_name: str, filter_fn: Callable[[str], bool] | None = None, rospack: Any = None
) -> list[str]:
    """Paths of all files of a name in a package."""
    del rospack
    paths: list[str] = []
    for root, folders, files in os.walk(str(get_pkg_dir(pkg))):
        folders[:] = sorted(name for name in folders if not name.startswith(".") and name not in _NOT_SEARCHED)
        path = os.path.join(root, resource_name)
        if resource_name in files and (filter_fn is None or filter_fn(path)):
            paths.append(path)
    return paths


def find_node(pkg: str, node_type: str, rospack: Any = None) -> list[str]:
    """Paths of all programs of a name in a package."""
    return find_resource(pkg, node_type, lambda path: os.access(path, os.X_OK), rospack)
