"""Below which folders a file has to lie, whatever dots or links its path goes through."""

import os
from collections.abc import Iterable
from pathlib import Path


class Confinement:
    """A set of folders."""

    def __init__(self, folders: Iterable[Path]) -> None:
        self._folders = {os.path.realpath(folder) for folder in folders}

    def allows(self, path: Path) -> bool:
        """Whether a file, or what it links to, is in one of the folders or below."""
        inner, real = "", os.path.realpath(path)
        while real not in self._folders and real != inner:
            inner, real = real, os.path.dirname(real)
        return real != inner
