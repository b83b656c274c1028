"""Package lookup needed by launch files."""

from pathlib import Path
from typing import Protocol


class PackageFinder(Protocol):
    """Finds the folders of packages."""

    def find_folder(self, name: str, /) -> Path | None:
        """Folder of a package, as in `$(find name)`; None if the package is unknown."""
        ...

    def absent_package(self, file: Path, /) -> str | None:
        """Missing package to which a missing file belongs; None if the file exists or its package does."""
        ...

    @property
    def is_lenient(self) -> bool:
        """True to leave out elements that need missing packages."""
        ...

    def not_found_message(self, name: str, /) -> str:
        """Error message for an unknown package, with the folders searched."""
        ...
