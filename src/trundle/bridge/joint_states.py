"""Joint positions, velocities and efforts of one model as sensor_msgs/JointState."""

import numpy as np

from trundle.model import JointType, Model
from trundle.names import ros_name
from trundle.ros import Node
from trundle.simulation import Snapshot

_MOVABLE = frozenset({JointType.REVOLUTE, JointType.PRISMATIC, JointType.SCREW})


class JointStates:
    """Publishes `joint_states` for every joint of one degree of freedom, in file order."""

    period_ns = 20_000_000
    """50 Hz"""

    def __init__(self, node: Node, model: Model, *, first_joint: int, topic: str = "joint_states") -> None:
        """Advertise.

        Args:
            node: publishes.
            model: whose joints.
            first_joint: where the model's joints start in `Snapshot.joint_positions`.
            topic: relative to the node's namespace.
        """
        movable = [(i, j) for i, j in enumerate(model.joints) if j.type in _MOVABLE]
        self._names = [ros_name(joint.name) for _, joint in movable]
        self._joints = np.array([first_joint + i for i, _ in movable], dtype=np.intp)
        self._node = node
        self._publisher = node.advertise(topic, "sensor_msgs/JointState", queue_size=5)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish, if anybody listens."""
        if not self._publisher.has_subscribers:
            return
        message = self._node.new(
            "sensor_msgs/JointState",
            {
                "header": {"stamp": self._node.stamp()},
                "name": self._names,
                "position": snapshot.joint_positions[self._joints],
                "velocity": snapshot.joint_velocities[self._joints],
                "effort": snapshot.joint_efforts[self._joints],
            },
        )
        self._publisher.publish(message)
