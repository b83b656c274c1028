"""Topic /clock with simulation time."""

from trundle.ros import Node
from trundle.sim.simulation import Simulation, Snapshot

from .step_publisher import StepPublisher

_RATE_HZ = 100.0
_MAX_HZ = 1e6
"""Largest rate [Hz]; above it, every step is published."""


class ClockTopic:
    """Topic /clock, at a rate in simulation time."""

    def __init__(self, node: Node, *, rate_hz: float | None = _RATE_HZ) -> None:
        """Advertise.

        Args:
            node: node that publishes /clock.
            rate_hz: rate [Hz]; None: every step, for subscribers that need every message.
        """
        self._period_ns = None if rate_hz is None else round(1e9 / rate_hz)
        self._publisher = node.advertise("/clock", "rosgraph_msgs/Clock", queue_size=StepPublisher.QUEUE_SIZE)

    def attach(self, simulation: Simulation) -> None:
        """Start publishing; without subscribers, it does not shorten strides."""
        if self._period_ns is None:
            StepPublisher(self._publisher, self.after_step).attach(simulation)
        else:
            simulation.add_hook(
                self, period_ns=self._period_ns, enabled=lambda: self._publisher.has_subscribers, name="/clock"
            )

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the time."""
        self._publisher.publish({"clock": snapshot.time_ns})


async def clock_rate_hz(node: Node) -> float | None:
    """Rate of /clock [Hz] by the parameter pub_clock_frequency, as gazebo_ros reads it; None: every step."""
    if not node.profile.has_clock_frequency:
        return None
    rate = await node.params.get("~pub_clock_frequency", 0)
    if isinstance(rate, bool) or not isinstance(rate, int | float):
        node.log.warn(f"pub_clock_frequency {rate!r} is not a rate; /clock is published at each step")
        return None
    return float(rate) if 0.0 < rate <= _MAX_HZ else None
