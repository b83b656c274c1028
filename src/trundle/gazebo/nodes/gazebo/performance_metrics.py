"""/gazebo/performance_metrics: real-time factor and sensor rates."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from trundle.ros import Node
from trundle.sim.sensors import CameraSensor

from ..host import Simulator

_PERIOD_S = 1.0
"""Period chosen here: Gazebo's, which gazebo_ros forwards, was not found in a source."""
_NO_PICTURES = -1.0
"""`fps` of other sensors than cameras, as in GazeboRosApiPlugin::onPerformanceMetrics."""


@dataclass(frozen=True, slots=True)
class _Sample:
    wall_s: float
    sim_s: float
    readings: Mapping[int, int]
    """Sensor → number of readings."""


class MetricsTopic:
    """Publishes rates over the last second, while there are subscribers.

    Rates are in wall time; in lockstep, nothing is published, for repeatability.
    """

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._simulator = simulator
        self._topic = node.advertise("~performance_metrics", "gazebo_msgs/PerformanceMetrics", queue_size=10)
        self._before: _Sample | None = None
        self._due_s = 0.0

    def due(self) -> bool:
        """True if there are subscribers and a second has passed."""
        if not self._topic.has_subscribers or self._simulator.is_lockstep:
            self._before = None
            return False
        if time.monotonic() < self._due_s:
            return False
        self._due_s = time.monotonic() + _PERIOD_S
        return True

    def publish(self) -> None:
        """Publish the rates since the last call; on the simulation's thread."""
        simulator, before = self._simulator, self._before
        now_ns = simulator.simulation.time_ns
        readings = {id(sensor): sensor.reading_count for sensor in simulator.sensors}
        self._before = now = _Sample(time.monotonic(), now_ns / 1e9, readings)
        if before is None or now.sim_s < before.sim_s:  # first call, or time was reset
            return
        wall_s, sim_s = now.wall_s - before.wall_s, now.sim_s - before.sim_s
        sensors: list[dict[str, Any]] = []
        for sensor in simulator.sensors:
            count = sensor.reading_count - before.readings.get(id(sensor), 0)
            a_second = count / wall_s
            sensors.append(
                {
                    "name": sensor.name,
                    "sim_update_rate": count / sim_s if sim_s else 0.0,
                    "real_update_rate": a_second,
                    "fps": a_second if isinstance(sensor, CameraSensor) else _NO_PICTURES,
                }
            )
        self._topic.publish({"header": {"stamp": now_ns}, "real_time_factor": sim_s / wall_s, "sensors": sensors})
