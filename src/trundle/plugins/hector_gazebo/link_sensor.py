"""Base of hector_gazebo's sensors: link, frame and rate."""

import numpy as np

from trundle.model import PluginTag
from trundle.ros import Node
from trundle.simulation import ModelHandle, Simulation

from ..gazebo_ros.namespaces import join_topic, rate_to_period_ns, read_namespace
from ..gazebo_ros.ros_plugin import RosPlugin


class LinkSensor(RosPlugin):
    """Sensor on <bodyName> (the first link), with header frame <frameId>, at <updateRate>."""

    def __init__(
        self, sim: Simulation, model: ModelHandle, node: Node, tag: PluginTag, *, frame: str = "", rate_hz: float = 0.0
    ) -> None:
        super().__init__(sim, model, node, tag)
        parameters = tag.node
        body = parameters.string("bodyName")
        self.link = model.link(body) if body else model.base
        self.frame = parameters.string("frameId", default=frame or self.link.name)
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", default=rate_hz, report=sim.report))
        self.random = np.random.default_rng(sim.seed)
        self._namespace = read_namespace(tag, model.name)
        self._last_ns = sim.time_ns
        for name in ("updatePeriod", "randomEngineSeed"):
            parameters.find(name)

    def topic(self, name: str) -> str:
        """Global name of a topic."""
        return join_topic(self._namespace, name)

    def elapsed_s(self, time_ns: int) -> float:
        """Time since the last call [s]."""
        elapsed, self._last_ns = max(time_ns - self._last_ns, 0) / 1e9, time_ns
        return elapsed
