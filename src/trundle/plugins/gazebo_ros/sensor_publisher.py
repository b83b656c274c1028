"""What sensor plugins of gazebo_ros share: a header, a rate of their own, and a wanted topic."""

from collections.abc import Callable, Mapping
from typing import Protocol

from trundle.model import PluginTag
from trundle.ros import Node, Publisher

from .namespaces import join_topic, rate_to_period_ns


class UpdateRateThrottle:
    """Lets readings through no more often than a plugin's own rate, which may be lower than the sensor's."""

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = rate_to_period_ns(rate_hz)
        self._next_ns = 0

    def is_due(self, time_ns: int) -> bool:
        """Whether this reading is one of them; a rate of 0 takes all."""
        if time_ns + self._period_ns < self._next_ns:  # time was turned back
            self._next_ns = time_ns
        if time_ns < self._next_ns:
            return False
        self._next_ns += self._period_ns
        if self._next_ns <= time_ns:  # nobody listened for a while
            self._next_ns = time_ns + self._period_ns
        return True


class StampedReading(Protocol):
    """Any reading."""

    @property
    def time_ns(self) -> int:
        """When."""
        ...


class SensorPublisher:
    """One topic of a sensor plugin."""

    def __init__(self, node: Node, topic: str, kind: str, frame: str, *, rate_hz: float = 0.0) -> None:
        """Advertise."""
        self._topic: Publisher = node.advertise(topic, kind, queue_size=1)
        self._frame = frame
        self._throttle = UpdateRateThrottle(rate_hz)

    def has_subscribers(self) -> bool:
        """Whether anybody listens."""
        return self._topic.has_subscribers

    def publish(self, reading: StampedReading, make: Callable[[], Mapping[str, object]]) -> None:
        """Make a message of a reading and publish it, if somebody listens and it is due."""
        if self._topic.has_subscribers and self._throttle.is_due(reading.time_ns):
            header = {"stamp": reading.time_ns, "frame_id": self._frame}
            self._topic.publish({**make(), "header": header})


def read_frame_name(tag: PluginTag, default: str) -> str:
    """<frameName>, as tf has it: without a leading slash."""
    return tag.node.string("frameName", default=default).strip().lstrip("/")


def read_topic_name(tag: PluginTag, namespace: str, name: str, default: str) -> str:
    """The global name of the topic that a parameter names."""
    return join_topic(namespace, tag.node.string(name, default=default))
