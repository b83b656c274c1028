"""xacro for programs that run it themselves: Clearpath's env_run sets variables, then runs the rest of its line."""

import os
import shlex
import sys
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

XACRO = ("xacro", "xacro.py")
"""Names of the program."""


@contextmanager
def provide_xacro(argv: Sequence[str], env: Mapping[str, str]) -> Generator[tuple[list[str], dict[str, str]]]:
    """Yield a command and its environment in which ours is the xacro that is named and not installed.

    Args:
        argv: a program and what it is told; xacro may be among the latter by a path that leads nowhere.
        env: PATH gets ours behind all else, so that one that is installed goes first.
    """
    if os.name != "posix":
        yield list(argv), dict(env)
        return
    with TemporaryDirectory(prefix="trundle-xacro-") as folder:
        for name in XACRO:
            program = Path(folder, name)
            program.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -P -m trundle xacro "$@"\n')
            program.chmod(0o755)
        words = [str(Path(folder, PurePath(word).name)) if _is_missing(word) else word for word in argv[1:]]
        path = os.pathsep.join([env.get("PATH", os.defpath), folder])
        yield [argv[0], *words], {**env, "PATH": path}


def _is_missing(word: str) -> bool:
    return "/" in word and PurePath(word).name in XACRO and not os.path.exists(word)
