"""libgazebo_ros_joint_state_publisher.so: positions and velocities of joints on joint_states."""

import re

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot

from .namespaces import rate_to_period_ns
from .ros_plugin import RosPlugin, plugin_names


class JointStatePublisher(RosPlugin):
    """Publishes `joint_states`.

    Parameters: <jointName> (names separated by commas or spaces; default: all joints), <updateRate> 100.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        listed = [name for name in re.split(r"[\s,]+", parameters.text("jointName", "")) if name]
        self._joints = [model.joint(name) for name in listed] or [joint for joint in model.joints if joint.axes]
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 100.0))
        names = plugin_names(sim, model, node, parameters)
        self._states = names.advertise("sensor_msgs/JointState", "joint_states", queue_size=1000)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the joint states."""
        if not self._states.has_subscribers:
            return
        self._states.publish(
            {
                "header": {"stamp": snapshot.time_ns},
                "name": [joint.name for joint in self._joints],
                "position": [joint.position for joint in self._joints],
                "velocity": [joint.velocity for joint in self._joints],
            }
        )
