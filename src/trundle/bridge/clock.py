"""Publishes simulation time on /clock."""

from trundle.ros import Node, SimClock
from trundle.simulation import Snapshot


class ClockTopic:
    """/clock at 100 Hz of simulation time, as gazebo_ros does by default."""

    period_ns = 10_000_000

    def __init__(self, node: Node, clock: SimClock) -> None:
        """Advertise.

        Args:
            node: publishes.
            clock: the clock of the nodes in this process, moved directly.
        """
        self._publisher = node.advertise("/clock", "rosgraph_msgs/Clock", queue_size=1, latch=True)
        self._node = node
        self._clock = clock

    def after_step(self, snapshot: Snapshot) -> None:
        """Tell the time."""
        self._clock.set(snapshot.time_ns)
        if self._publisher.has_subscribers:
            self._publisher.publish(self._node.new("rosgraph_msgs/Clock", {"clock": self._node.stamp()}))
