"""Runs the commands of `<param command>`; xacro is expanded in this process."""

import os
import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path, PurePath
from typing import Protocol

from trundle.base.diagnostics import DescriptionError, Diagnostics

from .plan import LaunchParam, LaunchPlan, ParamCommand
from .run_command import run_command
from .values import convert_value
from .xacro_shim import XACRO, provide_xacro


class XacroExpander(Protocol):
    """Expands a xacro file."""

    def __call__(self, file: Path, arguments: Mapping[str, str], /) -> str:
        """Return the expanded XML; `arguments` are the command's `name:=value`."""
        ...


class CommandRunner(Protocol):
    """Runs a program until it exits."""

    def __call__(self, argv: Sequence[str], /, *, env: Mapping[str, str]) -> str:
        """Return its standard output.

        Raises:
            ValueError: the program cannot be run, or failed, with the reason.
        """
        ...


def resolve_params(
    plan: LaunchPlan,
    report: Diagnostics,
    *,
    expand_xacro: XacroExpander,
    env: Mapping[str, str],
    run: CommandRunner = run_command,
) -> tuple[LaunchParam, ...]:
    """Replace commands in the plan's parameters by their output; null values, which ROS cannot store, are reported.

    Args:
        expand_xacro: replaces commands named `xacro` or `xacro.py` in any folder, which machines without ROS lack;
            Noetic removed `xacro.py`.
        env: environment of the commands.
        run: function that runs all other commands.

    Raises:
        DescriptionError: a command failed; the source is its `<param>`. roslaunch aborts the launch too.
    """
    resolved: list[LaunchParam] = []
    for param in plan.params:
        value = param.value
        if isinstance(value, ParamCommand):
            try:
                value = convert_value(_output(value, expand_xacro, env, run), value.type)
            except ValueError as error:
                raise DescriptionError(param.at, f"param {param.name!r}: {error}", "param-command") from None
        if value is None:
            report.warn(
                param.at,
                f"parameter {param.name!r} is null, which ROS parameters cannot be; it is not set",
                "launch-param",
            )
        resolved.append(replace(param, value=value))
    return tuple(resolved)


def _output(command: ParamCommand, expand_xacro: XacroExpander, env: Mapping[str, str], run: CommandRunner) -> str:
    argv = _split(command.line)
    if not argv:
        raise ValueError("its command is empty")
    rest = _xacro_arguments(argv)
    if rest is None:
        with provide_xacro(argv, env) as (words, variables):
            return run(words, env=variables)
    words = [word for word in rest if not word.startswith("-")]
    arguments = dict(word.split(":=", 1) for word in words if ":=" in word)
    files = [word for word in words if ":=" not in word]
    if len(files) != 1:
        raise ValueError(f"xacro wants one file, got {len(files)}: {command.line!r}")
    return expand_xacro(Path(files[0]), arguments)


def _xacro_arguments(argv: Sequence[str]) -> Sequence[str] | None:
    """Arguments of a xacro command; None for other commands."""
    if argv[0] == "rosrun" and len(argv) >= 3 and argv[1] == "xacro":
        return argv[3:]
    return argv[1:] if PurePath(argv[0].replace("\\", "/")).name in XACRO else None


def _split(line: str) -> list[str]:
    """Split like a shell; on Windows, keep backslashes and strip quotes."""
    try:
        if os.name != "nt":
            return shlex.split(line)
        words = shlex.split(line, posix=False)
    except ValueError as error:
        raise ValueError(f"command {line!r} cannot be split into words: {error}") from None
    bare = [w[1:-1] if len(w) > 1 and w[0] == w[-1] and w[0] in "'\"" else w for w in words]
    return [sys.executable, *bare] if bare and bare[0].endswith(".py") and os.path.isfile(bare[0]) else bare
