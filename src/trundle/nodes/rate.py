"""How the originals keep time."""

from collections.abc import Callable

from trundle.ros import Node
from trundle.spatial import NS_PER_S


def period_ns(rate_hz: float) -> int:
    """Return a rate's period [ns]."""
    return round(NS_PER_S / rate_hz)


class Rate:
    """rospy.Rate: a loop at a fixed rate that catches up on small delays and forgets long ones."""

    def __init__(self, node: Node, rate_hz: float) -> None:
        self._node = node
        self._period_ns = period_ns(rate_hz)
        self._last_ns = node.clock.now_ns()

    async def sleep(self) -> None:
        """Wait until the period is over."""
        now = self._node.clock.now_ns()
        # Simulated time that was not known yet, or went back, starts the count again.
        if self._last_ns == 0 or self._last_ns > now:
            self._last_ns = now
        await self._node.clock.sleep_until(self._last_ns + self._period_ns)
        self._last_ns += self._period_ns
        now = self._node.clock.now_ns()
        if now - self._last_ns > 2 * self._period_ns or now < self._last_ns - self._period_ns:
            self._last_ns = now


class RateDivider:
    """arbotix_python's way of doing something at a lower rate inside a faster loop.

    The next time counts from when it was last done, not from when it was due, so that the actual rate falls short:
    10 Hz in a loop of 20 Hz is done every second or third pass.
    """

    def __init__(self, now_ns: Callable[[], int], rate_hz: float) -> None:
        self._now_ns = now_ns
        self._period_ns = period_ns(rate_hz)
        self._next_ns = now_ns() + self._period_ns

    def due(self) -> bool:
        """Tell whether it is to be done now; if so, the next time is set."""
        now = self._now_ns()
        if now + self._period_ns < self._next_ns:  # time went back
            self._next_ns = now + self._period_ns
        if now <= self._next_ns:
            return False
        self._next_ns = now + self._period_ns
        return True


class LogThrottle:
    """Lets something be said at most once in a while."""

    def __init__(self, node: Node, every_s: float) -> None:
        self._node = node
        self._every_ns = round(every_s * NS_PER_S)
        self._last_ns: int | None = None

    def warn(self, text: str) -> None:
        """Say it, unless it was said a moment ago."""
        now = self._node.clock.now_ns()
        if self._last_ns is None or now - self._last_ns >= self._every_ns or now < self._last_ns:
            self._last_ns = now
            self._node.log.warn(text)
