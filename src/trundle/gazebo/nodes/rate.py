"""Loop rates with the timing of the originals."""

from collections.abc import Callable

from trundle.ros import Node
from trundle.spatial import NS_PER_S


def period_ns(rate_hz: float) -> int:
    """Period of a rate [ns]."""
    return round(NS_PER_S / rate_hz)


class Rate:
    """rospy.Rate: a fixed-rate loop that catches up on small delays and skips long ones."""

    def __init__(self, node: Node, rate_hz: float) -> None:
        self._node = node
        self._period_ns = period_ns(rate_hz)
        self._last_ns = node.clock.now_ns()

    async def sleep(self) -> None:
        """Wait until the end of the period."""
        now = self._node.clock.now_ns()
        # Restart the period if simulated time has just begun, or jumped back.
        if self._last_ns == 0 or self._last_ns > now:
            self._last_ns = now
        await self._node.clock.sleep_until(self._last_ns + self._period_ns)
        self._last_ns += self._period_ns
        now = self._node.clock.now_ns()
        if now - self._last_ns > 2 * self._period_ns or now < self._last_ns - self._period_ns:
            self._last_ns = now


class RateDivider:
    """Rate divider of arbotix_python, for a lower rate inside a faster loop.

    The next period starts when the work was done, not when it was due, so that the actual rate is too low: at 10 Hz
    in a loop of 20 Hz, every second or third pass does the work.
    """

    def __init__(self, now_ns: Callable[[], int], rate_hz: float) -> None:
        self._now_ns = now_ns
        self._period_ns = period_ns(rate_hz)
        self._next_ns = now_ns() + self._period_ns

    def due(self) -> bool:
        """Return True if the period is over; then start the next one."""
        now = self._now_ns()
        if now + self._period_ns < self._next_ns:  # time jumped back
            self._next_ns = now + self._period_ns
        if now <= self._next_ns:
            return False
        self._next_ns = now + self._period_ns
        return True


class LogThrottle:
    """Limits the rate of a warning."""

    def __init__(self, node: Node, period_s: float) -> None:
        self._node = node
        self._period_ns = round(period_s * NS_PER_S)
        self._last_ns: int | None = None

    def warn(self, text: str) -> None:
        """Log a warning, unless one was logged within the period."""
        now = self._node.clock.now_ns()
        if self._last_ns is None or now - self._last_ns >= self._period_ns or now < self._last_ns:
            self._last_ns = now
            self._node.log.warn(text)
