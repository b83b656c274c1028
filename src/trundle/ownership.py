"""Ownership of folders on machines with several users."""

import os
from collections.abc import Mapping
from pathlib import Path


def is_owned_by_user(folder: Path) -> bool:
    """True if a folder is this user's, and only root could replace it.

    As OpenSSH checks ~/.ssh: each parent folder is ours or the system's, and not world-writable, unless it is sticky,
    as /tmp. Windows separates profile folders by itself.
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
    """Return this user's home folder, from HOME or the system; never a world-writable folder."""
    home = environment.get("HOME") or os.path.expanduser("~")
    return Path(home if os.path.isabs(home) else os.devnull)
