"""Files that a person at the page saves: below the folder where Trundle was started, and never over others unasked."""

import filecmp
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath

from .atomic_write import write_atomically
from .diagnostics import UsageError

_MAX_NAMED = 4
"""Files that a message names."""
_NAME = re.compile(r'[^\x00-\x1f\x7f-\x9f<>:"|?*\\/\ud800-\udfff]{1,120}')
_MAX_BYTES = 255
"""Longest name of a file [bytes of UTF-8]."""
_DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[\d¹²³]) *(\..*)?", re.IGNORECASE)


def is_portable(name: str) -> bool:
    """True for the name of a file or folder that every system can have; neither `..` nor a device's."""
    is_name = bool(_NAME.fullmatch(name)) and len(name.encode()) <= _MAX_BYTES
    return is_name and not name.endswith((" ", ".")) and not _DEVICE.fullmatch(name)


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
    if not inside or os.path.islink(target):
        raise UsageError(f"{target.relative_to(root)}: a link leads elsewhere; choose another name")
    if not folder.is_dir():
        raise UsageError(f"{target.relative_to(root)}: {folder.relative_to(root)} is no folder; choose another name")
    if os.path.exists(target) and not (os.path.isdir(target) if is_folder else os.path.isfile(target)):
        raise UsageError(
            f"{target.relative_to(root)}: this is no {'folder' if is_folder else 'file'}; choose another name"
        )


def save_files(root: Path, files: Mapping[Path, str | bytes | Path], *, replace: bool) -> str | None:
    """Write files below a root, each whole or not at all, in their order; return the names of those that are there
    already and may not be replaced.

    Args:
        root: folder to write below.
        files: file → content, or a file to copy; an equal copy may be there.
        replace: True: what is there is replaced.

    Raises:
        UsageError: they cannot be written.
    """
    for file in files:
        _check(root, file)
    wanted = {file: content for file, content in files.items() if not _is_copy(file, content)}
    in_way = [] if replace else [file for file in wanted if os.path.exists(file)]
    for file, content in () if in_way else wanted.items():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(file, content, replace=replace)
        except FileExistsError:
            in_way = [file]
            break
        except OSError as error:
            raise UsageError(f"cannot write {file.relative_to(root)}: {error.strerror}") from None
    return _names(root, in_way) if in_way else None


def _is_copy(file: Path, content: str | bytes | Path) -> bool:
    return isinstance(content, Path) and os.path.isfile(file) and filecmp.cmp(file, content, shallow=False)


def _names(root: Path, files: Sequence[Path]) -> str:
    names = ", ".join(file.relative_to(root).as_posix() for file in files[:_MAX_NAMED])
    return f"{names} and {len(files) - _MAX_NAMED} more" if len(files) > _MAX_NAMED else names
