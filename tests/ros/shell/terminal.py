"""Programs in a pseudo-terminal."""

import os
import pty
import select
import signal
import subprocess
import termios
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

import psutil
from tests.graphs import PATIENCE_S

_COLUMNS, _ROWS = 200, 50


class Terminal:
    """Types into a program and waits for its output."""

    def __init__(self, command: Sequence[str], env: Mapping[str, str], cwd: Path) -> None:
        self._screen, slave = pty.openpty()
        termios.tcsetwinsize(slave, (_ROWS, _COLUMNS))
        self.process = subprocess.Popen(
            command,
            env=dict(env),
            cwd=cwd,
            stdin=slave,
            stdout=slave,
            stderr=slave,
            start_new_session=True,
            preexec_fn=_set_controlling_terminal,
        )
        os.close(slave)
        self.printed = ""
        self._position = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Close the terminal, as closing its window does."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGHUP)
            try:
                self.process.wait(20.0)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        os.close(self._screen)

    def keys(self, text: str) -> None:
        """Press keys."""
        os.write(self._screen, text.encode())

    def type(self, line: str) -> None:
        """Type a line, and Enter."""
        self.keys(f"{line}\n")

    def expect(self, text: str, patience_s: float = PATIENCE_S) -> str:
        """Wait for a text after the last expected one, and return the output up to its end."""
        due = time.monotonic() + patience_s
        while (start := self.printed.find(text, self._position)) < 0:
            assert time.monotonic() < due, f"{text!r} does not appear:\n{self.printed}"
            self._read(0.2)
        output = self.printed[self._position : start + len(text)]
        self._position = start + len(text)
        return output

    def expect_program(self, name: str) -> None:
        """Wait until a program is in the foreground, which Ctrl-C reaches."""
        due = time.monotonic() + PATIENCE_S
        while not self._is_in_foreground(name):
            assert time.monotonic() < due, f"{name} does not start:\n{self.printed}"
            self._read(0.1)

    def _is_in_foreground(self, name: str) -> bool:
        try:
            return psutil.Process(os.tcgetpgrp(self._screen)).name() == name
        except psutil.NoSuchProcess:
            return False

    def wait(self) -> int:
        """Wait for the end of the program; return its exit code."""
        due = time.monotonic() + PATIENCE_S
        while self.process.poll() is None:
            assert time.monotonic() < due, f"the program does not end:\n{self.printed}"
            self._read(0.2)
        self._read(0.0)
        return self.process.returncode

    def _read(self, timeout_s: float) -> None:
        if select.select([self._screen], [], [], timeout_s)[0]:
            try:
                self.printed += os.read(self._screen, 65536).decode(errors="replace")
            except OSError:  # the other end is closed
                time.sleep(timeout_s)


def _set_controlling_terminal() -> None:
    """Make standard input the session's terminal, so that Ctrl-C reaches it."""
    import fcntl

    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
