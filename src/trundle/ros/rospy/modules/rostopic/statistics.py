"""Rates of topics."""

import time
from typing import Any

from trundle.ros.clients.topic_meters import BandwidthMeter, RateMeter


class ROSTopicHz:
    """Rate of messages: a callback that counts them."""

    def __init__(self, window_size: int = -1, filter_expr: Any = None, use_wtime: bool = False) -> None:
        """Create.

        Args:
            window_size: messages to average over; -1: all.
            filter_expr: called with a message; False: do not count it.
            use_wtime: wall time instead of ROS time.
        """
        self.use_wtime = use_wtime
        self.filter_expr = filter_expr
        self._meter = RateMeter(self, window_size)

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Count a message."""
        del topic
        if self.filter_expr is None or self.filter_expr(m):
            self._meter.add_message(m)

    def get_hz(self, topic: str | None = None) -> tuple[float, float, float, float, int] | None:
        """Rate [Hz], minimum, maximum and standard deviation of intervals [s], count; None without new messages."""
        del topic
        rate = self._meter.statistics()
        return None if rate is None else (rate.rate_hz, rate.min, rate.max, rate.deviation, rate.window)

    def print_hz(self, topics: Any = None) -> None:
        """Print the rate."""
        del topics
        print(self._meter.text())

    def now_ns(self) -> int:
        """Time of an arrival [ns]."""
        if self.use_wtime:
            return time.time_ns()
        import rospy

        return rospy.get_rostime().to_nsec()


class ROSTopicBandwidth:
    """Bandwidth of messages: a callback for AnyMsg."""

    def __init__(self, window_size: int = 100) -> None:
        self._meter = BandwidthMeter(window_size)

    def callback(self, data: Any) -> None:
        """Count a message."""
        self._meter.add_bytes(len(data._buff))

    def get_bw(self) -> tuple[float, float, int, int, int] | None:
        """Bandwidth [B/s], mean, minimum and maximum size of messages [B], count; None without messages."""
        statistics = self._meter.statistics()
        if statistics is None:
            return None
        rate, sizes = statistics
        return rate, sizes.mean, int(sizes.min), int(sizes.max), sizes.window
