"""Rates of topics."""

import threading
import time
from collections import deque
from statistics import pstdev
from typing import Any

_MAX_WINDOW = 50_000


class ROSTopicHz:
    """Rate of messages: a callback that counts them."""

    def __init__(self, window_size: int = -1, filter_expr: Any = None, use_wtime: bool = False) -> None:
        """Create.

        Args:
            window_size: messages to average over; -1: all.
            filter_expr: takes a message; False for those that do not count.
            use_wtime: wall time instead of ROS time.
        """
        self.lock = threading.Lock()
        self.last_printed_tn = 0.0
        self.msg_tn = 0.0
        self.use_wtime = use_wtime
        self.filter_expr = filter_expr
        self.times: deque[float] = deque(maxlen=window_size if window_size > 0 else _MAX_WINDOW)

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        """Count a message."""
        del topic
        if self.filter_expr is not None and not self.filter_expr(m):
            return
        now = self._now()
        with self.lock:
            if self.msg_tn and now >= self.msg_tn:
                self.times.append(now - self.msg_tn)
            elif self.msg_tn:  # time jumped back
                self.times.clear()
            self.msg_tn = now

    def get_hz(self, topic: str | None = None) -> tuple[float, float, float, float, int] | None:
        """Rate [Hz], shortest and longest interval and their standard deviation [s], number; None if nothing is new."""
        del topic
        with self.lock:
            if not self.times or self.msg_tn == self.last_printed_tn:
                return None
            times = list(self.times)
            self.last_printed_tn = self.msg_tn
        mean = sum(times) / len(times)
        return 1.0 / mean if mean > 0 else 0.0, min(times), max(times), pstdev(times), len(times) + 1

    def print_hz(self, topics: Any = None) -> None:
        """Print the rate."""
        del topics
        found = self.get_hz()
        if found is None:
            print("no new messages")
            return
        rate, shortest, longest, deviation, window = found
        print(f"average rate: {rate:.3f}")
        print(f"\tmin: {shortest:.3f}s max: {longest:.3f}s std dev: {deviation:.5f}s window: {window}")

    def _now(self) -> float:
        if self.use_wtime:
            return time.time()
        import rospy

        return rospy.get_time()


class ROSTopicBandwidth:
    """Bandwidth of messages: a callback that takes AnyMsg."""

    def __init__(self, window_size: int = 100) -> None:
        self._seen: deque[tuple[float, int]] = deque(maxlen=window_size if window_size > 0 else _MAX_WINDOW)

    def callback(self, data: Any) -> None:
        """Count a message."""
        self._seen.append((time.time(), len(data._buff)))

    def get_bw(self) -> tuple[float, float, int, int, int] | None:
        """Bandwidth [B/s], mean, smallest and largest message [B], number; None without messages."""
        seen = list(self._seen)
        if len(seen) < 2:
            return None
        sizes = [size for _, size in seen]
        total = sum(sizes)
        return total / (time.time() - seen[0][0]), total / len(sizes), min(sizes), max(sizes), len(sizes)
