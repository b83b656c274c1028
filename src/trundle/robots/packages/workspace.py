"""Surroundings of a file: its package, its workspace, and the folders searched for neighbours."""

import os
import stat
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from .confinement import Confinement, WideFolders
from .crawl import MANIFESTS, Crawl

PARTS = frozenset({"launch", "urdf", "xacro", "meshes", "models", "worlds", "msg"})
"""Folders that mark a package without package.xml, as in many published tutorials."""
_CONTENTS = PARTS | {"config", "materials", "media", "params", "textures"}
"""Folders that files of such a package may read."""
_SPACES = {"src": ("src", "devel/share", "install"), "devel": ("devel/share", "src"), "install": ("install", "src")}
"""Folders of a catkin or colcon workspace, by the one that contains the file."""
_DEEPEST = 3
"""Largest depth below a workspace's `src`: a package in a group in a repository."""
_MAX_LOOKED_AT = 500


def own_package(start: Path, wide: WideFolders) -> Path | None:
    """Return the innermost package or model folder that contains a file or folder, with or without a manifest."""
    for folder in _with_parents(start):
        if any(os.path.exists(folder / name) for name in (*MANIFESTS, "model.config", *PARTS)) and folder not in wide:
            return folder
    return None


def own_confinement(start: Path, wide: WideFolders) -> Confinement:
    """Return the folders that a file may read as its own: its package or model folder.

    Without a manifest or model.config these are its own folder, and the package's folders such as `meshes`.
    """
    folders = list(_with_parents(start)) or [start.parent]
    for folder in folders:
        if any(os.path.isfile(folder / name) for name in (*MANIFESTS, "model.config")) and folder not in wide:
            return Confinement([folder], wide=wide)
    own = folders[0]
    around = next((folder for folder in folders if any(os.path.isdir(folder / part) for part in PARTS)), own)
    return Confinement([own, *(around / name for name in _CONTENTS)], wide=wide, beside=[own, around])


def workspaces(start: Path) -> Iterator[Path]:
    """Yield the package folders of the workspace that contains a file or folder, those of its own kind first."""
    for folder in _with_parents(start):
        if _has_manifest(folder):
            continue  # `src` of a package holds programs
        if folder.name in _SPACES and not _has_manifest(folder.parent):
            beside = (folder.parent / space for space in _SPACES[folder.name])
        elif _holds_packages(folder / "src"):
            beside = (folder / space for space in _SPACES["src"])
        else:
            continue
        yield from (space for space in beside if os.path.isdir(space))
        return


def _has_manifest(folder: Path) -> bool:
    return any(os.path.isfile(folder / name) for name in MANIFESTS)


def _holds_packages(folder: Path) -> bool:
    walk = Crawl(folder, max_folders=_MAX_LOOKED_AT, deepest=_DEEPEST)
    return any(not names.isdisjoint(MANIFESTS) for _, names in walk)


def distinct_folders(folders: Iterable[Path]) -> list[Path]:
    """Return each folder once, with links resolved, under its first name."""
    named: dict[str, Path] = {}
    for folder in folders:
        named.setdefault(os.path.realpath(folder), folder)
    return list(named.values())


def program_folders(package: str, folder: Path, environment: Mapping[str, str]) -> list[Path]:
    """Return the folders in which catkin and colcon place a package's programs: lib/PACKAGE of a prefix.

    Args:
        package: its name.
        folder: its folder, in a source space or below a prefix's share.
        environment: with CMAKE_PREFIX_PATH.
    """
    prefixes = [Path(entry) for entry in environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if entry]
    if folder.parent.name == "share":
        prefixes.append(folder.parent.parent)
    sources = next((each for each in folder.parents if each.name == "src"), None)
    if sources is not None:
        prefixes += [sources.parent / "devel", sources.parent / "install", sources.parent / "install" / package]
    homes = (prefix / "lib" / package for prefix in prefixes)
    return [home for home in dict.fromkeys(homes) if os.path.isdir(home)]


def ancestor_folders(start: Path, *, levels: int = 4) -> list[Path]:
    """Return the folder of a file and its nearest parents, in which neighbours are searched."""
    return list(_with_parents(start))[:levels]


def _with_parents(start: Path) -> Iterator[Path]:
    """Yield a folder, or a file's, and its parents up to the root of the disk or a folder of temporary files."""
    folder = start if os.path.isdir(start) else start.parent
    for each in (folder, *folder.parents):
        if each.parent == each or (each != folder and _is_shared(each)):
            return
        yield each


def _is_shared(folder: Path) -> bool:
    """True for a folder such as /tmp, in which any user may create a `launch` or a package.xml."""
    try:
        mode = os.stat(folder).st_mode
    except OSError:
        return False
    return bool(mode & stat.S_ISVTX and mode & stat.S_IWOTH)
