"""Confinement of files to folders, with `..` and links resolved."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path


class WideFolders:
    """Folders that hold more than one robot's files: homes, their parents, roots of disks."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        """Collect the homes of an environment and of the current user."""
        homes = {environment.get("HOME", ""), environment.get("USERPROFILE", ""), os.path.expanduser("~")}
        real = [Path(os.path.realpath(home)) for home in homes if os.path.isabs(home)]
        self._folders = {str(folder) for home in real for folder in (home, *home.parents)}

    def __contains__(self, folder: object) -> bool:
        assert isinstance(folder, Path)
        return self.narrow(folder) is None

    def narrow(self, folder: Path) -> str | None:
        """Return a folder's path without links; None if it is wide."""
        try:
            real = os.path.realpath(folder)
        except OSError:  # the link was removed in the meantime, as below /proc
            return None
        return None if real in self._folders or os.path.dirname(real) == real else real


class Confinement:
    """Set of readable folders, without wide ones."""

    def __init__(self, folders: Iterable[Path], *, wide: WideFolders, visible_in: Iterable[Path] = ()) -> None:
        """Allow folders with all their content, and the visible files directly in the folders `visible_in`."""
        self._folders = {real for folder in folders if (real := wide.narrow(folder)) is not None}
        self._visible_in = {os.path.realpath(folder) for folder in visible_in}

    def allows(self, path: Path) -> bool:
        """True if a file, with links resolved, is below one of the folders."""
        try:
            inner, real = "", os.path.realpath(path)
        except ValueError:  # no file can have this name
            return False
        if os.path.dirname(real) in self._visible_in and not os.path.basename(real).startswith("."):
            return True
        while real not in self._folders and real != inner:
            inner, real = real, os.path.dirname(real)
        return real != inner
