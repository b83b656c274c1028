"""Progress of a job: one line that changes on a terminal, a line now and then in a log."""

import sys
import time

_REDRAW_S = 0.2
_LOG_S = 30.0


class Progress:
    """Prints the number of rows, their rate and the remaining time to stderr."""

    def __init__(self, total: int, done: int, *, what: str = "runs") -> None:
        """Start the display.

        Args:
            total: rows of the job.
            done: rows that are done already.
            what: name of the rows, in the plural.
        """
        self._what = what
        self._total, self._initial, self._done = total, done, done
        self._failed = 0
        self._started_s = time.monotonic()
        self._stream = sys.stderr
        self._on_terminal = self._stream is not None and self._stream.isatty()
        self._shown_s = self._started_s
        self._width = 0

    def add(self, *, is_ok: bool) -> None:
        """Count a row."""
        self._done += 1
        self._failed += not is_ok

    @property
    def remaining(self) -> int:
        """Number of remaining rows."""
        return self._total - self._done

    @property
    def rate(self) -> float:
        """Rows per second of wall time."""
        return (self._done - self._initial) / max(time.monotonic() - self._started_s, 1e-9)

    def show(self) -> None:
        """Redraw the line, or print one to a log, if it is due."""
        now_s = time.monotonic()
        if self._stream is None or now_s - self._shown_s < (_REDRAW_S if self._on_terminal else _LOG_S):
            return
        self._shown_s = now_s
        text = f"{self._done} of {self._total} {self._what}, {self._failed} not ok"
        if self._done > self._initial:
            left_s = self.remaining / self.rate
            text += f", {self.rate:.3g} a second, about {_format_duration(left_s)} left"
        if self._on_terminal:
            self._stream.write(f"\r{text:<{self._width}}")
            self._stream.flush()
            self._width = len(text)
        else:
            print(text, file=self._stream, flush=True)

    def close(self) -> None:
        """Clear the line on a terminal."""
        if self._width:
            self._stream.write(f"\r{'':<{self._width}}\r")
            self._stream.flush()
            self._width = 0


def _format_duration(seconds: float) -> str:
    if seconds < 100:
        return f"{max(round(seconds), 1)} s"
    return f"{round(seconds / 60)} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
