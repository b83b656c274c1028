"""Statistics of a topic's last messages, as rostopic's hz, delay and bw measure them."""

import threading
import time
from abc import ABC, abstractmethod
from collections import deque
from statistics import fmean, pstdev
from typing import Any, NamedTuple, Protocol

from ..node.clock import to_nsec

_MAX_WINDOW = 50_000
"""Default window of averages [messages], as in rostopic."""


class RosTime(Protocol):
    """ROS time that a meter reads."""

    def now_ns(self) -> int:
        """ROS time [ns]; simulated time is 0 until first set."""
        ...


class MeterStatistics(NamedTuple):
    """Statistics of the values in a window."""

    mean: float
    min: float
    max: float
    deviation: float
    """Standard deviation."""
    window: int
    """Number of messages."""

    @property
    def rate_hz(self) -> float:
        """Rate, where the values are intervals [s]."""
        return 1 / self.mean if self.mean > 0 else 0.0


class _TimeMeter(ABC):
    """Window of times; the first one comes with a topic's second message."""

    def __init__(self, clock: RosTime, window: int = -1) -> None:
        """Start empty.

        Args:
            clock: time of the arrivals.
            window: messages to average over; fewer than 2: 50 000.
        """
        self._clock = clock
        self._last_s = -1.0
        self._values: deque[float] = deque(maxlen=(window if window > 1 else _MAX_WINDOW) - 1)
        self._is_new = False
        self._lock = threading.Lock()

    def add_message(self, message: Any) -> None:
        """Record an arrival; the first only starts the measurement, also after a jump back in time."""
        now_s = self._clock.now_ns() / 1e9
        with self._lock:
            if now_s == 0.0:
                if self._values:
                    print("time has reset, resetting counters")
                self._values.clear()
                self._last_s = -1.0
                return
            if self._last_s < 0 or now_s < self._last_s:
                self._values.clear()
            else:
                self._values.append(self._measure(message, now_s))
                self._is_new = True
            self._last_s = now_s

    def statistics(self) -> MeterStatistics | None:
        """Statistics [s]; None without new messages since the last call."""
        with self._lock:
            if not self._values or not self._is_new:
                return None
            self._is_new = False
            values = list(self._values)
        return MeterStatistics(fmean(values), min(values), max(values), pstdev(values), len(values) + 1)

    def text(self) -> str | None:
        """Statistics since the last call, in rostopic's format; None: nothing to print."""
        statistics = self.statistics()
        if statistics is None:
            return "no new messages"
        return f"{self._average_text(statistics)}\n{_spread_text(statistics)}"

    @abstractmethod
    def _measure(self, message: Any, now_s: float) -> float:
        """Return the value [s] that a message adds to the window."""

    @abstractmethod
    def _average_text(self, statistics: MeterStatistics) -> str: ...


class RateMeter(_TimeMeter):
    """Intervals between messages."""

    def _measure(self, message: Any, now_s: float) -> float:
        del message
        return now_s - self._last_s

    def _average_text(self, statistics: MeterStatistics) -> str:
        return f"average rate: {statistics.rate_hz:.3f}"


class DelayMeter(_TimeMeter):
    """Delays between header stamp and arrival."""

    def text(self) -> str | None:
        """Statistics since the last call, in rostopic's format; None before the second message."""
        return super().text() if self._values else None

    def _measure(self, message: Any, now_s: float) -> float:
        return now_s - to_nsec(message.header.stamp) / 1e9

    def _average_text(self, statistics: MeterStatistics) -> str:
        return f"average delay: {statistics.mean:.3f}"


class BandwidthMeter:
    """Sizes of messages."""

    def __init__(self, window: int = 100) -> None:
        """Start empty; `window` is the number of messages to average over."""
        self._sizes: deque[tuple[float, int]] = deque(maxlen=max(window, 2))
        self._lock = threading.Lock()

    def add_bytes(self, count: int) -> None:
        """Record a message's size."""
        with self._lock:
            self._sizes.append((time.monotonic(), count))

    def statistics(self) -> tuple[float, MeterStatistics] | None:
        """Bytes per second, and statistics of the sizes [B]; None before the second message."""
        with self._lock:
            if len(self._sizes) < 2:
                return None
            sizes = [size for _, size in self._sizes]
            rate = sum(sizes) / (time.monotonic() - self._sizes[0][0])
        return rate, MeterStatistics(fmean(sizes), min(sizes), max(sizes), pstdev(sizes), len(sizes))

    def text(self) -> str | None:
        """Statistics in rostopic's format; None before the second message."""
        statistics = self.statistics()
        if statistics is None:
            return None
        rate, sizes = statistics
        unit, factor = ("B", 1) if rate < 1e3 else ("KB", 1e3) if rate < 1e6 else ("MB", 1e6)
        total, mean, smallest, largest = (f"{v / factor:.2f}{unit}" for v in (rate, sizes.mean, sizes.min, sizes.max))
        return f"average: {total}/s\n\tmean: {mean} min: {smallest} max: {largest} window: {sizes.window}"


def _spread_text(values: MeterStatistics) -> str:
    return f"\tmin: {values.min:.3f}s max: {values.max:.3f}s std dev: {values.deviation:.5f}s window: {values.window}"
