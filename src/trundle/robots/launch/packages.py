"""Package lookup needed by launch files."""

from pathlib import Path
from typing import Protocol


class PackageFinder(Protocol):
    """Finds the folders of packages."""

    def find_folder(self, name: str, /) -> Path | None:
        """Folder that `$(find name)` stands for; None if the package is unknown."""
        ...

    def absent_package(self, file: Path, /) -> str | None:
        """Package whose absence is why a file below a `find_folder` is missing; None: another reason, or it is here."""
        ...

    @property
    def is_lenient(self) -> bool:
        """True if elements that need missing packages are left out."""
        ...

    def why_not_found(self, name: str, /) -> str:
        """Error message for an unknown package, with the folders searched."""
        ...
