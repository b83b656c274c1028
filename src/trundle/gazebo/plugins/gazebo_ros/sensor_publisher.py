"""Publisher of gazebo_ros' sensor plugins: one topic with header and update rate."""

from collections.abc import Callable, Mapping
from typing import Protocol

from .namespaces import rate_to_period_ns
from .plugin_names import TopicPublisher


class UpdateRateThrottle:
    """Limits readings to the plugin's <updateRate>, which may be lower than the sensor's."""

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = rate_to_period_ns(rate_hz)
        self._next_ns = 0

    def is_due(self, time_ns: int) -> bool:
        """Return True if a reading of this time is due; at rate 0, always."""
        if time_ns + self._period_ns < self._next_ns:  # the simulation was reset
            self._next_ns = time_ns
        if time_ns < self._next_ns:
            return False
        self._next_ns += self._period_ns
        if self._next_ns <= time_ns:  # readings were skipped while there was no subscriber
            self._next_ns = time_ns + self._period_ns
        return True


class StampedReading(Protocol):
    """Reading of any sensor."""

    @property
    def time_ns(self) -> int:
        """Simulation time of the measurement [ns]."""
        ...


class SensorPublisher:
    """One topic of a sensor plugin."""

    def __init__(self, topic: TopicPublisher, frame: str, *, rate_hz: float = 0.0) -> None:
        """Publish on a topic with a frame in each header."""
        self._topic = topic
        self._frame = frame
        self._throttle = UpdateRateThrottle(rate_hz)

    def has_subscribers(self) -> bool:
        """True if there is a subscriber."""
        return self._topic.has_subscribers

    def publish(self, reading: StampedReading, make: Callable[[], Mapping[str, object]]) -> None:
        """Make a reading's message and publish it, if there is a subscriber and it is due."""
        if self._topic.has_subscribers and self._throttle.is_due(reading.time_ns):
            header = {"stamp": reading.time_ns, "frame_id": self._frame}
            self._topic.publish({**make(), "header": header})
