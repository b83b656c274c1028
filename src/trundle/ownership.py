"""Whose a folder is, on a machine with several users."""

import os
from collections.abc import Mapping
from pathlib import Path


def is_owned_by_user(folder: Path) -> bool:
    """Tell whether a folder is this user's, and no other user but root can put something else in its place.

    As OpenSSH looks at ~/.ssh: each folder above is ours or the system's, and not writable by all, unless it is sticky
    as /tmp. Windows keeps a profile's folders apart by itself.
    """
    if not hasattr(os, "geteuid"):
        return True
    try:
        folder = folder.resolve(strict=True)
        if folder.stat().st_uid != os.geteuid():
            return False
        system = {0, os.geteuid(), Path("/").stat().st_uid}
        return all(_is_protected(above, system) for above in (folder, *folder.parents))
    except (OSError, RuntimeError):
        return False


def _is_protected(folder: Path, owners: set[int]) -> bool:
    found = folder.stat()
    return found.st_uid in owners and (not found.st_mode & 0o002 or bool(found.st_mode & 0o1000))


def home_folder(environment: Mapping[str, str]) -> Path:
    """This user's home: by HOME, else as the system has it; never a folder that all can write to."""
    home = environment.get("HOME") or os.path.expanduser("~")
    return Path(home if os.path.isabs(home) else os.devnull)
