"""Keeps simulation time in step with the wall, or lets it run.

The only clockwork of a run: the simulator itself never looks at the wall clock.
"""

import sys
import time
from collections import deque
from collections.abc import Callable

from trundle.spatial import NS_PER_S

_STRIDE_WALL_NS = 20_000_000
"""How long the simulation runs before requests are looked at again, as wall time."""
_STRIDE_FLAT_OUT_NS = 50_000_000
"""Simulation time of a stride when nothing waits for the wall: fixed, so that runs repeat."""
_LAG_FORGIVEN_NS = 200_000_000
"""A run that cannot keep up does not hurry after more than this of lost time: it is slow, not jerky."""
_TURN_S = 0.0005
"""A tenth of what Python gives a thread."""


def shorten_gil_interval() -> None:
    """Have the threads of this process take turns often, so that stepping keeps its pace beside a busy one.

    A thread that comes back from MuJoCo or a socket waits for its turn: five milliseconds each time by Python's
    default, while the graph's thread reads, say, the megabytes of a hostile call.
    """
    sys.setswitchinterval(_TURN_S)


class RealtimePacer:
    """Says up to which simulation time to go next, and waits for the wall where that is early."""

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
            wall_ns: the wall clock [ns].
            sleep: waits so many seconds.
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
        """Go on at another speed from now."""
        self._speed = speed
        self.restart()

    def restart(self) -> None:
        """Forget the past: after a pause, a reset or a single step."""
        self._anchor = None
        self._recent.clear()

    def next_target(self, time_ns: int) -> int:
        """The simulation time [ns] to go to now; waits first if the wall has not got there."""
        now = self._wall_ns()
        self._recent.append((now, time_ns))
        if self._speed is None:
            return time_ns + _STRIDE_FLAT_OUT_NS
        if self._anchor is None:
            self._anchor = (now, time_ns)
        wall_0, sim_0 = self._anchor
        due = wall_0 + int((time_ns - sim_0) / self._speed)
        if due > now:
            self._sleep((due - now) / NS_PER_S)
        elif now - due > _LAG_FORGIVEN_NS:
            self._anchor = (now, time_ns)
        return time_ns + max(1, int(_STRIDE_WALL_NS * self._speed))

    @property
    def real_time_factor(self) -> float | None:
        """Simulated over wall time during the last strides; None before there is any."""
        if len(self._recent) < 2:
            return None
        (wall_0, sim_0), (wall_1, sim_1) = self._recent[0], self._recent[-1]
        return (sim_1 - sim_0) / (wall_1 - wall_0) if wall_1 > wall_0 else None
