"""When a launch that is given a time is over: also where its world ended, and with it the time."""

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.spatial import NS_PER_S

if TYPE_CHECKING:
    from trundle.ros import Clock


class LaunchDuration:
    """Counts the nodes' time, and the wall's while no world is left to tell it."""

    def __init__(
        self,
        clock: "Clock",
        duration_s: float,
        *,
        in_step: bool,
        is_worldless: Callable[[], bool],
        say: Callable[[str], None],
    ) -> None:
        """Start to count.

        Args:
            clock: of the nodes.
            duration_s: after how much time the launch ends [s].
            in_step: time starts at zero and its end is seen by who steps it, not here.
            is_worldless: whether the world that told the time has ended.
            say: tells the user that the wall's clock is taken.
        """
        self._clock = clock
        self._in_step = in_step
        self._is_worldless = is_worldless
        self._say: Callable[[str], None] | None = say
        self._end_ns = round(duration_s * NS_PER_S) + (0 if in_step else clock.now_ns())
        self._stood_ns = 0
        self._seen_ns = time.monotonic_ns()

    def is_over(self) -> bool:
        """Look at the clocks; to be called often."""
        seen_ns = time.monotonic_ns()
        worldless = self._is_worldless()
        if worldless:
            self._stood_ns += seen_ns - self._seen_ns
            if self._say is not None:
                self._say("the simulation has ended, and time with it; the rest of --duration goes by the wall's clock")
                self._say = None
        self._seen_ns = seen_ns
        return (worldless or not self._in_step) and self._clock.now_ns() + self._stood_ns >= self._end_ns
