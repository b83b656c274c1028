"""Writing an upload's files below a folder, with limits of their names, number and size."""

from pathlib import Path
from typing import BinaryIO

from trundle.base.diagnostics import UsageError
from trundle.base.output_folder import is_portable

MAX_FILES = 2000
MAX_BYTES = 512 * 1024 * 1024
"""Limit of one upload's unpacked size."""
_MAX_DEPTH = 16
_MAX_SHOWN = 80


class UploadTree:
    """Folder of one upload's files."""

    def __init__(self, root: Path, *, max_bytes: int = MAX_BYTES) -> None:
        """Create it for an empty folder; at most `max_bytes` are written."""
        self.root = root
        self._remaining_bytes = min(max_bytes, MAX_BYTES)
        self._names: set[str] = set()

    def create(self, name: str) -> BinaryIO | None:
        """Create the file of a relative path with slashes; None: it is hidden and ignored.

        Raises:
            UsageError: the path is absolute, leads out of the folder, or is invalid on some system.
            OSError: the file cannot be created.
        """
        parts = [part for part in name.split("/") if part != "."]
        if not 0 < len(parts) <= _MAX_DEPTH or not all(map(is_portable, parts)):
            raise UsageError(f"{name[:_MAX_SHOWN]!r} is not a valid path in a model's folder")
        if any(part.startswith(".") or part == "__MACOSX" for part in parts):
            return None
        if len(self._names) >= MAX_FILES:
            raise UsageError(f"it has more than {MAX_FILES} files")
        if (folded := "/".join(parts).casefold()) in self._names:
            raise UsageError(f"{name[:_MAX_SHOWN]!r} is a duplicate file name")
        self._names.add(folded)
        path = self.root.joinpath(*parts)
        path.parent.mkdir(parents=True, exist_ok=True)
        return path.open("xb")

    def write(self, file: BinaryIO, content: bytes) -> None:
        """Append to a file.

        Raises:
            UsageError: the upload is too large.
            OSError: the file cannot be written.
        """
        self._remaining_bytes -= len(content)
        if self._remaining_bytes < 0:
            raise UsageError(f"it is too large: a model has at most {MAX_BYTES // 2**20} MiB, all of a run 2 GiB")
        file.write(content)
