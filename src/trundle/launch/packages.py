"""What reading a launch file needs to know about packages."""

from pathlib import Path
from typing import Protocol


class PackageFinder(Protocol):
    """Knows where packages live."""

    def find_folder(self, name: str, /) -> Path | None:
        """Return what `$(find name)` stands for, or None."""
        ...

    def why_not_found(self, name: str, /) -> str:
        """Say in a sentence that there is no such package, and where it was looked for."""
        ...
