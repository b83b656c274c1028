"""What a run tells its user while it goes: lines on stderr, each finding once."""

from typing import TextIO

from trundle.diagnostics import Diagnostics


class Showing:
    """Writes to one stream; stdout stays free for results."""

    def __init__(self, stream: TextIO, report: Diagnostics) -> None:
        self._stream = stream
        self._report = report
        self._shown = 0

    def line(self, text: str) -> None:
        """Say one thing."""
        print(text, file=self._stream, flush=True)

    def findings(self) -> None:
        """Say what was found since the last call; notes are `trundle check`'s affair."""
        new = self._report.findings[self._shown :]
        self._shown = len(self._report.findings)
        for finding in new:
            if finding.severity != "info":
                self.line(str(finding))
