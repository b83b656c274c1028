"""Statistics of received messages, published on /statistics."""

from collections.abc import Callable
from math import sqrt
from typing import Any

from rosgraph_msgs.msg import TopicStatistics

from .. import core
from ..names import get_name
from ..rostime import Duration, Time
from ..topics import Publisher

_NS_PER_S = 1_000_000_000
_INT32_MAX = 2**31 - 1


class SubscriberStatisticsLogger:
    """Statistics of a topic that this node subscribes to, publisher by publisher."""

    def __init__(self, topic: str, get_param: Callable[[str, Any], Any]) -> None:
        self.subscriber_name = topic
        self.connections: dict[str, ConnectionStatisticsLogger] = {}
        self.min_elements = get_param("/statistics_window_min_elements", 10)
        """Number of messages below which the window grows."""
        self.max_elements = get_param("/statistics_window_max_elements", 100)
        """Number of messages above which the window shrinks."""
        self.min_window = get_param("/statistics_window_min_size", 4)
        """Shortest window [s]."""
        self.max_window = get_param("/statistics_window_max_size", 64)
        """Longest window [s]."""

    def callback(self, message: Any, publisher: str, size: int) -> None:
        """Count a message.

        Args:
            message: received message.
            publisher: name of the node that sent it.
            size: serialized size, with the length field [bytes].
        """
        try:
            if (connection := self.connections.get(publisher)) is None:
                connection = self.connections[publisher] = ConnectionStatisticsLogger(self, publisher)
            connection.callback(message, size)
        except Exception as error:  # such as parameters of another type, or a stamp out of range
            core.logerr("Unexpected error during statistics measurement: %s", error)

    def shutdown(self) -> None:
        """Stop publishing."""
        for connection in self.connections.values():
            connection.pub.unregister()
        self.connections.clear()


class ConnectionStatisticsLogger:
    """Statistics of the messages from one publisher, over a window that adapts to their rate."""

    def __init__(self, topic: SubscriberStatisticsLogger, publisher: str) -> None:
        self._topic = topic
        self._publisher = publisher
        self.pub = Publisher("/statistics", TopicStatistics, queue_size=10)
        self._published_ns = 0
        self._window_s = 1.0
        self._last_seq = 0
        self._begin_window(Time.now())

    def callback(self, message: Any, size: int) -> None:
        """Count a message, and publish at the window's end."""
        now = Time.now()
        now_ns = now.to_nsec()
        self._delivered += 1
        self._traffic += size
        if self._arrived_ns is not None:
            self._periods.add(now_ns - self._arrived_ns)
        self._arrived_ns = now_ns
        if message._has_header:
            self._ages.add(now_ns - message.header.stamp.to_nsec())
            self._dropped += self._last_seq + 1 != message.header.seq
            self._last_seq = message.header.seq
        if self._published_ns + self._window_s * _NS_PER_S < now_ns:
            self._published_ns = now_ns
            self._end_window(now)

    def _begin_window(self, now: Time) -> None:
        self._start = now
        self._delivered = self._dropped = self._traffic = 0
        self._arrived_ns: int | None = None
        self._periods, self._ages = _Moments(), _Moments()

    def _end_window(self, now: Time) -> None:
        message = TopicStatistics(
            topic=self._topic.subscriber_name,
            node_pub=self._publisher,
            node_sub=get_name(),
            window_start=self._start,
            window_stop=now,
            delivered_msgs=self._delivered,
            dropped_msgs=self._dropped,
            traffic=min(self._traffic, _INT32_MAX),
            **self._periods.fields("period"),
            **self._ages.fields("stamp_age"),
        )
        delivered = self._delivered
        self._begin_window(now)
        self.pub.publish(message)
        self._adapt_window(delivered)

    def _adapt_window(self, delivered: int) -> None:
        topic = self._topic
        if delivered > topic.max_elements and self._window_s / 2 >= topic.min_window:
            self._window_s /= 2
        if delivered < topic.min_elements and self._window_s * 2 <= topic.max_window:
            self._window_s *= 2


class _Moments:
    """Mean, standard deviation (Welford's recurrence) and maximum of lengths of time."""

    def __init__(self) -> None:
        self._count = 0
        self._mean_s = self._squares = 0.0
        self._max_ns = 0

    def add(self, length_ns: int) -> None:
        """Add a length of time [ns]."""
        self._count += 1
        self._max_ns = length_ns if self._count == 1 else max(self._max_ns, length_ns)
        length_s = length_ns / _NS_PER_S
        difference = length_s - self._mean_s
        self._mean_s += difference / self._count
        self._squares += difference * (length_s - self._mean_s)

    def fields(self, prefix: str) -> dict[str, Duration]:
        """Fields of TopicStatistics; zero without values."""
        deviation_s = sqrt(self._squares / self._count) if self._count else 0.0
        return {
            f"{prefix}_mean": Duration(self._mean_s),
            f"{prefix}_stddev": Duration(deviation_s),
            f"{prefix}_max": Duration(0, self._max_ns),
        }
