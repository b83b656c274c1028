"""Joint positions, velocities and efforts of one model as sensor_msgs/JointState."""

import numpy as np

from trundle.robots.model import JointType
from trundle.robots.names import ros_name
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Snapshot

_MOVABLE = frozenset({JointType.REVOLUTE, JointType.PRISMATIC, JointType.SCREW})


class JointStatesTopic:
    """Publishes `joint_states` for every joint of one degree of freedom, in file order."""

    period_ns = 20_000_000
    """Period of 50 Hz."""

    def __init__(self, node: Node, model: ModelHandle, *, topic: str = "/joint_states") -> None:
        """Advertise the joints of one model."""
        self._publisher = node.advertise(topic, "sensor_msgs/JointState", queue_size=5)
        self.set_model(model)

    def set_model(self, model: ModelHandle | None) -> None:
        """Update the joints' indices after a change of the world; None: the model was deleted."""
        self._has_model = model is not None
        movable = [handle for handle in ([] if model is None else model.joints) if handle.joint.type in _MOVABLE]
        self._names = [ros_name(handle.name) for handle in movable]
        self._joints = np.array([handle.index for handle in movable], dtype=np.intp)

    def enabled(self) -> bool:
        """True if there is a model, and a subscriber."""
        return self._has_model and self._publisher.has_subscribers

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish."""
        self._publisher.publish(
            {
                "header": {"stamp": snapshot.time_ns},
                "name": self._names,
                "position": snapshot.joint_positions[self._joints],
                "velocity": snapshot.joint_velocities[self._joints],
                "effort": snapshot.joint_efforts[self._joints],
            }
        )
