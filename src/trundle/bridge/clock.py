"""Publishes simulation time on /clock."""

import math

from trundle.ros import Node
from trundle.simulation import Snapshot


class ClockTopic:
    """/clock at 100 Hz of simulation time, unless another rate is asked for."""

    RATE_HZ = 100.0

    def __init__(self, node: Node, *, rate_hz: float = RATE_HZ) -> None:
        """Advertise; a rate of 0 is once a step."""
        self.period_ns = round(1e9 / rate_hz) if rate_hz > 0.0 else 0
        self._publisher = node.advertise("/clock", "rosgraph_msgs/Clock", queue_size=10)

    def wanted(self) -> bool:
        """Whether anybody listens."""
        return self._publisher.has_subscribers

    def after_step(self, snapshot: Snapshot) -> None:
        """Tell the time."""
        self._publisher.publish({"clock": snapshot.time_ns})


async def clock_rate_hz(node: Node) -> float:
    """What the graph says about /clock, as gazebo_ros reads it [Hz]; 0: once a step."""
    rate = await node.get_param("~pub_clock_frequency", ClockTopic.RATE_HZ)
    if isinstance(rate, bool) or not isinstance(rate, int | float) or not 0.0 <= rate < math.inf:
        node.log_warn(f"pub_clock_frequency {rate!r} is no rate; /clock has {ClockTopic.RATE_HZ:g} Hz")
        return ClockTopic.RATE_HZ
    return float(rate)
