"""The robot of a `robot_description`, and its present state from joint_states and tf."""

import math
import threading
from collections.abc import Sequence
from typing import Any

import numpy as np
from geometry_msgs.msg import Pose, PoseStamped, Transform
from moveit_msgs.msg import RobotState
from sensor_msgs.msg import JointState

import rospy
import tf2_ros
from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.planning.kinematics import Kinematics
from trundle.planning.robot_model import RobotModel, robot_model

from ._moveit_roscpp_initializer import ensure_node

_lock = threading.Lock()
_robots: dict[tuple[str, str], "SharedRobot"] = {}
_buffer: Any = None


def shared_robot(description: str, namespace: str = "") -> "SharedRobot":
    """Return the robot of a parameter, which all groups of the program share.

    Raises:
        RuntimeError: the parameters are missing or invalid.
    """
    ensure_node()
    key = (description, namespace)
    with _lock:
        if key not in _robots:
            _robots[key] = SharedRobot(description, namespace)
        return _robots[key]


def transform_buffer() -> Any:
    """Return the program's tf buffer, which listens from the first call on."""
    global _buffer
    with _lock:
        if _buffer is None:
            _buffer = tf2_ros.Buffer()
            _buffer.listener = tf2_ros.TransformListener(_buffer)
        return _buffer


def in_namespace(namespace: str, name: str) -> str:
    """Put a relative name into a namespace."""
    return f"{namespace.rstrip('/')}/{name}" if namespace else name


class SharedRobot:
    """The model with its kinematics, and the positions that joint_states and tf reported last."""

    def __init__(self, description: str, namespace: str = "") -> None:
        """Read the model from the parameters `description` and `description_semantic`.

        Raises:
            RuntimeError: the parameters are missing or invalid.
        """
        self.description = description
        self.namespace = namespace
        self.model = self._read()
        self.kinematics = Kinematics(self.model)
        self._received: dict[str, float] = {}
        self._stamp = rospy.Time()
        self._changed = threading.Condition()
        self._is_monitoring = False

    def _read(self) -> RobotModel:
        texts: list[str] = []
        key: str | None = ""
        for name in (self.description, f"{self.description}_semantic"):
            key = _find_parameter(name) or _find_parameter(in_namespace(self.namespace, name))
            if key is None:
                what = "Please make sure all needed information is on the parameter server"
                raise RuntimeError(f"Unable to construct robot model. {what}: {name} is not set")
            texts.append(str(rospy.get_param(key)))
        limits = rospy.get_param(f"{key.removesuffix('_semantic')}_planning/joint_limits", {})
        try:
            return robot_model(texts[0], texts[1], limits, Diagnostics())
        except TrundleError as error:
            raise RuntimeError(f"Unable to construct robot model: {error}") from error

    def group(self, name: str) -> Any:
        """Return a group of the SRDF.

        Raises:
            RuntimeError: there is none of the name.
        """
        group = self.model.groups.get(name)
        if group is None:
            raise RuntimeError(f"Group '{name}' was not found.")
        return group

    def start_monitor(self) -> None:
        """Listen to joint_states from now on."""
        with self._changed:
            if self._is_monitoring:
                return
            self._is_monitoring = True
        rospy.Subscriber(in_namespace(self.namespace, "joint_states"), JointState, self._receive, queue_size=25)
        transform_buffer()

    def _receive(self, message: Any) -> None:
        with self._changed:
            self._received.update(zip(message.name, message.position, strict=False))
            self._stamp = max(message.header.stamp, self._stamp)
            self._changed.notify_all()

    def wait_for_state(self, wait_s: float) -> bool:
        """Wait until every active joint was reported after the call; False if that takes longer."""
        self.start_monitor()
        called = rospy.get_rostime()
        deadline = rospy.get_time() + wait_s
        needed = [
            joint.name
            for joint in self.model.joints
            if len(joint.variables) == 1 and not joint.passive and joint.mimic is None
        ]
        while True:
            with self._changed:
                if self._stamp >= called and all(name in self._received for name in needed):
                    return True
                self._changed.wait(0.02)
            if rospy.get_time() > deadline or rospy.is_shutdown():
                return all(name in self._received for name in needed)

    def positions(self, wait_s: float = 1.0) -> np.ndarray:
        """Return the present state vector, as long as it takes to know all joints, but no longer than `wait_s`."""
        if not self.wait_for_state(wait_s):
            rospy.logwarn_once("The complete state of the robot is not yet known: not every joint is on joint_states")
        model = self.model
        values = model.default_positions()
        with self._changed:
            for name, position in self._received.items():
                if name in model.variables and math.isfinite(position):
                    values[model.variable_index(name)] = position
        for joint in model.joints:
            if len(joint.variables) > 1:
                self._place(joint, values)
        return model.with_mimics(values)

    def _place(self, joint: Any, values: np.ndarray) -> None:
        """Set a planar or floating joint from tf, where it is known."""
        parent = joint.parent_link or self.model.model_frame
        try:
            found = transform_buffer().lookup_transform(parent, joint.child_link, rospy.Time()).transform
        except tf2_ros.TransformException:
            return
        values[self.model.indices(joint.variables)] = _numbers_of(found, joint.type)

    def random_positions(self, group: Any, values: np.ndarray) -> np.ndarray:
        """Return a state with random positions of a group, within its limits."""
        values = values.copy()
        indices = self.model.indices(group.variables)
        lower, upper = self.model.lower[indices], self.model.upper[indices]
        is_finite = np.isfinite(lower) & np.isfinite(upper)
        values[indices[is_finite]] = np.random.default_rng().uniform(lower[is_finite], upper[is_finite])
        return self.model.with_mimics(values)

    def select(self, values: np.ndarray, variables: Sequence[str]) -> list[float]:
        """Return the positions of some variables."""
        return [float(values[self.model.variable_index(name)]) for name in variables]

    def link_pose(self, values: np.ndarray, link: str) -> list[float]:
        """Return x, y, z [m] and the quaternion x, y, z, w of a link in the model's frame."""
        index = list(self.model.links).index(link)
        return [float(number) for number in self.kinematics.link_poses(values)[index]]

    def message(self, values: np.ndarray) -> Any:
        """Return a state as moveit_msgs/RobotState, without a stamp, as MoveIt does."""
        state = RobotState()
        state.joint_state.header.frame_id = state.multi_dof_joint_state.header.frame_id = self.model.model_frame
        for joint in self.model.joints:
            numbers = self.select(values, joint.variables)
            if len(numbers) == 1:
                state.joint_state.name.append(joint.variables[0])
                state.joint_state.position.append(numbers[0])
            elif numbers:
                state.multi_dof_joint_state.joint_names.append(joint.name)
                state.multi_dof_joint_state.transforms.append(_transform(numbers))
        return state

    def with_message(self, values: np.ndarray, state: Any) -> np.ndarray:
        """Return a state changed by a moveit_msgs/RobotState."""
        values = values.copy()
        for name, position in zip(state.joint_state.name, state.joint_state.position, strict=False):
            if name in self.model.variables:
                values[self.model.variable_index(name)] = position
        several = state.multi_dof_joint_state
        for name, transform in zip(several.joint_names, several.transforms, strict=False):
            if self.model.has_joint(name):
                joint = self.model.joint(name)
                values[self.model.indices(joint.variables)] = _numbers_of(transform, joint.type)
        return self.model.with_mimics(values)


def _find_parameter(name: str) -> str | None:
    """Return the full name of a parameter in the program's namespaces; None if it is not set."""
    key = rospy.search_param(name)  # finds the first namespace of the name alone
    return key if key is not None and rospy.has_param(key) else None


def _numbers_of(transform: Any, kind: str) -> list[float]:
    """Return the positions of a planar or floating joint of a geometry_msgs/Transform."""
    t, q = transform.translation, transform.rotation
    if kind == "planar":
        return [t.x, t.y, math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))]
    return [t.x, t.y, t.z, q.x, q.y, q.z, q.w]


def _transform(numbers: Sequence[float]) -> Any:
    """Return the geometry_msgs/Transform of a planar (3) or floating joint (7)."""
    if len(numbers) == 3:
        x, y, yaw = numbers
        numbers = (x, y, 0.0, *quaternion_from_rpy(0.0, 0.0, yaw))
    transform = Transform()
    t, q = transform.translation, transform.rotation
    t.x, t.y, t.z, q.x, q.y, q.z, q.w = numbers
    return transform


def pose_from_list(numbers: Sequence[float]) -> Any:
    """Make a pose of x, y, z and a quaternion x, y, z, w, or roll, pitch, yaw.

    Raises:
        RuntimeError: neither 6 nor 7 numbers.
    """
    pose = Pose()
    if len(numbers) not in (6, 7):
        raise RuntimeError(f"Pose description expected to consist of either 6 or 7 values, not {len(numbers)}")
    pose.position.x, pose.position.y, pose.position.z = map(float, numbers[:3])
    q = pose.orientation
    q.x, q.y, q.z, q.w = map(float, numbers[3:]) if len(numbers) == 7 else quaternion_from_rpy(*numbers[3:])
    return pose


def stamped(pose: Any, frame: str) -> Any:
    """Return a pose with its frame, at the time 0."""
    result = PoseStamped()
    result.header.frame_id = frame
    result.pose = pose
    return result


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """Return x, y, z, w of a rotation by roll about x, then pitch about y, then yaw about z, all fixed axes [rad]."""
    sr, cr = math.sin(roll / 2.0), math.cos(roll / 2.0)
    sp, cp = math.sin(pitch / 2.0), math.cos(pitch / 2.0)
    sy, cy = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def rpy_from_quaternion(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """Return roll, pitch and yaw [rad] of a unit quaternion."""
    pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * y - z * x))))
    return (
        math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        pitch,
        math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )
