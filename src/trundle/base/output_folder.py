"""Files saved at the page: below the folder where Trundle was started, overwriting only on request."""

import filecmp
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath

from .atomic_write import write_atomically
from .diagnostics import UsageError

_MAX_LISTED = 4
"""Maximum number of files that a message lists."""
_NAME = re.compile(r'[^\x00-\x1f\x7f-\x9f<>:"|?*\\/\ud800-\udfff]{1,120}')
_MAX_BYTES = 255
"""Maximum length of a file name [bytes of UTF-8]."""
_DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[\d¹²³]) *(\..*)?", re.IGNORECASE)


def is_portable(name: str) -> bool:
    """True for a file or folder name that is valid on every system; neither `..` nor a device's name."""
    is_name = bool(_NAME.fullmatch(name)) and len(name.encode()) <= _MAX_BYTES
    return is_name and not name.endswith((" ", ".")) and not _DEVICE.fullmatch(name)


def find_target(root: Path, name: str, *, example: str, suffixes: Sequence[str] = ()) -> Path:
    """Return the path of a name from the page; it is neither hidden nor behind a link out of the root.

    Args:
        root: folder to write below.
        name: path relative to the root, with slashes.
        example: example of a name, for the error message.
        suffixes: allowed suffixes; empty: any.

    Raises:
        UsageError: it leads out of the root, or has another suffix.
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
    """Refuse a path that leads out of the root by a link, leads through a file, or names another kind of file."""
    folder = target.parent
    while not os.path.lexists(folder):
        folder = folder.parent
    is_inside = Path(os.path.realpath(folder)).is_relative_to(os.path.realpath(root))
    if not is_inside or os.path.islink(target):
        raise UsageError(f"{target.relative_to(root)}: a link leads elsewhere; choose another name")
    if not folder.is_dir():
        raise UsageError(f"{target.relative_to(root)}: {folder.relative_to(root)} is no folder; choose another name")
    if os.path.exists(target) and not (os.path.isdir(target) if is_folder else os.path.isfile(target)):
        raise UsageError(
            f"{target.relative_to(root)}: this is no {'folder' if is_folder else 'file'}; choose another name"
        )


def save_files(root: Path, files: Mapping[Path, str | bytes | Path], *, replace: bool) -> str | None:
    """Write files below a root in order, each whole or not at all; return the names of existing files that may not be
    replaced, or None.

    Args:
        root: folder to write below.
        files: path → content, or a file to copy; an equal copy may exist.
        replace: True: replace existing files.

    Raises:
        UsageError: they cannot be written.
    """
    for file in files:
        _check(root, file)
    changed = {file: content for file, content in files.items() if not _is_copy(file, content)}
    existing = [] if replace else [file for file in changed if os.path.exists(file)]
    for file, content in () if existing else changed.items():
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(file, content, replace=replace)
        except FileExistsError:
            existing = [file]
            break
        except OSError as error:
            raise UsageError(f"cannot write {file.relative_to(root)}: {error.strerror}") from None
    return _names(root, existing) if existing else None


def _is_copy(file: Path, content: str | bytes | Path) -> bool:
    return isinstance(content, Path) and os.path.isfile(file) and filecmp.cmp(file, content, shallow=False)


def _names(root: Path, files: Sequence[Path]) -> str:
    names = ", ".join(file.relative_to(root).as_posix() for file in files[:_MAX_LISTED])
    return f"{names} and {len(files) - _MAX_LISTED} more" if len(files) > _MAX_LISTED else names
