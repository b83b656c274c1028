"""Runs a shell in which the commands come first on PATH; removes its temporary files at the end."""

import os
import shlex
import shutil
import signal
import subprocess
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TypeAlias

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError

from .activation import write_activation

_SUPPORTED = ("bash", "zsh", "fish")
Environment: TypeAlias = Mapping[str, str]


def run_shell(
    names: Iterable[str],
    *,
    functions: Iterable[str],
    python_path: Path,
    libraries: str,
    gazebo: Path,
    command: str | None,
    environment: Environment,
) -> int:
    """Run the user's shell, or one command in it, and return its exit code.

    Args:
        names: commands to provide.
        functions: commands that the shell runs itself.
        python_path: folder for PYTHONPATH, with ROS' Python packages.
        libraries: value of TRUNDLE_LIBRARIES, for other Pythons of this version.
        gazebo: folder in which CMake finds Gazebo's package.
        command: text to run; None: an interactive shell.
        environment: variables of the shell; SHELL names it.

    Raises:
        UsageError: there is no shell.
    """
    shell = find_shell(environment)
    folder = write_activation(names, functions=functions, python_path=python_path, libraries=libraries, gazebo=gazebo)
    try:
        arguments, variables = _start(shell, folder, command)
        with _forwarded_signals() as start:
            process = start([*arguments], {**environment, **variables})
            code = process.wait()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return code if code >= 0 else 128 - code


def find_shell(environment: Environment) -> str:
    """Return the user's shell, if it is bash, zsh or fish; else bash or sh.

    Raises:
        UsageError: there is none.
    """
    if os.name != "posix":
        raise UsageError("trundle shell needs bash, zsh or fish; on Windows, install Trundle in WSL")
    user_shell = environment.get("SHELL", "")
    path = environment.get("PATH", os.defpath)
    candidates = [user_shell] if os.path.basename(user_shell) in _SUPPORTED else []
    for name in (*candidates, "bash", "sh"):
        if (shell := shutil.which(name, path=path)) is not None:
            return shell
    raise UsageError("no shell is found; set SHELL to the path of bash, zsh or fish")


def _start(shell: str, folder: Path, command: str | None) -> tuple[list[str], dict[str, str]]:
    """Return the command that starts a shell, and its variables; the user's start files are read first."""
    kind = os.path.basename(shell)
    script = folder / ("activate.fish" if kind == "fish" else "activate.sh")
    sourced = f". {shlex.quote(str(script))}"
    if command is not None:
        return [shell, "-c", f"{sourced}\n{command}"], {}
    match kind:
        case "bash":
            start = folder / "bashrc"
            write_atomically(start, f"[ -f ~/.bashrc ] && . ~/.bashrc\n{sourced}\n")
            return [shell, "--rcfile", str(start), "-i"], {}
        case "zsh":
            _write_zsh_files(folder, sourced)
            return [shell, "-i"], {"ZDOTDIR": str(folder), "_TRUNDLE_ZDOTDIR": os.environ.get("ZDOTDIR", "")}
        case "fish":
            return [shell, "-i", "-C", f"source {shlex.quote(str(script))}"], {}
        case _:
            return [shell, "-i"], {"ENV": str(script)}


def _write_zsh_files(folder: Path, sourced: str) -> None:
    """Write start files that read the user's, from ZDOTDIR or the home folder."""
    home = "${_TRUNDLE_ZDOTDIR:-$HOME}"
    write_atomically(folder / ".zshenv", f"[ -f {home}/.zshenv ] && . {home}/.zshenv\n")
    restore = 'if [ -n "$_TRUNDLE_ZDOTDIR" ]; then ZDOTDIR="$_TRUNDLE_ZDOTDIR"; else unset ZDOTDIR; fi\n'
    compinit = "(( $+functions[compdef] )) || { autoload -Uz compinit && compinit -D }\n"
    text = f"[ -f {home}/.zshrc ] && . {home}/.zshrc\n{compinit}{sourced}\n{restore}unset _TRUNDLE_ZDOTDIR\n"
    write_atomically(folder / ".zshrc", text)


def _ignore(_number: int, _frame: object) -> None:
    """Leave a signal of the keyboard to the shell."""


@contextmanager
def _forwarded_signals() -> Generator[Callable[[list[str], Environment], subprocess.Popen[bytes]]]:
    """Yield a function that starts a shell; forward SIGTERM and SIGHUP to it, and leave Ctrl-C to it alone."""
    started: list[subprocess.Popen[bytes]] = []

    def forward(number: int, _: object) -> None:
        for process in started:
            process.send_signal(number)

    def start(arguments: list[str], environment: Environment) -> subprocess.Popen[bytes]:
        started.append(subprocess.Popen(arguments, env=dict(environment)))
        return started[0]

    previous = {number: signal.signal(number, forward) for number in (signal.SIGTERM, signal.SIGHUP)}
    # A handler, and not SIG_IGN, which the shell would inherit.
    previous |= {number: signal.signal(number, _ignore) for number in (signal.SIGINT, signal.SIGQUIT)}
    try:
        yield start
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
