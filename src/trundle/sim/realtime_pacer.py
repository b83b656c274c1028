"""Pacing of simulation time by the wall clock, or flat out.

The rest of the simulator never reads the wall clock.
"""

import sys
import time
from collections import deque
from collections.abc import Callable

from trundle.spatial import NS_PER_S

_STRIDE_WALL_NS = 20_000_000
"""Stride between two checks for requests, in wall time [ns]."""
STRIDE_FLAT_OUT_NS = 50_000_000
"""Stride of a flat-out run, in simulation time [ns]: fixed, so that runs repeat."""
_LONGEST_STRIDE_NS = 1_000_000_000
"""Longest stride at a speed that the simulation may not reach, in simulation time [ns]."""
_LONGEST_SLEEP_NS = 100_000_000
"""Longest sleep, in wall time [ns]: requests and the end of the run are checked in between."""
_LAG_FORGIVEN_NS = 200_000_000
"""Largest lag that is caught up [ns]; beyond it, the run is slow rather than jerky."""
_GIL_INTERVAL_S = 0.0005
"""Switch interval of the interpreter [s], a tenth of Python's default."""


def shorten_gil_interval() -> None:
    """Shorten the interpreter's switch interval, so that stepping keeps its pace next to a busy thread.

    A thread that returns from MuJoCo or a socket waits for the GIL: 5 ms each time by default, while the graph's
    thread reads, for example, megabytes of a hostile call.
    """
    sys.setswitchinterval(_GIL_INTERVAL_S)


class RealtimePacer:
    """Computes the next simulation time to advance to, and sleeps while the wall clock is behind it."""

    def __init__(
        self,
        speed: float | None,
        *,
        wall_ns: Callable[[], int] = time.monotonic_ns,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        """Start pacing.

        Args:
            speed: simulated seconds per second of wall time; None: flat out.
            wall_ns: wall clock [ns].
            sleep: sleeps for seconds.
        """
        self._speed = speed
        self._wall_ns = wall_ns
        self._sleep = sleep
        self._anchor: tuple[int, int] | None = None
        self._recent: deque[tuple[int, int]] = deque(maxlen=100)

    @property
    def speed(self) -> float | None:
        """Simulated seconds per second of wall time; None: flat out."""
        return self._speed

    def set_speed(self, speed: float | None) -> None:
        """Change the speed."""
        self._speed = speed
        self.restart()

    def restart(self) -> None:
        """Restart pacing, after a pause, a reset or a single step."""
        self._anchor = None
        self._recent.clear()

    def next_target(self, time_ns: int) -> int:
        """Return the simulation time [ns] to advance to; sleep first if the simulation is ahead.

        If the simulation is far ahead of the wall clock, this is the present time.
        """
        now = self._wall_ns()
        self._recent.append((now, time_ns))
        if self._speed is None:
            return time_ns + STRIDE_FLAT_OUT_NS
        if self._anchor is None:
            self._anchor = (now, time_ns)
        wall_0, sim_0 = self._anchor
        lead_ns = (time_ns - sim_0) / self._speed - (now - wall_0)
        if lead_ns > 0.0:
            self._sleep(min(lead_ns, _LONGEST_SLEEP_NS) / NS_PER_S)
        elif -lead_ns > _LAG_FORGIVEN_NS:
            self._anchor = (now, time_ns)
        if lead_ns > _LONGEST_SLEEP_NS:
            return time_ns
        return time_ns + max(1, int(min(_STRIDE_WALL_NS * self._speed, _LONGEST_STRIDE_NS)))

    @property
    def real_time_factor(self) -> float | None:
        """Simulated over wall time during the last 100 strides; None before the second."""
        if len(self._recent) < 2:
            return None
        (wall_0, sim_0), (wall_1, sim_1) = self._recent[0], self._recent[-1]
        return (sim_1 - sim_0) / (wall_1 - wall_0) if wall_1 > wall_0 else None
