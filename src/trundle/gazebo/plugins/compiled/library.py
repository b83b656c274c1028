"""Finder of a compiled plugin by its file name, as Gazebo looks for it; nothing is opened."""

import os
import sys
from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path, PurePosixPath

from trundle.robots.model import PluginTag

_MARK = b"trundle gazebo plugin, interface 1"
"""Text of TRUNDLE_GAZEBO_MARK in `sdk/gazebo/include/gazebo/common/Plugin.hh`."""
_MAX_BYTES = 256 * 1024 * 1024


def plugin_library(tag: PluginTag, environment: Mapping[str, str]) -> Path | None:
    """Return the library of a plugin that was compiled with the development kit; None: there is none.

    It is the path as written; else the file name beside the model, in `build` there, in the folders of
    GAZEBO_PLUGIN_PATH and LD_LIBRARY_PATH, or in the devel space of the workspace around the model.
    """
    return next((path for path in _candidates(tag, environment) if has_mark(path, _MARK)), None)


def foreign_library(tag: PluginTag, environment: Mapping[str, str]) -> Path | None:
    """Return a library of this name that was compiled for Gazebo itself, and cannot be loaded; None: there is none."""
    return next((path for path in _candidates(tag, environment) if not has_mark(path, _MARK)), None)


def _candidates(tag: PluginTag, environment: Mapping[str, str]) -> Iterator[Path]:
    written = tag.filename.replace("\\", "/")
    if not written.endswith((".so", ".dylib")):
        return
    beside = Path(tag.at.file).resolve().parent
    name = PurePosixPath(written).name
    names = [name, f"{name.removesuffix('.so')}.dylib"] if sys.platform == "darwin" else [name]
    paths = [beside / written] if "/" in written else []
    paths += [folder / name for folder in _folders(beside, environment) for name in names]
    for path in dict.fromkeys(paths):
        if os.path.isfile(path):
            yield path


def _folders(beside: Path, environment: Mapping[str, str]) -> list[Path]:
    folders = [beside, beside / "build"]
    for variable in ("GAZEBO_PLUGIN_PATH", "LD_LIBRARY_PATH"):
        folders += [Path(entry) for entry in environment.get(variable, "").split(os.pathsep) if entry]
    prefixes = environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    folders += [Path(prefix, "lib") for prefix in prefixes if prefix]
    return [*folders, *(parent / "devel/lib" for parent in beside.parents)]


def has_mark(path: Path, mark: bytes) -> bool:
    """Return whether a library contains a text that the kit's headers put into it; False for one over 256 MiB."""
    try:
        status = path.stat()
    except OSError:
        return False
    return status.st_size <= _MAX_BYTES and _contains(path, mark, status.st_mtime_ns)


@lru_cache(maxsize=256)
def _contains(path: Path, mark: bytes, _changed_ns: int) -> bool:
    try:
        return mark in path.read_bytes()
    except OSError:
        return False
