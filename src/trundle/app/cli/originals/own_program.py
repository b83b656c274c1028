"""Programs of the machine whose names are also commands of `trundle shell`."""

import os
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from trundle.base.diagnostics import UsageError


def find_own(program: str) -> str | None:
    """Return the path of the machine's own program, if it has one."""
    folders = os.environ.get("PATH", os.defpath).split(os.pathsep)
    rest = os.pathsep.join(folder for folder in folders if not _is_ours(Path(folder or ".")))
    return shutil.which(program, path=rest)


def run_own(program: str, words: Sequence[str]) -> int:
    """Become the machine's own program.

    Raises:
        UsageError: it has none.
    """
    found = find_own(program)
    if found is None:
        raise UsageError(f"this machine has no {program}; only packages of ROS are installed here")
    sys.stdout.flush()
    os.execv(found, [program, *words])


def _is_ours(folder: Path) -> bool:
    """True for the folder of commands of `trundle shell`."""
    return folder.name == "bin" and folder.parent.name.startswith("trundle-shell-")
