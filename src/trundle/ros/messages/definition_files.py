"""Files of a package's messages, services and actions."""

import os
from pathlib import Path

from trundle.base.files import read_text

_MAX_DEPTH = 3
_MAX_FOLDERS = 200


def definition_files(folder: Path, kind: str) -> list[Path]:
    """Return a package's definition files, one per name, sorted by name.

    Searches the folder `kind`, its sub-folders, and the DIRECTORY folders of CMakeLists.txt; as in genmsg, folders are
    not part of a type's name.

    Args:
        folder: folder of the package.
        kind: msg, srv or action.
    """
    paths: dict[str, Path] = {}
    for directory in [*_sub_folders(folder / kind), *_cmake_folders(folder, kind)]:
        for name in _entries(directory):
            if name.endswith(f".{kind}"):
                paths.setdefault(name, directory / name)
    return [paths[name] for name in sorted(paths)]


def _sub_folders(top: Path) -> list[Path]:
    """Return a folder and its sub-folders, breadth first."""
    all_folders, level = [top], [top]
    for _ in range(_MAX_DEPTH):
        paths = [folder / name for folder in level for name in _entries(folder) if "." not in name]
        level = [path for path in paths if os.path.isdir(path) and not os.path.islink(path)]
        all_folders += level[: _MAX_FOLDERS - len(all_folders)]
    return all_folders


def _cmake_folders(folder: Path, kind: str) -> list[Path]:
    """Return the folders inside the package that its CMakeLists.txt lists."""
    try:
        if "DIRECTORY" not in read_text(folder / "CMakeLists.txt"):
            return []
    except OSError:
        return []
    from trundle.robots.packages import cmake_message_folders  # lazy: few packages need it

    root = os.path.realpath(folder)
    paths = (Path(os.path.realpath(path)) for path in cmake_message_folders(folder).get(kind, []))
    return [path for path in paths if path.is_relative_to(root)]


def _entries(folder: Path) -> list[str]:
    try:
        return sorted(os.listdir(folder))
    except OSError:
        return []
