"""Publishes simulation time on /clock."""

from trundle.ros import Node
from trundle.simulation import Snapshot


class ClockTopic:
    """/clock at 100 Hz of simulation time, as gazebo_ros does by default."""

    period_ns = 10_000_000

    def __init__(self, node: Node) -> None:
        self._publisher = node.advertise("/clock", "rosgraph_msgs/Clock", queue_size=1)

    def wanted(self) -> bool:
        """Whether anybody listens."""
        return self._publisher.has_subscribers

    def after_step(self, snapshot: Snapshot) -> None:
        """Tell the time."""
        self._publisher.publish({"clock": snapshot.time_ns})
