"""/gazebo/performance_metrics: real-time factor and sensor rates."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from trundle.ros import Node
from trundle.sim.sensors import CameraSensor

from ..host import Simulator

_PERIOD_S = 1.0
"""Publishing period [s], an own choice; gazebo_ros forwards Gazebo's messages, whose period no source states."""
_NO_FPS = -1.0
"""`fps` of sensors other than cameras, as in GazeboRosApiPlugin::onPerformanceMetrics."""


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
        self._last: _Sample | None = None
        self._due_s = 0.0

    def due(self) -> bool:
        """Return True if there are subscribers and a second has passed."""
        if not self._topic.has_subscribers or self._simulator.is_lockstep:
            self._last = None
            return False
        if time.monotonic() < self._due_s:
            return False
        self._due_s = time.monotonic() + _PERIOD_S
        return True

    def publish(self) -> None:
        """Publish the rates since the last call; on the simulation's thread."""
        simulator, last = self._simulator, self._last
        now_ns = simulator.simulation.time_ns
        readings = {id(sensor): sensor.reading_count for sensor in simulator.sensors}
        self._last = sample = _Sample(time.monotonic(), now_ns / 1e9, readings)
        if last is None or sample.sim_s < last.sim_s:  # at the first call, and after a reset of time
            return
        wall_s, sim_s = sample.wall_s - last.wall_s, sample.sim_s - last.sim_s
        sensors: list[dict[str, Any]] = []
        for sensor in simulator.sensors:
            count = sensor.reading_count - last.readings.get(id(sensor), 0)
            real_rate = count / wall_s
            sensors.append(
                {
                    "name": sensor.name,
                    "sim_update_rate": count / sim_s if sim_s else 0.0,
                    "real_update_rate": real_rate,
                    "fps": real_rate if isinstance(sensor, CameraSensor) else _NO_FPS,
                }
            )
        self._topic.publish({"header": {"stamp": now_ns}, "real_time_factor": sim_s / wall_s, "sensors": sensors})
