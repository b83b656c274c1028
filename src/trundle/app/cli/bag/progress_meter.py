"""Progress line, as rosbag prints it."""

import shutil
import time

from trundle.ros import byte_text

_EVERY_S = 1.0
_BESIDE_PATH = 37
"""Columns besides the path."""


class ProgressMeter:
    """Prints progress and remaining time on one line."""

    def __init__(self, path: str, total: int, *, is_quiet: bool = False) -> None:
        """Start; `total` [bytes]."""
        self._path = path
        self._total = total
        self._is_quiet = is_quiet
        self._done = 0
        self._start_s = self._printed_s = time.monotonic()
        self._print(0)

    def step(self, size: int) -> None:
        """Add processed bytes."""
        self._done += size
        if time.monotonic() - self._printed_s > _EVERY_S:
            self._print(self._done)

    def finish(self) -> None:
        """Print 100% and a newline."""
        self._print(max(self._done, self._total))
        if not self._is_quiet:
            print()

    def _print(self, done: int) -> None:
        self._printed_s = time.monotonic()
        if not self._is_quiet:
            print(f"\r {self._line(done, self._printed_s - self._start_s)}", end="", flush=True)

    def _line(self, done: int, elapsed_s: float) -> str:
        width = max(4, shutil.get_terminal_size().columns - _BESIDE_PATH)
        path = self._path if len(self._path) <= width else f"...{self._path[3 - width :]}"
        total = byte_text(self._total)
        if done >= self._total:
            return f"{path:<{width}} 100% {total:>19} {_clock(elapsed_s)}    "
        left = _clock(elapsed_s * (self._total / done - 1.0)) if done else "--:--"
        return f"{path:<{width}} {100 * done // self._total:3}% {byte_text(done):>8} / {total:>8} {left} ETA"


def _clock(seconds: float) -> str:
    minutes = int(seconds / 60)
    return "--:--" if minutes > 99 else f"{minutes:02}:{int(seconds % 60):02}"
