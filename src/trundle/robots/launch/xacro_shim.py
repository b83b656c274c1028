"""xacro on PATH for commands that run it, such as Clearpath's env_run, which sets variables and runs its arguments."""

import os
import shlex
import sys
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

from trundle.base.atomic_write import write_atomically

XACRO = ("xacro", "xacro.py")
"""Names of the executable."""


@contextmanager
def provide_xacro(argv: Sequence[str], env: Mapping[str, str]) -> Generator[tuple[list[str], dict[str, str]]]:
    """Yield a command and its environment, with Trundle's xacro in place of a missing one.

    Args:
        argv: program and arguments; paths to a missing xacro are replaced.
        env: environment; its PATH is extended at the end, so that an installed xacro takes precedence.
    """
    if os.name != "posix":
        yield list(argv), dict(env)
        return
    with TemporaryDirectory(prefix="trundle-xacro-") as folder:
        for name in XACRO:
            program = Path(folder, name)
            write_atomically(program, f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -P -m trundle xacro "$@"\n')
            program.chmod(0o755)
        words = [str(Path(folder, PurePath(word).name)) if _is_missing(word) else word for word in argv[1:]]
        path = os.pathsep.join([env.get("PATH", os.defpath), folder])
        yield [argv[0], *words], {**env, "PATH": path}


def _is_missing(word: str) -> bool:
    return "/" in word and PurePath(word).name in XACRO and not os.path.exists(word)
