"""Console output of a run: lines on stderr, each finding once."""

import os
import sys
from collections.abc import Callable
from typing import TextIO

from trundle.base.diagnostics import Diagnostics, coloured


def say(text: str, stream: TextIO | None = None) -> None:
    """Print a line, by default on stdout; discard it if the pipe has no reader, so that the run ends cleanly."""
    there: TextIO = stream or sys.stdout
    try:
        print(text, file=there, flush=True)
    except BrokenPipeError:  # `trundle launch … | tee log`, whose tee Ctrl-C reaches too
        os.dup2(os.open(os.devnull, os.O_WRONLY), there.fileno())


class Console:
    """Writes to one stream; stdout stays free for results."""

    def __init__(self, stream: TextIO, report: Diagnostics) -> None:
        self._stream = stream
        self._report = report
        self._shown = 0
        self._log: Callable[[str], None] | None = None

    def log_to(self, log: Callable[[str], None]) -> None:
        """Pass all further lines, and the findings shown so far, to a function too."""
        self._log = log
        for finding in self._report.findings[: self._shown]:
            log(str(finding))

    def line(self, text: str) -> None:
        """Print one line."""
        say(coloured(text, self._stream), self._stream)
        if self._log is not None:
            self._log(text)

    def findings(self) -> None:
        """Print the findings since the last call; notes are left to `trundle check`."""
        new = self._report.findings[self._shown :]
        self._shown = len(self._report.findings)
        for finding in new:
            if finding.severity != "info":
                self.line(str(finding))
