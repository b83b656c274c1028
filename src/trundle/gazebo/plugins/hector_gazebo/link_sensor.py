"""Base of hector_gazebo's sensors: link, frame and rate."""

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..gazebo_ros.namespaces import rate_to_period_ns
from ..gazebo_ros.ros_plugin import RosPlugin, plugin_names


class LinkSensor(RosPlugin):
    """Sensor on <bodyName> (the first link), with header frame <frameId>, at <updateRate>."""

    def __init__(
        self,
        sim: Simulation,
        model: ModelHandle,
        node: Node,
        parameters: TagParameters,
        *,
        frame: str = "",
        rate_hz: float = 0.0,
    ) -> None:
        super().__init__(sim, model, node, parameters)
        body = parameters.text("bodyName", "")
        self.link = model.link(body) if body else model.base
        self._names = plugin_names(sim, model, node, parameters)
        self.frame = self._names.frame(parameters.text("frameId", frame or self.link.name))
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", rate_hz))
        self.random = np.random.default_rng(sim.seed)
        self._last_ns = sim.time_ns
        parameters.ignore("updatePeriod", "randomEngineSeed")

    def topic(self, name: str) -> str:
        """Global name of a topic."""
        return self._names.topic(name)

    def elapsed_s(self, time_ns: int) -> float:
        """Time since the last call [s]."""
        elapsed, self._last_ns = max(time_ns - self._last_ns, 0) / 1e9, time_ns
        return elapsed
