"""Progress of the decomposition: one line on a terminal, two in a log."""

import sys
import time
from collections.abc import Sequence

_QUICK_S = 2.0
"""Shortest work shown on a terminal [s]."""
_LONG_S = 5.0
"""Shortest work shown in a log [s]."""


class DecompositionProgress:
    """Prints the number of decomposed meshes and the time left to stderr."""

    def __init__(self, seconds: Sequence[float], processes: int, *, redraws: bool = True) -> None:
        """Start the display.

        Args:
            seconds: estimated time of each part [s].
            processes: number of workers.
            redraws: False: print lines, also on a terminal.
        """
        self._count, self._finished = len(seconds), 0
        self._work, self._worked = sum(seconds), 0.0
        self._expected_s = self._work / processes
        self._started_s = time.monotonic()
        self._stream = sys.stderr
        self._on_terminal = redraws and self._stream is not None and self._stream.isatty()
        self._width = 0
        self._in_log = self._stream is not None and not self._on_terminal and self._expected_s > _LONG_S
        if self._in_log:
            text = f"cutting {self._count} hollow meshes into convex pieces, about {_format_duration(self._expected_s)}"
            self._log(f"{text}; cached for later runs")
        self.show()

    def done(self, seconds: float) -> None:
        """Count one part of an estimated time [s]."""
        self._finished += 1
        self._worked += seconds
        self.show()

    @property
    def left_s(self) -> float:
        """Estimated time left [s], from the speed so far."""
        passed = time.monotonic() - self._started_s
        if not self._finished:
            return max(self._expected_s - passed, 0.0)
        return passed / self._worked * (self._work - self._worked)

    def show(self) -> None:
        """Redraw the line."""
        if self._on_terminal and self._expected_s > _QUICK_S:
            text = f"cutting meshes: {self._finished} of {self._count}, about {_format_duration(self.left_s)} left"
            self._stream.write(f"\r{text:<{self._width}}")
            self._stream.flush()
            self._width = len(text)

    def close(self) -> None:
        """Clear the line on a terminal; print the result to a log."""
        if self._width:
            self._stream.write(f"\r{'':<{self._width}}\r")
            self._stream.flush()
            self._width = 0
        if self._in_log:
            passed = _format_duration(time.monotonic() - self._started_s)
            self._log(f"cut {self._finished} of {self._count} hollow meshes in {passed}")

    def _log(self, text: str) -> None:
        print(text, file=self._stream, flush=True)


def _format_duration(seconds: float) -> str:
    return f"{max(round(seconds), 1)} s" if seconds < 100 else f"{round(seconds / 60)} min"
