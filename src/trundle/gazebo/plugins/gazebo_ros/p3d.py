"""libgazebo_ros_p3d.so: true pose and velocity of a link."""

from typing import Any

import numpy as np

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation, Snapshot
from trundle.spatial import Pose, Twist

from .namespaces import rate_to_period_ns, read_offset
from .ros_plugin import RosPlugin, plugin_names

_WORLD = frozenset({"", "/", "world", "/world", "map", "/map", "/my_frame"})


class P3D(RosPlugin):
    """Publishes a link's pose and velocity in the frame of another link, or of the world.

    Parameters: <bodyName> and <topicName> (required), <frameName> world, <xyzOffset> and <rpyOffset> 0 0 0 (or
    <xyzOffsets>, <rpyOffsets>), <gaussianNoise> 0, <updateRate> 0 (every step).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        self._link = model.link(parameters.text("bodyName"))
        frame = parameters.text("frameName", "world")
        self._reference: LinkHandle | None = None
        if frame not in _WORLD:
            self._reference = model.link(frame.strip("/"))
        self._offset = read_offset(parameters, ("xyzOffset", "rpyOffset"))
        self._noise = parameters.number("gaussianNoise", 0.0)
        self._random = np.random.default_rng(sim.seed)
        self.period_ns = rate_to_period_ns(parameters.number("updateRate", 0.0))
        names = plugin_names(sim, model, node, parameters)
        self._frame, self._child = names.frame(frame), names.frame(self._link.name)
        self._topic = names.advertise("nav_msgs/Odometry", parameters.text("topicName"))
        variance = self._noise**2
        self._covariance = [variance if index % 7 == 0 else 0.0 for index in range(36)]

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish pose and velocity."""
        if not self._topic.has_subscribers:
            return
        reference_pose, reference_twist = Pose(), Twist()
        if self._reference is not None:
            reference_pose, reference_twist = self._reference.pose, self._reference.twist
        pose, twist = reference_pose.inverse() @ self._link.pose @ self._offset, self._link.twist
        frame_from_world = Pose(quaternion=reference_pose.quaternion).inverse()
        (ax, ay, az), (bx, by, bz) = twist.linear, reference_twist.linear
        (ux, uy, uz), (vx, vy, vz) = twist.angular, reference_twist.angular
        qw, qx, qy, qz = pose.quaternion
        pose_fields = {
            "pose": {
                "position": self._with_noise(pose.position),
                "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
            },
            "covariance": self._covariance,
        }
        twist_fields = {
            "twist": {
                "linear": self._with_noise(frame_from_world.transform_vector((ax - bx, ay - by, az - bz))),
                "angular": self._with_noise(frame_from_world.transform_vector((ux - vx, uy - vy, uz - vz))),
            },
            "covariance": self._covariance,
        }
        header = {"stamp": snapshot.time_ns, "frame_id": self._frame}
        self._topic.publish(
            {"header": header, "child_frame_id": self._child, "pose": pose_fields, "twist": twist_fields}
        )

    def _with_noise(self, vector: tuple[float, float, float]) -> dict[str, Any]:
        if self._noise > 0.0:
            x, y, z = (value + float(self._random.normal(0.0, self._noise)) for value in vector)
            vector = (x, y, z)
        return dict(zip("xyz", vector, strict=True))
