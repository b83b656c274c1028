"""Below which folders a file has to lie, whatever dots or links its path goes through."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path


class WideFolders:
    """Folders that hold more than a robot, whatever else lies in them: a home, all above one, the root of a disk."""

    def __init__(self, environment: Mapping[str, str]) -> None:
        """Take the home of an environment, and that of the user who runs this."""
        homes = {environment.get("HOME", ""), environment.get("USERPROFILE", ""), os.path.expanduser("~")}
        real = [Path(os.path.realpath(home)) for home in homes if os.path.isabs(home)]
        self._folders = {str(folder) for home in real for folder in (home, *home.parents)}

    def __contains__(self, folder: object) -> bool:
        assert isinstance(folder, Path)
        real = os.path.realpath(folder)
        return real in self._folders or os.path.dirname(real) == real


class Confinement:
    """A set of folders, none of them a wide one."""

    def __init__(self, folders: Iterable[Path], *, wide: WideFolders, beside: Iterable[Path] = ()) -> None:
        """Take folders with all that is in them; of those in `beside` only the files in sight are meant."""
        self._folders = {os.path.realpath(folder) for folder in folders if folder not in wide}
        self._beside = {os.path.realpath(folder) for folder in beside}

    def allows(self, path: Path) -> bool:
        """Whether a file, or what it links to, is in one of the folders or below."""
        try:
            inner, real = "", os.path.realpath(path)
        except ValueError:  # no file can have this name
            return False
        if os.path.dirname(real) in self._beside and not os.path.basename(real).startswith("."):
            return True
        while real not in self._folders and real != inner:
            inner, real = real, os.path.dirname(real)
        return real != inner
