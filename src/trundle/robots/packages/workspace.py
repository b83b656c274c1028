"""Package and workspace of a file, and its parent folders."""

import os
import stat
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from .confinement import Confinement, WideFolders
from .crawl import MANIFESTS, Crawl

PARTS = frozenset({"launch", "urdf", "xacro", "meshes", "models", "worlds", "msg"})
"""Folders that identify a package without package.xml, as in many published tutorials."""
_CONTENTS = PARTS | {"config", "materials", "media", "params", "textures"}
"""Readable folders of such a package."""
_SPACES = {"src": ("src", "devel/share", "install"), "devel": ("devel/share", "src"), "install": ("install", "src")}
"""Space that contains the file → spaces of a catkin or colcon workspace to search."""
_MAX_DEPTH = 3
"""Maximum depth of packages below a workspace's `src`: repository, group, package."""
_MAX_FOLDERS = 500


def enclosing_package(start: Path, wide: WideFolders) -> Path | None:
    """Return the innermost package or model folder that contains a file or folder, with or without a manifest."""
    for folder in _with_parents(start):
        if any(os.path.exists(folder / name) for name in (*MANIFESTS, "model.config", *PARTS)) and folder not in wide:
            return folder
    return None


def package_confinement(start: Path, wide: WideFolders) -> Confinement:
    """Return the folders readable by a file of a package or model.

    Without a manifest or model.config these are the file's folder, and the package's folders such as `meshes`.
    """
    folders = list(_with_parents(start)) or [start.parent]
    for folder in folders:
        if any(os.path.isfile(folder / name) for name in (*MANIFESTS, "model.config")) and folder not in wide:
            return Confinement([folder], wide=wide)
    start_folder = folders[0]
    package = next((folder for folder in folders if any(os.path.isdir(folder / part) for part in PARTS)), start_folder)
    return Confinement(
        [start_folder, *(package / name for name in _CONTENTS)], wide=wide, visible_in=[start_folder, package]
    )


def workspaces(start: Path) -> Iterator[Path]:
    """Yield the spaces of the workspace that contains a file or folder, starting with its own space."""
    for folder in _with_parents(start):
        if _has_manifest(folder):
            continue  # a package's `src` contains programs
        if folder.name in _SPACES and not _has_manifest(folder.parent):
            spaces = (folder.parent / space for space in _SPACES[folder.name])
        elif _holds_packages(folder / "src"):
            spaces = (folder / space for space in _SPACES["src"])
        else:
            continue
        yield from (space for space in spaces if os.path.isdir(space))
        return


def _has_manifest(folder: Path) -> bool:
    return any(os.path.isfile(folder / name) for name in MANIFESTS)


def _holds_packages(folder: Path) -> bool:
    walk = Crawl(folder, max_folders=_MAX_FOLDERS, max_depth=_MAX_DEPTH)
    return any(not names.isdisjoint(MANIFESTS) for _, names in walk)


def distinct_folders(folders: Iterable[Path]) -> list[Path]:
    """Return the folders without duplicates after resolving links, under their first names."""
    by_real_path: dict[str, Path] = {}
    for folder in folders:
        by_real_path.setdefault(os.path.realpath(folder), folder)
    return list(by_real_path.values())


def program_folders(package: str, folder: Path, environment: Mapping[str, str]) -> list[Path]:
    """Return the folders in which catkin and colcon place a package's programs: lib/PACKAGE of a prefix.

    Args:
        package: package name.
        folder: package folder, in a source space or below a prefix's share.
        environment: environment with CMAKE_PREFIX_PATH.
    """
    folders = (prefix / "lib" / package for prefix in build_prefixes(package, folder, environment))
    return [path for path in dict.fromkeys(folders) if os.path.isdir(path)]


def build_prefixes(package: str, folder: Path, environment: Mapping[str, str]) -> list[Path]:
    """Return the prefixes in which catkin and colcon place what a package builds; see `program_folders`."""
    prefixes = [Path(entry) for entry in environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if entry]
    if folder.parent.name == "share":
        prefixes.append(folder.parent.parent)
    for base in (parent.parent for parent in folder.parents if parent.name == "src"):  # a repository may have src, too
        prefixes += [base / "devel", base / "install", base / "install" / package]
    return prefixes


def ancestor_folders(start: Path, *, levels: int = 4) -> list[Path]:
    """Return the folder of a file and its nearest parents."""
    return list(_with_parents(start))[:levels]


def _with_parents(start: Path) -> Iterator[Path]:
    """Yield a folder, or a file's folder, and its parents below the root or a folder of temporary files."""
    folder = start if os.path.isdir(start) else start.parent
    for ancestor in (folder, *folder.parents):
        if ancestor.parent == ancestor or (ancestor != folder and _is_shared(ancestor)):
            return
        yield ancestor


def _is_shared(folder: Path) -> bool:
    """True for a folder such as /tmp, in which any user may create a package."""
    try:
        mode = os.stat(folder).st_mode
    except OSError:
        return False
    return bool(mode & stat.S_ISVTX and mode & stat.S_IWOTH)
