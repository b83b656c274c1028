"""Files of a package's messages, services and actions."""

import os
from pathlib import Path

from trundle.base.files import read_text

_MAX_DEPTH = 3
_MAX_FOLDERS = 200


def definition_files(folder: Path, kind: str) -> list[Path]:
    """Return a package's definitions, one for each name, sorted by it.

    They are in the folder of their kind, below it, or where CMakeLists.txt says by DIRECTORY; as genmsg does, folders
    are no part of a name.

    Args:
        folder: the package's.
        kind: msg, srv or action.
    """
    found: dict[str, Path] = {}
    for each in [*_folders(folder / kind), *_named(folder, kind)]:
        for name in _entries(each):
            if name.endswith(f".{kind}"):
                found.setdefault(name, each / name)
    return [found[name] for name in sorted(found)]


def _folders(top: Path) -> list[Path]:
    """Return a folder and those below it, nearest first."""
    all_folders, level = [top], [top]
    for _ in range(_MAX_DEPTH):
        level = [each / name for each in level for name in _entries(each) if "." not in name]
        level = [each for each in level if os.path.isdir(each) and not os.path.islink(each)]
        all_folders += level[: _MAX_FOLDERS - len(all_folders)]
    return all_folders


def _named(folder: Path, kind: str) -> list[Path]:
    """Return the folders in the package that its CMakeLists.txt names."""
    try:
        if "DIRECTORY" not in read_text(folder / "CMakeLists.txt"):
            return []
    except OSError:
        return []
    from trundle.robots.packages import cmake_message_folders  # lazy: for few packages

    root = os.path.realpath(folder)
    named = (Path(os.path.realpath(each)) for each in cmake_message_folders(folder).get(kind, []))
    return [each for each in named if each.is_relative_to(root)]


def _entries(folder: Path) -> list[str]:
    try:
        return sorted(os.listdir(folder))
    except OSError:
        return []
