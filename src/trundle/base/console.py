"""Console output of a run: lines on stderr, and each finding once."""

import os
import sys
from collections.abc import Callable
from typing import TextIO

from trundle.base.diagnostics import Diagnostics, colored


def say(text: str, stream: TextIO | None = None) -> None:
    """Print a line, by default on stdout; discard it if the pipe has no reader, so that the run ends cleanly."""
    output: TextIO = stream or sys.stdout
    try:
        print(text, file=output, flush=True)
    except BrokenPipeError:  # `trundle launch … | tee log`: Ctrl-C ends tee too
        os.dup2(os.open(os.devnull, os.O_WRONLY), output.fileno())


class Console:
    """Prints lines and findings on one stream; stdout stays free for results."""

    def __init__(self, stream: TextIO, report: Diagnostics, *, quiet: bool = False) -> None:
        """Take a stream and findings.

        Args:
            stream: where lines are printed.
            report: its findings are printed by `findings`.
            quiet: whether notes are omitted.
        """
        self._stream = stream
        self._quiet = quiet
        self._report = report
        self._shown = 0
        self._log: Callable[[str], None] | None = None

    def log_to(self, log: Callable[[str], None]) -> None:
        """Also pass all further lines, and the findings printed so far, to a function."""
        self._log = log
        for finding in self._report.findings[: self._shown]:
            log(str(finding))

    def line(self, text: str) -> None:
        """Print one line."""
        say(colored(text, self._stream), self._stream)
        if self._log is not None:
            self._log(text)

    def note(self, text: str) -> None:
        """Print one line about what goes well, unless the console is quiet."""
        if not self._quiet:
            self.line(text)

    def findings(self) -> None:
        """Print the findings since the last call, except notes, which only `trundle check` prints."""
        new = self._report.findings[self._shown :]
        self._shown = len(self._report.findings)
        for finding in new:
            if finding.severity != "info":
                self.line(str(finding))
