"""libgazebo_ros_f3d.so: external wrench on a link."""

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Wrench

from .ros_plugin import RosPlugin, plugin_names


class F3D(RosPlugin):
    """Publishes geometry_msgs/WrenchStamped at every step: the wrench that plugins and services apply, in world axes.

    Parameters, of gazebo_ros: <bodyName> and <topicName> (required), <frameName> (of the header alone) world. As in
    the original it excludes weight, contacts and joints; force_torque and contact sensors measure those.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        self._link = model.link(parameters.text("bodyName"))
        names = plugin_names(sim, model, node, parameters)
        self._frame = names.frame(parameters.text("frameName", "world"))
        self._topic = names.advertise("geometry_msgs/WrenchStamped", parameters.text("topicName"))
        self._wrench = Wrench()

    def before_step(self, sim: Simulation) -> None:
        """Read the wrench applied so far."""
        self._wrench = sim.engine.wrench(self._link.index)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the wrench."""
        if not self._topic.has_subscribers:
            return
        wrench = {
            "force": dict(zip("xyz", self._wrench.force, strict=True)),
            "torque": dict(zip("xyz", self._wrench.torque, strict=True)),
        }
        self._topic.publish({"header": {"stamp": snapshot.time_ns, "frame_id": self._frame}, "wrench": wrench})
