"""Below which folders a file has to lie, whatever dots or links its path goes through."""

from collections.abc import Iterable
from pathlib import Path


class Confinement:
    """A set of folders."""

    def __init__(self, folders: Iterable[Path]) -> None:
        self._folders = {folder.resolve() for folder in folders}

    def allows(self, path: Path) -> bool:
        """Whether a file, or what it links to, is in one of the folders or below."""
        real = path.resolve()
        return real in self._folders or not self._folders.isdisjoint(real.parents)
