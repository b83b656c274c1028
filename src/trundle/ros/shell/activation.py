"""Folder of commands, and the text that puts it first on PATH, with completion."""

import shlex
import sys
import sysconfig
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from tempfile import mkdtemp

from argcomplete.shell_integration import shellcode

from trundle.base.atomic_write import write_atomically

_FISH = "fish"


def write_activation(
    names: Iterable[str], *, functions: Iterable[str], python_path: Path, libraries: str, gazebo: Path
) -> Path:
    """Make a temporary folder with a command for each name, and the files that shells source.

    Args:
        names: commands that `trundle --as` runs.
        functions: commands that the shell runs itself, since they change its working directory.
        python_path: folder for PYTHONPATH, with ROS' Python packages.
        libraries: value of TRUNDLE_LIBRARIES, for other Pythons of this version.
        gazebo: folder in which CMake finds Gazebo's package.

    Returns:
        The folder; the caller or the shell's function `trundle_deactivate` removes it.
    """
    folder = Path(mkdtemp(prefix="trundle-shell-"))
    commands = folder / "bin"
    commands.mkdir()
    program = shlex.join(launcher())
    for name in (*names, "trundle"):
        file = commands / name
        option = "" if name == "trundle" else f" --as {name}"
        write_atomically(file, f'#!/bin/sh\nexec {program}{option} "$@"\n')
        file.chmod(0o755)
    completed = [*names, "trundle"]
    values = {
        "@FOLDER@": shlex.quote(str(folder)),
        "@SITE@": shlex.quote(str(python_path)),
        "@LIBRARIES@": shlex.quote(libraries),
        "@PYTHON@": shlex.quote(sys.executable),
        "@GAZEBO@": shlex.quote(str(gazebo)),
        "@NAMES@": shlex.join([*completed, *functions]),
    }
    for name, shell in (("activate.sh", "bash"), ("activate.fish", _FISH)):
        text = _filled(Path(__file__).with_name(name).read_text(encoding="utf-8"), values)
        write_atomically(folder / name, f"{text}\n{_completion(completed, shell)}")
    return folder


def _filled(text: str, values: Mapping[str, str]) -> str:
    for variable, value in values.items():
        text = text.replace(variable, value)
    return text


def _completion(names: Sequence[str], shell: str) -> str:
    """Return the shell code that asks a command for completions; zsh uses bash's."""
    code = shellcode(list(names), shell=shell)
    if shell == _FISH:
        return code
    return f'if [ -n "${{BASH_VERSION-}}${{ZSH_VERSION-}}" ]; then\neval {shlex.quote(code)}\nfi\n'


def launcher() -> list[str]:
    """Return the command that starts this Trundle."""
    installed = Path(sysconfig.get_path("scripts"), "trundle")
    return [str(installed)] if installed.is_file() else [sys.executable, "-P", "-m", "trundle"]
