"""Saving of .rviz files below the folder where Trundle was started."""

import os
from pathlib import Path

from trundle.atomic_write import write_atomically
from trundle.diagnostics import UsageError

_SUFFIX = ".rviz"


def save_rviz(folder: Path, name: str, text: str, *, replace: bool) -> bool:
    """Write a file; return False, with nothing written, if one of that name is there and may not be replaced.

    Args:
        folder: where Trundle was started.
        name: of the file, or its path below the folder.
        text: its content.
        replace: True: a file that is there is replaced.

    Raises:
        UsageError: the name leads elsewhere, its folder is missing, or it cannot be written; the text says which.
    """
    try:
        path = _path(folder, name)
        if replace and path.is_file():
            write_atomically(path, text)
        else:
            with path.open("x", encoding="utf-8") as file:
                file.write(text)
    except FileExistsError:
        return False
    except OSError as error:
        raise UsageError(f"cannot write {name}: {error.strerror}") from None
    return True


def _path(folder: Path, name: str) -> Path:
    """Return the path that a name stands for, checked."""
    if not name.isprintable() or not name.endswith(_SUFFIX) or Path(name).stem == _SUFFIX:
        raise UsageError(f"give a name that ends with {_SUFFIX}, not {name!r}")
    root = Path(os.path.realpath(folder))
    path = root / name
    if not Path(os.path.realpath(path)).is_relative_to(root):  # `resolve` raises where links form a loop
        raise UsageError(f"{name} is not below the folder where Trundle was started; download it instead")
    if not path.parent.is_dir():
        raise UsageError(f"there is no folder {Path(name).parent} where Trundle was started")
    if path.is_dir():
        raise UsageError(f"{name} is a folder")
    return path
