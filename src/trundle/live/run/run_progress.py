"""Progress of a run without a page, for a person at a terminal."""

import time
from collections.abc import Callable

from trundle.spatial import NS_PER_S

_EVERY_S = 5.0


class RunProgress:
    """Prints a line every few seconds."""

    def __init__(
        self, say: Callable[[str], None], *, end_ns: int | None, now: Callable[[], float] = time.monotonic
    ) -> None:
        """Start counting; `end_ns` is the end of the run in simulation time [ns], if it has one."""
        self._say, self._end_ns, self._now = say, end_ns, now
        self._last: tuple[float, int] | None = None
        """Wall time [s] and simulation time [ns] of the last line."""

    def update(self, time_ns: int) -> None:
        """Print the simulation time [ns] and the speed since the last line, if one is due."""
        wall = self._now()
        if self._last is None or time_ns < self._last[1]:
            self._last = (wall, time_ns)
        elapsed = wall - self._last[0]
        if elapsed < _EVERY_S:
            return
        of = "" if self._end_ns is None else f" of {self._end_ns / NS_PER_S:g}"
        speed = (time_ns - self._last[1]) / NS_PER_S / elapsed
        self._say(f"{time_ns / NS_PER_S:.1f}{of} s simulated, {speed:.3g} times real time; Ctrl-C ends it")
        self._last = (wall, time_ns)
