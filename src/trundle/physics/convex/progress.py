"""How far the cutting of meshes is: a line on the terminal, or two in a log."""

import sys
import time
from collections.abc import Sequence

_QUICK_S = 2.0
"""[s] Less is not worth a word on a terminal, and"""
_LONG_S = 5.0
"""[s] in a log."""


class DecompositionProgress:
    """Tells on stderr how many meshes are cut, and how long it takes still."""

    def __init__(self, seconds: Sequence[float], processes: int) -> None:
        """Begin.

        Args:
            seconds: that each is thought to take [s].
            processes: that share them.
        """
        self._count, self._finished = len(seconds), 0
        self._work, self._worked = sum(seconds), 0.0
        self._expected_s = self._work / processes
        self._started_s = time.monotonic()
        self._stream = sys.stderr
        self._on_terminal = self._stream is not None and self._stream.isatty()
        self._width = 0
        self._in_log = self._stream is not None and not self._on_terminal and self._expected_s > _LONG_S
        if self._in_log:
            what = f"cutting {self._count} hollow meshes into convex pieces, about {_format_duration(self._expected_s)}"
            self._log(f"{what}; that is done once")
        self.show()

    def done(self, seconds: float) -> None:
        """Count one that was thought to take so long [s]."""
        self._finished += 1
        self._worked += seconds
        self.show()

    @property
    def left_s(self) -> float:
        """[s] About; by how long what is done took, once anything is."""
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
        """Leave the terminal as it was; a log has a line for the end."""
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
