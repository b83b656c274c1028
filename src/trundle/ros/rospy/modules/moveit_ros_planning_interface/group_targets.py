"""Goals of a group: joint positions, poses, named states."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from geometry_msgs.msg import Pose, PoseStamped
from moveit_msgs.msg import BoundingVolume, Constraints, JointConstraint, OrientationConstraint, PositionConstraint
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive

import rospy
import tf2_ros
from trundle import spatial
from trundle.planning.kinematics import InverseKinematics

from .group_settings import GroupSettings
from .robot_state import (
    pose_from_list,
    quaternion_from_rpy,
    rpy_from_quaternion,
    stamped,
    transform_buffer,
)
from .serialization import from_bytes

_IK_TIMEOUT_S = 0.1
_STATE_WAIT_S = 1.0


class GroupTargets(GroupSettings):
    """One group's goal; what is set last counts."""

    def __init__(self, group: str, robot_description: str = "robot_description", ns: str = "") -> None:
        """Read the model; the target is the middle of the limits.

        Raises:
            RuntimeError: the parameters are missing or invalid, or the group does not exist.
        """
        super().__init__(group, robot_description, ns)
        self._link = super().get_end_effector_link()
        self._frame = self.get_planning_frame()
        self._kind = "joint"
        self._joint_target = self._robot.model.default_positions()
        self._poses: dict[str, list[Any]] = {}
        self._remembered: dict[str, list[float]] = {}

    # -- end effector and frame

    def get_end_effector_link(self) -> str:
        """Return the link of pose targets; empty: there is none."""
        return self._link

    def set_end_effector_link(self, link: str) -> bool:
        """Set the link of pose targets; False: there is none of the name."""
        if link not in self._robot.model.links:
            return False
        self._link = link
        return True

    def get_pose_reference_frame(self) -> str:
        """Return the frame of pose targets without one."""
        return self._frame

    def set_pose_reference_frame(self, frame: str) -> None:
        """Set the frame of pose targets without one."""
        self._frame = frame

    # -- present state

    def get_current_joint_values(self) -> list[float]:
        """Return the group's positions; none if they are not known."""
        return self._robot.select(self._robot.positions(_STATE_WAIT_S), self._group.all_variables)

    def get_random_joint_values(self) -> list[float]:
        """Return random positions within the limits."""
        values = self._robot.random_positions(self._group, self._robot.model.default_positions())
        return self._robot.select(values, self._group.all_variables)

    def get_current_pose(self, link: str = "") -> list[float]:
        """Return x, y, z and quaternion x, y, z, w of a link in the planning frame."""
        return self._pose_of(self._robot.positions(_STATE_WAIT_S), link)

    def get_current_rpy(self, link: str = "") -> list[float]:
        """Return roll, pitch and yaw of a link [rad]."""
        x, y, z, w = self.get_current_pose(link)[3:]
        return list(rpy_from_quaternion(x, y, z, w))

    def get_random_pose(self, link: str = "") -> list[float]:
        """Return the pose of a link at random positions."""
        return self._pose_of(self._robot.random_positions(self._group, self._robot.positions(_STATE_WAIT_S)), link)

    def _pose_of(self, values: np.ndarray, link: str) -> list[float]:
        name = link or self._link
        if name not in self._robot.model.links:
            rospy.logerr("No end-effector specified" if not name else f"There is no link named {name!r}")
            return [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
        return self._robot.link_pose(values, name)

    # -- joint targets

    def set_joint_value_target(self, target: Any, value: Any = None) -> bool:
        """Set positions: a list, by name, or a joint's name with its value or values; False outside the limits."""
        if value is not None:
            values = value if isinstance(value, Sequence) else [value]
            joint = next((joint for joint in self._robot.model.joints if joint.name == target), None)
            if joint is None or joint.name not in self._group.all_joints or len(joint.variables) != len(values):
                rospy.logerr(f"joint {target} is not part of group {self.get_name()}")
                return False
            return self._set_joints(dict(zip(joint.variables, values, strict=True)))
        if isinstance(target, Mapping):
            return self._set_joints(target)
        values = list(target)
        for variables in (self._group.all_variables, self._group.variables):
            if len(variables) == len(values):
                return self._set_joints(dict(zip(variables, values, strict=True)))
        count = len(self._group.all_variables)
        rospy.logerr(
            f"Provided joint value list has length {len(values)} but group {self.get_name()} has {count} joints"
        )
        return False

    def set_joint_value_target_from_joint_state_message(self, message: bytes) -> bool:
        """Set the positions of a serialized sensor_msgs/JointState."""
        state: Any = from_bytes(JointState, message)
        if len(state.name) != len(state.position):
            rospy.logerr("sizes of name and position arrays do not match")
            return False
        return self._set_joints(dict(zip(state.name, state.position, strict=True)))

    def _set_joints(self, positions: Mapping[str, float]) -> bool:
        known = set(self._group.all_variables)
        for name in positions:
            if name not in known:
                rospy.logerr(f"joint variable {name} is not part of group {self.get_name()}")
                return False
        model = self._robot.model
        for name, position in positions.items():
            self._joint_target[model.variable_index(name)] = float(position)
        self._joint_target = model.with_mimics(self._joint_target)
        self._kind = "joint"
        indices = model.indices(self._group.variables)
        values, margin = self._joint_target[indices], self._joint_tolerance
        is_inside = (values >= model.lower[indices] - margin) & (values <= model.upper[indices] + margin)
        return bool(np.all(is_inside | ~model.is_bounded[indices]))

    def set_joint_value_target_from_pose(self, pose: bytes, link: str = "", approximate: bool = False) -> bool:
        """Set positions by inverse kinematics for a serialized geometry_msgs/Pose."""
        return self._solve(stamped(from_bytes(Pose, pose), self._frame), link)

    def set_joint_value_target_from_pose_stamped(self, pose: bytes, link: str = "", approximate: bool = False) -> bool:
        """Set positions by inverse kinematics for a serialized geometry_msgs/PoseStamped."""
        return self._solve(from_bytes(PoseStamped, pose), link)

    def _solve(self, pose: Any, link: str) -> bool:
        name = link or self._link
        model_from_target = self._in_planning_frame(pose)
        if model_from_target is None:
            return False
        solver = InverseKinematics(self._robot.kinematics, self._group.name, name or None)
        found = solver.solve(model_from_target, self._joint_target, timeout=_IK_TIMEOUT_S)
        if found is None:
            return False
        self._joint_target, self._kind = np.asarray(found, dtype=np.float64), "joint"
        return True

    def _in_planning_frame(self, pose: Any) -> "spatial.Pose | None":
        """Return a pose in the planning frame; None where tf does not know its frame."""
        p, q = pose.pose.position, pose.pose.orientation
        local = spatial.Pose((p.x, p.y, p.z), (q.w, q.x, q.y, q.z))
        frame, planning = pose.header.frame_id.lstrip("/"), self.get_planning_frame()
        if not frame or frame == planning:
            return local
        if frame in self._robot.model.links:
            x, y, z, qx, qy, qz, qw = self._robot.link_pose(self._robot.positions(_STATE_WAIT_S), frame)
            return spatial.Pose((x, y, z), (qw, qx, qy, qz)) @ local
        try:
            found = transform_buffer().lookup_transform(planning, frame, rospy.Time(), rospy.Duration(1.0)).transform
        except tf2_ros.TransformException as error:
            rospy.logerr(f"Unable to transform from frame '{frame}' to frame '{planning}': {error}")
            return None
        t, r = found.translation, found.rotation
        return spatial.Pose((t.x, t.y, t.z), (r.w, r.x, r.y, r.z)) @ local

    def get_joint_value_target(self) -> list[float]:
        """Return the joint target."""
        return self._robot.select(self._joint_target, self._group.all_variables)

    def set_random_target(self) -> None:
        """Set random positions within the limits."""
        self._joint_target = self._robot.random_positions(self._group, self._joint_target)
        self._kind = "joint"

    # -- named states

    def get_named_targets(self) -> list[str]:
        """Return the SRDF's named states and the remembered ones."""
        return [*self._group.default_states, *(n for n in self._remembered if n not in self._group.default_states)]

    def get_named_target_values(self, name: str) -> dict[str, float]:
        """Return positions by joint of a named state."""
        if name in self._remembered:
            return dict(zip(self._group.all_variables, self._remembered[name], strict=False))
        if name in self._group.default_states:
            return dict(self._group.default_states[name])
        rospy.logerr(f"The requested named target '{name}' does not exist")
        return {}

    def set_named_target(self, name: str) -> bool:
        """Set the positions of a named state; False: there is none."""
        if name in self._remembered:
            return self.set_joint_value_target(self._remembered[name])
        if name in self._group.default_states:
            return self._set_joints(self._group.default_states[name])
        known = ", ".join(self.get_named_targets()) or "none"
        rospy.logerr(f"The requested named target '{name}' does not exist; named targets: {known}")
        return False

    def remember_joint_values(self, name: str, values: Iterable[float] | None = None) -> None:
        """Remember positions under a name; by default the present ones."""
        self._remembered[name] = self.get_current_joint_values() if values is None else list(values)

    def get_remembered_joint_values(self) -> dict[str, list[float]]:
        """Return all remembered positions."""
        return dict(self._remembered)

    def forget_joint_values(self, name: str) -> None:
        """Forget remembered positions."""
        self._remembered.pop(name, None)

    # -- pose targets

    def set_pose_target(self, pose: Sequence[float], link: str = "") -> bool:
        """Set a pose of x, y, z and a quaternion x, y, z, w, or roll, pitch, yaw."""
        return self._set_poses([stamped(pose_from_list(pose), self._frame)], link, "pose")

    def set_pose_targets(self, poses: Sequence[Sequence[float]], link: str = "") -> bool:
        """Set poses, any of which reaches the goal."""
        return self._set_poses([stamped(pose_from_list(pose), self._frame) for pose in poses], link, "pose")

    def set_position_target(self, x: float, y: float, z: float, link: str = "") -> bool:
        """Set a position, with any orientation."""
        pose = self._present_target(link)
        p = pose.pose.position
        p.x, p.y, p.z = float(x), float(y), float(z)
        return self._set_poses([pose], link, "position")

    def set_rpy_target(self, r: float, p: float, y: float, link: str = "") -> bool:
        """Set an orientation, at any position."""
        return self.set_orientation_target(*quaternion_from_rpy(r, p, y), link)

    def set_orientation_target(self, x: float, y: float, z: float, w: float, link: str = "") -> bool:
        """Set an orientation, at any position."""
        pose = self._present_target(link)
        q = pose.pose.orientation
        q.x, q.y, q.z, q.w = float(x), float(y), float(z), float(w)
        return self._set_poses([pose], link, "orientation")

    def _present_target(self, link: str) -> Any:
        poses = self._poses.get(link or self._link)
        if poses:
            return poses[0]
        return stamped(pose_from_list([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]), self._frame)

    def _set_poses(self, poses: list[Any], link: str, kind: str) -> bool:
        name = link or self._link
        if not name:
            rospy.logerr("No end-effector to set the pose for")
            return False
        if not poses:
            rospy.logerr("No pose specified as goal target")
            return False
        for pose in poses:
            pose.header.stamp = rospy.Time()
        self._poses[name], self._kind = poses, kind
        return True

    def clear_pose_target(self, link: str = "") -> None:
        """Drop the pose target of a link."""
        self._poses.pop(link or self._link, None)

    def clear_pose_targets(self) -> None:
        """Drop all pose targets."""
        self._poses.clear()

    # -- the goal of a request

    def _goal(self) -> list[Any]:
        """Return the alternatives of the goal as moveit_msgs/Constraints; none: no target is set."""
        if self._kind == "joint":
            goal: Any = Constraints()
            for name in self._group.variables:
                joint: Any = JointConstraint()
                joint.joint_name = name
                joint.position = float(self._joint_target[self._robot.model.variable_index(name)])
                joint.tolerance_above = joint.tolerance_below = self._joint_tolerance
                joint.weight = 1.0
                goal.joint_constraints.append(joint)
            return [goal]
        alternatives = max((len(poses) for poses in self._poses.values()), default=0)
        goals: list[Any] = [Constraints() for _ in range(alternatives)]
        for link, poses in self._poses.items():
            for index, goal in enumerate(goals):
                pose = poses[min(index, len(poses) - 1)]
                if self._kind != "orientation":
                    goal.position_constraints.append(self._position_constraint(pose, link))
                if self._kind != "position":
                    goal.orientation_constraints.append(self._orientation_constraint(pose, link))
        return goals

    def _position_constraint(self, pose: Any, link: str) -> Any:
        constraint: Any = PositionConstraint()
        constraint.header, constraint.link_name, constraint.weight = pose.header, link, 1.0
        sphere: Any = SolidPrimitive()
        sphere.type, sphere.dimensions = SolidPrimitive.SPHERE, [self._position_tolerance]
        region: Any = BoundingVolume()
        center: Any = Pose()
        center.position, center.orientation.w = pose.pose.position, 1.0
        region.primitives, region.primitive_poses = [sphere], [center]
        constraint.constraint_region = region
        return constraint

    def _orientation_constraint(self, pose: Any, link: str) -> Any:
        constraint: Any = OrientationConstraint()
        constraint.header, constraint.link_name, constraint.weight = pose.header, link, 1.0
        constraint.orientation = pose.pose.orientation
        tolerance = self._orientation_tolerance
        constraint.absolute_x_axis_tolerance = tolerance
        constraint.absolute_y_axis_tolerance = tolerance
        constraint.absolute_z_axis_tolerance = tolerance
        return constraint
