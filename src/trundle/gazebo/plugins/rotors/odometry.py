"""librotors_gazebo_odometry_plugin.so: pose and velocity of a link, with delay and noise."""

import math
from collections import deque
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import TagParameters
from trundle.ros import Node, Transform, TransformBroadcaster
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation, Snapshot
from trundle.spatial import NS_PER_S, ZERO, Pose, Quaternion, Twist, cross, quaternion_product

from ..gazebo_ros.ros_plugin import RosPlugin
from .namespaces import read_topic_name

_TOPICS = {
    "poseTopic": ("pose", "geometry_msgs/Pose"),
    "poseWithCovarianceTopic": ("pose_with_covariance", "geometry_msgs/PoseWithCovarianceStamped"),
    "positionTopic": ("position", "geometry_msgs/PointStamped"),
    "transformTopic": ("transform", "geometry_msgs/TransformStamped"),
    "odometryTopic": ("odometry", "nav_msgs/Odometry"),
}
_NOISES = ("Position", "Quaternion", "LinearVelocity", "AngularVelocity")
_WORLD = "world"


class Odometry(RosPlugin):
    """Publishes the pose of a link's centre of mass on five topics and /tf, and velocities in its own axes.

    Parameters, with RotorS' defaults: <robotNamespace>, <linkName> (required), <poseTopic> pose,
    <poseWithCovarianceTopic> pose_with_covariance, <positionTopic> position, <transformTopic> transform,
    <odometryTopic> odometry, <parentFrameId> world (else `model::link`), <childFrameId> odometry_sensor,
    <measurementDivisor> 1 [steps], <measurementDelay> 0 [steps], <unknownDelay> 0 [s, whole ones] in the stamp,
    <noiseNormal…> (deviation) and <noiseUniform…> (bound) 0 0 0 of Position, Quaternion, LinearVelocity and
    AngularVelocity, <randomEngineSeed> (the simulation's).
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        self._link = model.link(parameters.text("linkName"))
        self._frame = parameters.text("parentFrameId", _WORLD)
        self._child = parameters.text("childFrameId", "odometry_sensor")
        self._reference: LinkHandle | None = None
        if self._frame != _WORLD:
            owner, _, name = self._frame.partition("::")
            self._reference = sim[owner].link(name) if name else sim[owner].base
        self._divisor = parameters.integer("measurementDivisor", 1, minimum=1)
        self._delay = parameters.integer("measurementDelay", 0, minimum=0)
        self._unknown_delay_ns = int(parameters.number("unknownDelay", 0.0)) * NS_PER_S
        self._random = np.random.default_rng(parameters.integer("randomEngineSeed", sim.seed))

        def spread(kind: str) -> NDArray[np.float64]:
            rows = [parameters.vector(f"noise{kind}{of}", ZERO) for of in _NOISES]
            return np.abs(np.array(rows))

        self._normal, self._uniform = spread("Normal"), spread("Uniform")
        parameters.warn_unsupported("covarianceImage", "covarianceImageScale")
        self._topics = {
            name: node.advertise(read_topic_name(parameters, name, default), kind, queue_size=1)
            for name, (default, kind) in _TOPICS.items()
        }
        self._broadcaster = TransformBroadcaster(node)
        variances = (self._normal**2).reshape(2, 6)
        self._covariances = [np.diag(row).ravel().tolist() for row in variances]
        self.reset()

    def after_step(self, snapshot: Snapshot) -> None:
        """Measure every <measurementDivisor> steps, and publish after the delay, if there are subscribers."""
        if not any(topic.has_subscribers for topic in (*self._topics.values(), self._broadcaster)):
            self._measured.clear()
        elif self._steps % self._divisor == 0:
            self._measured.append(
                (self._steps + self._delay, snapshot.time_ns + self._unknown_delay_ns, *self._motion())
            )
        if self._measured and self._measured[0][0] == self._steps:
            _, stamp_ns, pose, twist = self._measured.popleft()
            self._publish(stamp_ns, *self._with_noise(pose, twist))
        self._steps += 1

    def reset(self) -> None:
        """Drop the delayed measurements."""
        self._steps = 0
        self._measured: deque[tuple[int, int, Pose, Twist]] = deque()

    def _motion(self) -> tuple[Pose, Twist]:
        """Pose of the centre of mass in the reference frame, and twist of the link's origin in the link's axes."""
        link, twist = self._link.pose, self._link.twist
        com = link.transform_point(self._link.link.inertial.link_from_com.position)
        pose, linear, angular = Pose(com, link.quaternion), twist.linear, twist.angular
        if self._reference is not None:
            reference_pose, reference_twist = self._reference.pose, self._reference.twist
            arm = np.subtract(com, reference_pose.position)
            rotation_velocity = cross(reference_twist.angular, (float(arm[0]), float(arm[1]), float(arm[2])))
            pose = reference_pose.inverse() @ pose
            vx, vy, vz = (v - c - s for v, c, s in zip(linear, reference_twist.linear, rotation_velocity, strict=True))
            wx, wy, wz = (w - c for w, c in zip(angular, reference_twist.angular, strict=True))
            linear, angular = (vx, vy, vz), (wx, wy, wz)
        link_from_world = Pose(quaternion=link.quaternion).inverse()
        return pose, Twist(link_from_world.transform_vector(linear), link_from_world.transform_vector(angular))

    def _with_noise(self, pose: Pose, twist: Twist) -> tuple[Pose, Twist]:
        errors = self._random.normal(size=(4, 3)) * self._normal
        errors += self._random.uniform(-1.0, 1.0, size=(4, 3)) * self._uniform
        values = (pose.position, ZERO, twist.linear, twist.angular)
        position, turn, linear, angular = ((x, y, z) for x, y, z in (np.array(values) + errors).tolist())
        quaternion = quaternion_product(pose.quaternion, _small_turn(turn))
        return Pose(position, quaternion), Twist(linear, angular)

    def _publish(self, stamp_ns: int, pose: Pose, twist: Twist) -> None:
        (x, y, z), (qw, qx, qy, qz) = pose.position, pose.quaternion
        self._broadcaster.send_transform(
            Transform(
                parent=self._frame,
                child=self._child,
                stamp_ns=stamp_ns,
                translation=(x, y, z),
                rotation=pose.quaternion,
            )
        )
        header = {"stamp": stamp_ns, "frame_id": self._frame}
        position, orientation = {"x": x, "y": y, "z": z}, {"x": qx, "y": qy, "z": qz, "w": qw}
        pose_fields = {"position": position, "orientation": orientation}
        speeds = {name: dict(zip("xyz", getattr(twist, name), strict=True)) for name in ("linear", "angular")}
        with_covariance = {"pose": pose_fields, "covariance": self._covariances[0]}
        messages: dict[str, dict[str, Any]] = {
            "poseTopic": pose_fields,
            "poseWithCovarianceTopic": {"header": header, "pose": with_covariance},
            "positionTopic": {"header": header, "point": position},
            "transformTopic": {"header": header, "transform": {"translation": position, "rotation": orientation}},
            "odometryTopic": {
                "header": header,
                "child_frame_id": self._child,
                "pose": with_covariance,
                "twist": {"twist": speeds, "covariance": self._covariances[1]},
            },
        }
        for name, topic in self._topics.items():
            if topic.has_subscribers:
                topic.publish(messages[name])


def _small_turn(angles: tuple[float, float, float]) -> Quaternion:
    """Rotation by small angles [rad]."""
    x, y, z = (angle / 2.0 for angle in angles)
    w = 1.0 - x * x - y * y - z * z
    if w > 0.0:
        return math.sqrt(w), x, y, z
    length = math.sqrt(2.0 - w)
    return 1.0 / length, x / length, y / length, z / length
