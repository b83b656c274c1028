"""End of a launch with --duration, even if its world, and ROS time with it, ended before."""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.spatial import NS_PER_S

if TYPE_CHECKING:
    from trundle.ros import Clock


class LaunchDuration:
    """Counts ROS time, and wall time once the world has ended."""

    def __init__(
        self,
        clock: "Clock",
        duration_s: float,
        *,
        in_step: bool,
        is_worldless: Callable[[], bool],
        say: Callable[[str], None],
    ) -> None:
        """Start counting.

        Args:
            clock: ROS time of the nodes.
            duration_s: the launch ends after it [s].
            in_step: time starts at zero, and the thread that steps it sees its end.
            is_worldless: True if the world that published /clock has ended.
            say: prints that the rest goes by wall time.
        """
        self._clock = clock
        self._in_step = in_step
        self._is_worldless = is_worldless
        self._say: Callable[[str], None] | None = say
        self._end_ns = round(duration_s * NS_PER_S) + (0 if in_step else clock.now_ns())
        self._stood_ns = 0
        self._seen_ns = time.monotonic_ns()

    def is_over(self) -> bool:
        """Return True if the time has passed; to be polled."""
        seen_ns = time.monotonic_ns()
        worldless = self._is_worldless()
        if worldless:
            self._stood_ns += seen_ns - self._seen_ns
            if self._say is not None:
                self._say(
                    "the simulation has ended, and ROS time with it; the rest of --duration is counted in wall time"
                )
                self._say = None
        self._seen_ns = seen_ns
        return (worldless or not self._in_step) and self._clock.now_ns() + self._stood_ns >= self._end_ns
