"""What a simulation tells again and again: at every step where each message counts, else a hundred times a second."""

from collections.abc import Callable

from trundle.ros import Publisher
from trundle.simulation import Simulation, Snapshot

_MIN_PERIOD_NS = 10_000_000
"""Ours: every tenth step of Gazebo's. Time as it steps costs Python at each, and stand-ins take only the newest."""


class StepPublisher:
    """Has a function called with the snapshot as often as the listeners of a topic need it.

    gazebo_ros tells at every step whatever somebody listens to (GazeboRosApiPlugin::publishSimTime,
    publishModelStates, publishLinkStates); whoever listens in another process gets that.
    """

    QUEUE_SIZE = 100
    """Ten in gazebo_ros, which waits for the wall before each step; here many follow one another at once."""

    def __init__(self, topic: Publisher, tell: Callable[[Snapshot], None]) -> None:
        self._topic = topic
        self._publish = tell

    def attach(self, simulation: Simulation) -> None:
        """Begin; what nobody listens to costs no stride."""
        simulation.add_hook(_Tick(self._publish), period_ns=_MIN_PERIOD_NS, enabled=self._is_sparing)
        simulation.add_hook(_Tick(self._publish), enabled=lambda: self._topic.needs_every_message)

    def _is_sparing(self) -> bool:
        return self._topic.has_subscribers and not self._topic.needs_every_message


class _Tick:
    def __init__(self, tell: Callable[[Snapshot], None]) -> None:
        self.after_step = tell
