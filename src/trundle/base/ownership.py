"""Ownership of folders on machines with several users."""

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path


def is_owned_by_user(folder: Path) -> bool:
    """True if a folder is this user's, and only root could replace it.

    As OpenSSH checks ~/.ssh: each parent folder belongs to the user or the system, and is not world-writable unless it
    is sticky, like /tmp. Windows separates profile folders itself.
    """
    if not hasattr(os, "geteuid"):
        return True
    try:
        folder = folder.resolve(strict=True)
        if folder.stat().st_uid != os.geteuid():
            return False
        system = {0, os.geteuid(), Path("/").stat().st_uid}
        return all(_is_protected(parent, system) for parent in (folder, *folder.parents))
    except (OSError, RuntimeError):
        return False


def _is_protected(folder: Path, owners: set[int]) -> bool:
    status = folder.stat()
    return status.st_uid in owners and (not status.st_mode & 0o002 or bool(status.st_mode & 0o1000))


def home_folder(environment: Mapping[str, str]) -> Path:
    """Return this user's home folder, from HOME or the system; never a world-writable folder."""
    home = environment.get("HOME") or os.path.expanduser("~")
    return Path(home if os.path.isabs(home) else os.devnull)


def write_private_file(name: str, content: bytes, environment: Mapping[str, str]) -> Path | None:
    """Write or replace a file that only this user may read; return its path, or None if it cannot be written."""
    for folder in runtime_folders(environment):
        file = folder / name
        with contextlib.suppress(OSError):
            file.unlink(missing_ok=True)
            descriptor = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(descriptor, "wb") as stream:
                stream.write(content)
            return file
    return None


def runtime_folders(environment: Mapping[str, str]) -> list[Path]:
    """Return the folders for files of running programs that only this user may enter, best first.

    They are below XDG_RUNTIME_DIR and below the folder of temporary files, and are created if missing.
    """
    import tempfile  # lazy: tempfile imports random and bz2

    user = str(os.geteuid()) if hasattr(os, "geteuid") else "user"
    folders = [Path(tempfile.gettempdir()) / f"trundle-{user}"]
    if os.path.isabs(root := environment.get("XDG_RUNTIME_DIR", "")):
        folders.insert(0, Path(root) / "trundle")
    return [folder for folder in folders if _is_private(folder)]


def _is_private(folder: Path) -> bool:
    """Create a folder if it is missing; True if only this user may enter it."""
    with contextlib.suppress(OSError):
        folder.mkdir(mode=0o700, exist_ok=True)
        mode = folder.lstat().st_mode
        return is_owned_by_user(folder) and (os.name != "posix" or not mode & 0o077)
    return False
