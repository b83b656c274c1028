"""Files of a launch: launch files, and files named by their attributes."""

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from trundle.base import files
from trundle.base.diagnostics import Source
from trundle.base.xmlnode import ReadBudget


class ReadCheck(Protocol):
    """Check that refuses files outside the allowed folders."""

    def __call__(self, path: Path, at: Source, /, *, name: str) -> None:
        """Check a file; `name` is its name in messages.

        Raises:
            DescriptionError: the file may not be read.
        """
        ...


@dataclass(frozen=True, slots=True)
class LaunchFiles:
    """Files of one launch."""

    check_readable: ReadCheck | None = None
    """None: every file may be read."""
    budget: ReadBudget = field(default_factory=ReadBudget)

    def check(self, name: str, at: Source) -> None:
        """Check a file before its existence is tested.

        Raises:
            DescriptionError: the file may not be read.
        """
        if self.check_readable is not None:
            self.check_readable(Path(name), at, name=repr(name))

    def read(self, name: str, at: Source) -> bytes:
        """Read a file's bytes.

        Raises:
            DescriptionError: the file may not be read.
            ValueError: the file does not exist or cannot be read.
        """
        self.check(name, at)
        if not os.path.exists(name):
            raise ValueError(f"no file {name!r}")
        try:
            data = files.read_file(name)
        except OSError as error:
            raise ValueError(f"{name!r} cannot be read: {error.strerror}") from None
        self.budget.add_file(name, len(data), at)
        return data
