"""Periodic publishing: at every step if a subscriber needs each message, else at 100 Hz."""

from collections.abc import Callable

from trundle.ros import Publisher
from trundle.sim.simulation import Simulation, Snapshot

_MIN_PERIOD_NS = 10_000_000
"""Ten steps of Gazebo [ns]: each call runs Python, and stand-ins use only the newest message."""


class StepPublisher:
    """Calls a function with the snapshot as often as the subscribers of a topic need it.

    gazebo_ros publishes at every step if there is a subscriber (GazeboRosApiPlugin::publishSimTime, publishModelStates,
    publishLinkStates); subscribers in other processes get the same here.
    """

    QUEUE_SIZE = 100
    """Queue size; gazebo_ros has 10, but sleeps before each step, while here many steps run without a pause."""

    def __init__(self, topic: Publisher, publish: Callable[[Snapshot], None]) -> None:
        self._topic = topic
        self._publish = publish

    def attach(self, simulation: Simulation) -> None:
        """Start publishing; without subscribers, it does not shorten strides."""
        name, topic = self._topic.topic, self._topic
        simulation.add_hook(_Tick(self._publish), period_ns=_MIN_PERIOD_NS, enabled=self._needs_newest_only, name=name)
        simulation.add_hook(_Tick(self._publish), enabled=lambda: topic.needs_every_message, name=name)

    def _needs_newest_only(self) -> bool:
        return self._topic.has_subscribers and not self._topic.needs_every_message


class _Tick:
    def __init__(self, publish: Callable[[Snapshot], None]) -> None:
        self.after_step = publish
