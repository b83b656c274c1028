"""What lies around a file: the package it is in, the workspace, the folders to look for its neighbours in."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

MANIFESTS = ("package.xml", "manifest.xml")
PARTS = frozenset({"launch", "urdf", "xacro", "meshes", "models", "worlds", "msg"})
"""A published tutorial often has no package.xml: a folder with one of these in it is a package too."""
_SPACES = {"src": ("src", "devel/share", "install"), "devel": ("devel/share",), "install": ("install",)}
"""The folders of a catkin or colcon workspace, by the one that the file is in."""


def own_package(start: Path) -> Path | None:
    """The innermost package or model folder that a file or folder is in."""
    for folder in _above(start):
        if any((folder / name).exists() for name in (*MANIFESTS, "model.config", *PARTS)):
            return folder
    return None


def workspaces(start: Path) -> Iterator[Path]:
    """The package folders of the workspace that a file or folder is in, those of its own kind first."""
    for folder in _above(start):
        if folder.name in _SPACES:
            beside = (folder.parent / space for space in _SPACES[folder.name])
            yield from (space for space in beside if space.is_dir())
            return


def program_folders(package: str, folder: Path, environment: Mapping[str, str]) -> list[Path]:
    """Where catkin and colcon put the programs of a package that they build: lib/PACKAGE of a prefix.

    Args:
        package: its name.
        folder: where it lies, among sources or below a prefix's share.
        environment: CMAKE_PREFIX_PATH names prefixes.
    """
    prefixes = [Path(entry) for entry in environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep) if entry]
    if folder.parent.name == "share":
        prefixes.append(folder.parent.parent)
    sources = next((each for each in folder.parents if each.name == "src"), None)
    if sources is not None:
        prefixes += [sources.parent / "devel", sources.parent / "install", sources.parent / "install" / package]
    homes = (prefix / "lib" / package for prefix in prefixes)
    return [home for home in dict.fromkeys(homes) if home.is_dir()]


def nearby(start: Path, *, levels: int = 4) -> list[Path]:
    """The folder of a file and those above it, as far as its neighbours may reasonably lie."""
    return list(_above(start))[:levels]


def _above(start: Path) -> Iterator[Path]:
    """A folder, or a file's, and every folder above but the root of the disk."""
    folder = start if start.is_dir() else start.parent
    return (each for each in (folder, *folder.parents) if each.parent != each)
