"""libgazebo_ros_force.so: a wrench on a link, from a topic."""

from typing import TYPE_CHECKING

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Wrench

from .ros_plugin import RosPlugin, plugin_names

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs


class Force(RosPlugin):
    """Applies the last geometry_msgs/Wrench of <topicName>, in world axes, to <bodyName> at every step."""

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        self._link = model.link(parameters.text("bodyName", ""))
        topic = parameters.text("topicName")
        self._wrench = Wrench()
        plugin_names(sim, model, node, parameters).subscribe(topic, "geometry_msgs/Wrench", self._on_wrench)

    def before_step(self, sim: Simulation) -> None:
        """Apply the wrench."""
        del sim
        if self._wrench != Wrench():
            self._link.add_wrench(self._wrench)

    def reset(self) -> None:
        """Set the wrench to zero."""
        self._wrench = Wrench()

    def _on_wrench(self, message: "geometry_msgs.Wrench") -> None:
        force, torque = message.force, message.torque
        self._wrench = Wrench((force.x, force.y, force.z), (torque.x, torque.y, torque.z))
