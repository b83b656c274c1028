"""Files that a person at the page saves: below the folder where Trundle was started, and never over others unasked."""

import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath

from .atomic_write import write_atomically
from .diagnostics import UsageError

_NAME = re.compile(r'[^\x00-\x1f\x7f-\x9f<>:"|?*\\/]{1,120}')
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)


def is_portable(name: str) -> bool:
    """True for the name of a file or folder that every system can have; neither `..` nor a device's."""
    return bool(_NAME.fullmatch(name)) and not name.endswith((" ", ".")) and not _DEVICE.fullmatch(name)


def find_target(root: Path, name: str, *, example: str, suffixes: Sequence[str] = ()) -> Path:
    """Return the file or folder of a name from the page, which is neither hidden nor behind a link out of the root.

    Args:
        root: folder to write below.
        name: path from there, with slashes.
        example: of a name, for the refusal.
        suffixes: of which the name has one; none: any.

    Raises:
        UsageError: it leads elsewhere, or has another suffix.
    """
    parts = name.split("/")
    if not all(is_portable(part) and not part.startswith(".") for part in parts):
        raise UsageError(
            f"{name!r}: it is saved below the folder where Trundle was started; write a name such as {example}"
        )
    if suffixes and PurePosixPath(name).suffix not in suffixes:
        raise UsageError(f"{name!r}: the name ends in {' or '.join(suffixes)}")
    target = root.joinpath(*parts)
    _check(root, target, is_folder=not suffixes)
    return target


def _check(root: Path, target: Path, *, is_folder: bool = False) -> None:
    """Refuse a path that a link leads out of the root, that leads through a file, or to something of another kind."""
    folder = target.parent
    while not os.path.lexists(folder):
        folder = folder.parent
    inside = Path(os.path.realpath(folder)).is_relative_to(os.path.realpath(root))
    if not inside or target.is_symlink():
        raise UsageError(f"{target.relative_to(root)}: a link leads elsewhere; choose another name")
    if not folder.is_dir():
        raise UsageError(f"{target.relative_to(root)}: {folder.relative_to(root)} is no folder; choose another name")
    if target.exists() and not (target.is_dir() if is_folder else target.is_file()):
        raise UsageError(
            f"{target.relative_to(root)}: this is no {'folder' if is_folder else 'file'}; choose another name"
        )


def save_files(root: Path, files: Mapping[Path, str | bytes], *, replace: bool) -> bool:
    """Write files below a root, each whole or not at all; False: one is there already and may not be replaced.

    Raises:
        UsageError: they cannot be written.
    """
    for file in files:
        _check(root, file)
    if not replace and any(file.exists() for file in files):
        return False
    for file, content in files.items():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(file, content, replace=replace)
        except FileExistsError:
            return False
        except OSError as error:
            raise UsageError(f"cannot write {file.relative_to(root)}: {error.strerror}") from None
    return True
