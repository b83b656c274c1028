"""Commands to one group of a robot."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from geometry_msgs.msg import Pose, PoseStamped
from moveit_msgs.msg import (
    Constraints,
    Grasp,
    MotionPlanRequest,
    MoveItErrorCodes,
    PlaceLocation,
    RobotTrajectory,
)
from sensor_msgs.msg import JointState

from moveit_ros_planning_interface.robot_state import quaternion_from_rpy, rpy_from_quaternion
from moveit_ros_planning_interface.serialization import from_bytes, to_bytes

from . import conversions
from .exception import MoveItCommanderException
from .group_state import GroupState
from .plan_result import plan_result

_NO_LINK = "There is no end effector to set the pose for"
_LOCATIONS = (
    "Parameter location must be a Pose, PoseStamped, PlaceLocation, list of PoseStamped or list of PlaceLocation object"
)


class MoveGroupCommander(GroupState):
    """Sets targets of a group, plans to them, and moves."""

    def stop(self) -> None:
        """Stop the robot."""
        self._g.stop()

    # -- joint targets

    def get_joint_value_target(self) -> list[float]:
        """Return the joint target."""
        return self._g.get_joint_value_target()

    def set_joint_value_target(self, arg1: Any, arg2: Any = None, arg3: Any = None) -> None:
        """Set the joint target.

        Args:
            arg1: positions in the group's order or by name, a sensor_msgs/JointState, the name of a joint, or a pose
                for inverse kinematics (geometry_msgs/Pose or PoseStamped).
            arg2: with a joint's name, its position or positions; with a pose, the link, or whether an approximate
                solution will do.
            arg3: with a pose and a link, whether an approximate solution will do.
        """
        if isinstance(arg1, JointState):
            if arg2 is not None or arg3 is not None:
                raise MoveItCommanderException("Too many arguments specified")
            self._accept(self._g.set_joint_value_target_from_joint_state_message(to_bytes(arg1)))
        elif isinstance(arg1, str):
            if arg2 is None:
                raise MoveItCommanderException("Joint value expected when joint name specified")
            if arg3 is not None:
                raise MoveItCommanderException("Too many arguments specified")
            self._accept(self._g.set_joint_value_target(arg1, arg2))
        elif isinstance(arg1, Pose | PoseStamped):
            self._set_joints_of_pose(arg1, arg2, arg3)
        elif isinstance(arg1, Mapping) or hasattr(arg1, "__iter__"):
            if arg2 is not None or arg3 is not None:
                raise MoveItCommanderException("Too many arguments specified")
            self._accept(self._g.set_joint_value_target(arg1))
        else:
            raise MoveItCommanderException(f"Unsupported argument of type {type(arg1)}")

    @staticmethod
    def _accept(is_set: bool) -> None:
        if not is_set:
            raise MoveItCommanderException("Error setting joint target. Is the target within bounds?")

    def _set_joints_of_pose(self, pose: Any, arg2: Any, arg3: Any) -> None:
        link, is_approximate = "", False
        for argument in (arg2, arg3):
            if isinstance(argument, bool):
                is_approximate = argument
            elif isinstance(argument, str):
                link = argument
            elif argument is not None:
                raise MoveItCommanderException("Unexpected type")
        is_stamped = isinstance(pose, PoseStamped)
        solve = (
            self._g.set_joint_value_target_from_pose_stamped
            if is_stamped
            else (self._g.set_joint_value_target_from_pose)
        )
        if not solve(to_bytes(pose), link, is_approximate):
            question = (
                "Does your IK solver support approximate IK?" if is_approximate else "Is the IK solver functional?"
            )
            raise MoveItCommanderException(f"Error setting joint target. {question}")

    def set_random_target(self) -> None:
        """Set random positions within the limits."""
        self._g.set_random_target()

    def set_named_target(self, name: str) -> None:
        """Set the positions of a state of the SRDF, or of a remembered one."""
        if not self._g.set_named_target(name):
            raise MoveItCommanderException(f"Unable to set target {name}. Is the target within bounds?")

    # -- pose targets

    def _check_link(self, link: str, otherwise: str = _NO_LINK) -> None:
        if not link and not self.has_end_effector_link():
            raise MoveItCommanderException(otherwise)

    def set_rpy_target(self, rpy: Sequence[float], end_effector_link: str = "") -> None:
        """Set roll, pitch, yaw [rad], at any position."""
        self._check_link(end_effector_link)
        if len(rpy) != 3:
            raise MoveItCommanderException("Expected [roll, pitch, yaw]")
        if not self._g.set_rpy_target(rpy[0], rpy[1], rpy[2], end_effector_link):
            raise MoveItCommanderException("Unable to set orientation target")

    def set_orientation_target(self, q: Sequence[float], end_effector_link: str = "") -> None:
        """Set a quaternion x, y, z, w, at any position."""
        self._check_link(end_effector_link)
        if len(q) != 4:
            raise MoveItCommanderException("Expected [qx, qy, qz, qw]")
        if not self._g.set_orientation_target(q[0], q[1], q[2], q[3], end_effector_link):
            raise MoveItCommanderException("Unable to set orientation target")

    def set_position_target(self, xyz: Sequence[float], end_effector_link: str = "") -> None:
        """Set a position [m], with any orientation."""
        self._check_link(end_effector_link)
        if not self._g.set_position_target(xyz[0], xyz[1], xyz[2], end_effector_link):
            raise MoveItCommanderException("Unable to set position target")

    def set_pose_target(self, pose: Any, end_effector_link: str = "") -> None:
        """Set a geometry_msgs/Pose or PoseStamped, or numbers: x, y, z with a quaternion, or with roll, pitch, yaw."""
        self._check_link(end_effector_link)
        previous = self.get_pose_reference_frame()
        if type(pose) is PoseStamped:
            self.set_pose_reference_frame(pose.header.frame_id)
        try:
            if not self._g.set_pose_target(self._numbers(pose), end_effector_link):
                raise MoveItCommanderException("Unable to set target pose")
        finally:
            self.set_pose_reference_frame(previous)

    def set_pose_targets(self, poses: Iterable[Any], end_effector_link: str = "") -> None:
        """Set poses, any of which reaches the goal."""
        self._check_link(end_effector_link, "There is no end effector to set poses for")
        if not self._g.set_pose_targets([self._numbers(pose) for pose in poses], end_effector_link):
            raise MoveItCommanderException("Unable to set target poses")

    def shift_pose_target(self, axis: int, value: float, end_effector_link: str = "") -> None:
        """Set the present pose, shifted along or turned about an axis (0 … 5: x, y, z, roll, pitch, yaw)."""
        self._check_link(end_effector_link, "There is no end effector to set poses for")
        if axis not in range(6):
            raise MoveItCommanderException("An axis value between 0 and 5 expected")
        numbers = self._g.get_current_pose(end_effector_link)
        x, y, z, w = numbers[3:]
        values = [*numbers[:3], *rpy_from_quaternion(x, y, z, w)]
        values[axis] += value
        self.set_pose_target([*values[:3], *quaternion_from_rpy(*values[3:])], end_effector_link)

    def clear_pose_target(self, end_effector_link: str) -> None:
        """Drop the pose target of a link."""
        self._g.clear_pose_target(end_effector_link)

    def clear_pose_targets(self) -> None:
        """Drop all pose targets."""
        self._g.clear_pose_targets()

    # -- plans and motions

    def go(self, joints: Any = None, wait: bool = True) -> bool:
        """Plan to a target, or to the one set before, and move; True if the motion succeeded, or was sent."""
        if isinstance(joints, bool):
            joints, wait = None, joints
        self._set_any(joints)
        return self._g.move() if wait else self._g.async_move()

    def plan(self, joints: Any = None) -> Any:
        """Plan to a target, or to the one set before.

        Returns:
            (success, moveit_msgs/RobotTrajectory, planning time [s], moveit_msgs/MoveItErrorCodes); on a graph of a
            distribution before Noetic, the trajectory alone.
        """
        self._set_any(joints)
        code, trajectory, planning_time_s = self._g.plan()
        error_code: Any = from_bytes(MoveItErrorCodes, code)
        return plan_result(
            is_success=error_code.val == MoveItErrorCodes.SUCCESS,
            trajectory=from_bytes(RobotTrajectory, trajectory),
            planning_time_s=planning_time_s,
            error_code=error_code,
        )

    def _set_any(self, joints: Any) -> None:
        if joints is None:
            return
        if isinstance(joints, Pose | PoseStamped):
            self.set_pose_target(joints)
        elif isinstance(joints, str):
            remembered = self.get_remembered_joint_values()
            if joints in remembered:
                self.set_joint_value_target(remembered[joints])
            else:
                self.set_named_target(joints)
        else:
            self.set_joint_value_target(joints)

    def construct_motion_plan_request(self) -> Any:
        """Return the moveit_msgs/MotionPlanRequest of the present target."""
        return from_bytes(MotionPlanRequest, self._g.construct_motion_plan_request())

    def compute_cartesian_path(
        self,
        waypoints: Iterable[Any],
        eef_step: float,
        jump_threshold: float = 0.0,
        avoid_collisions: bool = True,
        path_constraints: Any = None,
    ) -> tuple[Any, float]:
        """Follow straight lines between poses.

        Args:
            waypoints: geometry_msgs/Pose of the end effector in the pose reference frame.
            eef_step: distance between points of the path [m].
            jump_threshold: factor of the mean joint motion beyond which a step is a jump; 0: no check.
            avoid_collisions: False: collisions are not checked.
            path_constraints: moveit_msgs/Constraints that hold all along.

        Returns:
            moveit_msgs/RobotTrajectory, and the share of the path that it reaches; −1 if the service failed.
        """
        constraints = None
        if path_constraints is not None:
            if type(path_constraints) is not Constraints:
                kind = type(path_constraints)
                raise MoveItCommanderException(f"Unable to set path constraints, unknown constraint type {kind}")
            constraints = to_bytes(path_constraints)
        path, fraction = self._g.compute_cartesian_path(
            [conversions.pose_to_list(pose) for pose in waypoints],
            eef_step,
            jump_threshold,
            avoid_collisions,
            constraints,
        )
        return from_bytes(RobotTrajectory, path), fraction

    def execute(self, plan_msg: Any, wait: bool = True) -> bool:
        """Execute a plan; True if the motion succeeded, or was sent."""
        if isinstance(plan_msg, tuple):
            plan_msg = plan_msg[1]
        if not hasattr(plan_msg, "joint_trajectory"):
            plan_msg = RobotTrajectory(joint_trajectory=plan_msg)
        data = to_bytes(plan_msg)
        return self._g.execute(data) if wait else self._g.async_execute(data)

    # -- objects

    def attach_object(self, object_name: str, link_name: str = "", touch_links: Sequence[str] = ()) -> bool:
        """Attach an object to a link, by default the end effector's; links of `touch_links` may touch it."""
        return self._g.attach_object(object_name, link_name, touch_links)

    def detach_object(self, name: str = "") -> bool:
        """Detach an object, or all objects of a link; without a name, those of the group's links."""
        return self._g.detach_object(name)

    def pick(self, object_name: str, grasp: Any = (), plan_only: bool = False) -> int:
        """Pick an object with one or several moveit_msgs/Grasp; returns a value of moveit_msgs/MoveItErrorCodes."""
        grasps = [grasp] if isinstance(grasp, Grasp) else list(grasp)
        return self._g.pick(object_name, [to_bytes(one) for one in grasps], plan_only)

    def place(self, object_name: str, location: Any = None, plan_only: bool = False) -> bool:
        """Place an object at a Pose, PoseStamped, PlaceLocation or one of several; anywhere without a location."""
        if location is None or (isinstance(location, list) and not location):
            return self._g.place(object_name, plan_only)
        if isinstance(location, Pose):
            return self._g.place(object_name, conversions.pose_to_list(location), plan_only)
        locations: list[Any] = location if isinstance(location, list) else [location]
        parts = [to_bytes(one) for one in locations if isinstance(one, PoseStamped | PlaceLocation)]
        if len(parts) == len(locations) and all(isinstance(one, PlaceLocation) for one in locations):
            return self._g.place_locations_list(object_name, parts, plan_only)
        if len(parts) == len(locations) and all(isinstance(one, PoseStamped) for one in locations):
            return self._g.place_poses_list(object_name, parts, plan_only)
        raise MoveItCommanderException(_LOCATIONS)
