"""What lies around a file: the package it is in, the workspace, the folders to look for its neighbours in."""

from collections.abc import Iterator
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


def nearby(start: Path, *, levels: int = 4) -> list[Path]:
    """The folder of a file and those above it, as far as its neighbours may reasonably lie."""
    return list(_above(start))[:levels]


def _above(start: Path) -> Iterator[Path]:
    """A folder, or a file's, and every folder above but the root of the disk."""
    folder = start if start.is_dir() else start.parent
    return (each for each in (folder, *folder.parents) if each.parent != each)
