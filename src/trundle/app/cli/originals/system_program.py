"""Programs of the machine with the same name as a command of `trundle shell`."""

import os
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from trundle.base.diagnostics import UsageError


def find_system_program(program: str) -> str | None:
    """Return the path of the machine's program; None if there is none."""
    folders = os.environ.get("PATH", os.defpath).split(os.pathsep)
    rest = os.pathsep.join(folder for folder in folders if not _is_shell_folder(Path(folder or ".")))
    return shutil.which(program, path=rest)


def run_system_program(program: str, words: Sequence[str]) -> int:
    """Replace this process by the machine's program.

    Raises:
        UsageError: there is none.
    """
    path = find_system_program(program)
    if path is None:
        raise UsageError(f"this machine has no {program}; only packages of ROS are installed here")
    sys.stdout.flush()
    os.execv(path, [program, *words])


def _is_shell_folder(folder: Path) -> bool:
    """True for the folder of commands of `trundle shell`."""
    return folder.name == "bin" and folder.parent.name.startswith("trundle-shell-")
