"""libgazebo_ros_ft_sensor.so: reaction wrench of a joint."""

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Vector3

from .namespaces import rate_to_period_ns
from .ros_plugin import RosPlugin, plugin_names


class FtSensor(RosPlugin):
    """Publishes geometry_msgs/WrenchStamped in the axes of the joint's child: the wrench of the child on its parent.

    Parameters: <jointName> and <topicName> (required), <gaussianNoise> 0, <updateRate> 0 (every step).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        self._joint = model.joint(parameters.text("jointName", ""))
        topic = parameters.text("topicName")
        self._child = model.link(self._joint.joint.child)
        self._noise = parameters.number("gaussianNoise", 0.0)
        self._random = np.random.default_rng(sim.seed)
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 0.0))
        names = plugin_names(sim, model, node, parameters)
        self._frame = names.frame(self._child.name)
        self._topic = names.advertise("geometry_msgs/WrenchStamped", topic, queue_size=10)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the wrench."""
        if not self._topic.has_subscribers:
            return
        on_child = self._joint.reaction
        back = Pose(quaternion=self._child.pose.quaternion).inverse()
        wrench = {"force": self._with_noise(back, on_child.force), "torque": self._with_noise(back, on_child.torque)}
        header = {"stamp": snapshot.time_ns, "frame_id": self._frame}
        self._topic.publish({"header": header, "wrench": wrench})

    def _with_noise(self, back: Pose, vector: Vector3) -> dict[str, float]:
        values = [-value for value in back.transform_vector(vector)]
        if self._noise > 0.0:
            values = [value + float(self._random.normal(0.0, self._noise)) for value in values]
        return dict(zip("xyz", values, strict=True))
