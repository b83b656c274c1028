"""topic_tools/throttle: limits messages or bytes per second."""

import time
from collections import deque
from collections.abc import Callable

from trundle.ros import Node, RawMessage
from trundle.spatial import NS_PER_S

from ..host import NodeHost
from ..private_parameters import private_parameters
from .raw_relay import RawPublisher, RawSubscriber, subscribe_lazily

_USAGE = (
    "usage: throttle messages IN_TOPIC MSGS_PER_SEC [OUT_TOPIC], "
    "or throttle bytes IN_TOPIC BYTES_PER_SEC WINDOW [OUT_TOPIC]"
)


class MessageRateLimiter:
    """Allows a message if the last one is more than a period ago."""

    def __init__(self, rate_hz: float, now_ns: Callable[[], int]) -> None:
        self._period_ns = round(NS_PER_S / rate_hz)
        self._now_ns = now_ns
        self._last_ns = 0

    def allows(self, size: int) -> bool:
        """Return True if a message of `size` bytes may pass now."""
        del size
        now = self._now_ns()
        self._last_ns = min(self._last_ns, now)  # simulated time may jump back
        if now - self._last_ns <= self._period_ns:
            return False
        self._last_ns = now
        return True


class BandwidthLimiter:
    """Allows a message while fewer than `allowed_bytes` were sent in the last `window_s`.

    Like the original, ignores the message's own size and does not scale the limit by the window's length.
    """

    def __init__(self, allowed_bytes: float, window_s: float, now_ns: Callable[[], int]) -> None:
        self._allowed = allowed_bytes
        self._window_ns = round(window_s * NS_PER_S)
        self._now_ns = now_ns
        self._sent: deque[tuple[int, int]] = deque()

    def allows(self, size: int) -> bool:
        """Return True if a message of `size` bytes may pass now."""
        now = self._now_ns()
        while self._sent and not 0 <= now - self._sent[0][0] <= self._window_ns:
            self._sent.popleft()
        if sum(sent for _, sent in self._sent) >= self._allowed:
            return False
        self._sent.append((now, size))
        return True


class Throttle:
    """Relays messages below the limit; with ~lazy, subscribes only while there are subscribers."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Throttle until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        # The original reads the first name; its manual, and therefore launch files, use the second.
        is_wall_clock = settings.flag("wall_clock", default=settings.flag("use_wall_clock", default=False))
        latch = settings.flag("force_latch", default=False) if "force_latch" in settings else None
        now_ns = time.time_ns if is_wall_clock else lambda: node.clock.now_ns()
        try:
            limiter, source, target = self._read(now_ns)
        except ValueError:
            node.log.error(f"{_USAGE}; got {' '.join(self._arguments)!r}")
            return 1
        output = RawPublisher(node, target, latch=latch)

        def on_message(message: RawMessage) -> None:
            if limiter.allows(len(message.data)):
                output.publish(message)

        subscriber = RawSubscriber(node, source, on_message)
        subscriber.subscribe()
        if settings.flag("lazy", default=False):
            await subscribe_lazily(node, output, lambda: [(subscriber, True)])
        await node.closed.wait()
        return 0

    def _read(self, now_ns: Callable[[], int]) -> tuple[MessageRateLimiter | BandwidthLimiter, str, str]:
        match self._arguments:
            case ["messages", source, rate, *rest] if len(rest) <= 1 and float(rate) > 0.0:
                limiter = MessageRateLimiter(float(rate), now_ns)
            case ["bytes", source, rate, window, *rest] if len(rest) <= 1:
                limiter = BandwidthLimiter(float(rate), float(window), now_ns)
            case _:
                raise ValueError
        return limiter, source, rest[0] if rest else f"{source}_throttle"
