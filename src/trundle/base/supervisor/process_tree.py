"""Descendants of the supervisor's programs: none outlives the supervisor, even if it is killed."""

import contextlib
import os
import signal
import subprocess
import sys
import uuid
from collections.abc import Mapping
from typing import Self

from . import tree_watcher
from .windows_job import enter_job_object

_POSIX = os.name == "posix"
_KILL_S = 2.0
"""Timeout for killed processes to disappear [s]."""


class ProcessTree:
    """Programs and their descendants, identified by process group and an inherited environment variable.

    A watcher process at the other end of a pipe kills them if this process dies without closing the tree; on Windows, a
    job object does. Also a context manager.
    """

    def __init__(self, *, terminate_s: float = 2.0) -> None:
        """`terminate_s`: timeout after SIGTERM for processes left at `close` [s]."""
        self._mark = uuid.uuid4().hex
        self._terminate_s = terminate_s
        self._groups: set[int] = set()
        self._watcher: subprocess.Popen[str] | None = None

    def environment(self, env: Mapping[str, str]) -> dict[str, str]:
        """Return the environment for a program of the tree."""
        return {**env, tree_watcher.VARIABLE: self._mark}

    def watch(self) -> None:
        """Start the watcher, unless it runs; to be called before starting a program."""
        if not _POSIX:
            enter_job_object()
        elif self._watcher is None:
            env = {name: value for name, value in os.environ.items() if name != tree_watcher.VARIABLE}
            self._watcher = subprocess.Popen(
                [sys.executable, "-I", "-S", tree_watcher.__file__, self._mark],
                env=env,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                text=True,
                start_new_session=True,
            )

    def add(self, group: int) -> None:
        """Add a program that leads its process group."""
        self._groups.add(group)
        self._notify_watcher()

    def discard(self, group: int) -> None:
        """Remove an ended program, unless its group still has processes: the ID may be reused."""
        try:
            if _POSIX:
                os.killpg(group, 0)
        except (ProcessLookupError, PermissionError):
            self._groups.discard(group)
            self._notify_watcher()

    def close(self) -> None:
        """Terminate, then kill, the remaining processes."""
        if self._watcher is None:
            return
        if not tree_watcher.kill_tree(self._mark, self._groups, signal.SIGTERM, self._terminate_s):
            tree_watcher.kill_tree(self._mark, self._groups, signal.SIGKILL, _KILL_S)
        self._watcher.kill()
        self._watcher.communicate()
        self._watcher = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _notify_watcher(self) -> None:
        assert self._watcher is None or self._watcher.stdin is not None
        if self._watcher is not None and self._watcher.stdin is not None:
            with contextlib.suppress(OSError):  # the watcher was killed
                print(*self._groups, file=self._watcher.stdin, flush=True)
