"""A group's settings and what it knows of itself, as MoveGroupCommander's methods name them."""

from collections.abc import Iterable, Sequence
from typing import Any

from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import Constraints, PlannerInterfaceDescription, RobotState, TrajectoryConstraints
from sensor_msgs.msg import JointState

from moveit_ros_planning_interface._moveit_move_group_interface import MoveGroupInterface
from moveit_ros_planning_interface.serialization import from_bytes, to_bytes

from . import conversions
from .exception import MoveItCommanderException


class GroupState:
    """Tolerances, times, planners, constraints, present state of one group."""

    def __init__(
        self, name: str, robot_description: str = "robot_description", ns: str = "", wait_for_servers: float = 5.0
    ) -> None:
        """Connect to move_group.

        Args:
            name: a group of the SRDF.
            robot_description: parameter of the URDF.
            ns: namespace of move_group.
            wait_for_servers: time to wait for each action [s].

        Raises:
            RuntimeError: the model is missing or invalid, the group does not exist, or move_group does not answer.
        """
        self._g = MoveGroupInterface(name, robot_description, ns, wait_for_servers)

    def get_name(self) -> str:
        """Return the group's name."""
        return self._g.get_name()

    def get_active_joints(self) -> list[str]:
        """Return the joints that move by themselves."""
        return self._g.get_active_joints()

    def get_joints(self) -> list[str]:
        """Return the joints, fixed ones too."""
        return self._g.get_joints()

    def get_variable_count(self) -> int:
        """Return the number of variables."""
        return self._g.get_variable_count()

    def has_end_effector_link(self) -> bool:
        """True if pose targets have a link."""
        return bool(self._g.get_end_effector_link())

    def get_end_effector_link(self) -> str:
        """Return the link of pose targets; empty: there is none."""
        return self._g.get_end_effector_link()

    def set_end_effector_link(self, link_name: str) -> None:
        """Set the link of pose targets."""
        if not self._g.set_end_effector_link(link_name):
            raise MoveItCommanderException("Unable to set end effector link")

    def get_interface_description(self) -> Any:
        """Return the planner's moveit_msgs/PlannerInterfaceDescription."""
        return from_bytes(PlannerInterfaceDescription, self._g.get_interface_description())

    def get_pose_reference_frame(self) -> str:
        """Return the frame of poses without one."""
        return self._g.get_pose_reference_frame()

    def set_pose_reference_frame(self, reference_frame: str) -> None:
        """Set the frame of poses without one."""
        self._g.set_pose_reference_frame(reference_frame)

    def get_planning_frame(self) -> str:
        """Return the frame of plans."""
        return self._g.get_planning_frame()

    # -- present state

    def get_current_joint_values(self) -> list[float]:
        """Return the present positions [rad, m]."""
        return self._g.get_current_joint_values()

    def get_current_pose(self, end_effector_link: str = "") -> Any:
        """Return the present geometry_msgs/PoseStamped of a link in the planning frame."""
        self._require_link(end_effector_link, "There is no end effector to get the pose of")
        return conversions.list_to_pose_stamped(self._g.get_current_pose(end_effector_link), self.get_planning_frame())

    def get_current_rpy(self, end_effector_link: str = "") -> list[float]:
        """Return roll, pitch, yaw of a link [rad]."""
        self._require_link(end_effector_link, "There is no end effector to get the rpy of")
        return self._g.get_current_rpy(end_effector_link)

    def get_random_joint_values(self) -> list[float]:
        """Return random positions within the limits."""
        return self._g.get_random_joint_values()

    def get_random_pose(self, end_effector_link: str = "") -> Any:
        """Return a geometry_msgs/PoseStamped of a link at random positions."""
        self._require_link(end_effector_link, "There is no end effector to get the pose of")
        return conversions.list_to_pose_stamped(self._g.get_random_pose(end_effector_link), self.get_planning_frame())

    def _require_link(self, link: str, otherwise: str) -> None:
        if not link and not self.has_end_effector_link():
            raise MoveItCommanderException(otherwise)

    def get_current_state(self) -> Any:
        """Return the present moveit_msgs/RobotState."""
        return from_bytes(RobotState, self._g.get_current_state())

    def get_current_state_bounded(self) -> Any:
        """Return the present moveit_msgs/RobotState within its limits."""
        return from_bytes(RobotState, self._g.get_current_state_bounded())

    def set_start_state_to_current_state(self) -> None:
        """Plan from where the robot is."""
        self._g.set_start_state_to_current_state()

    def set_start_state(self, msg: Any) -> None:
        """Plan from a moveit_msgs/RobotState, or from a sensor_msgs/JointState."""
        if type(msg) is JointState:
            state: Any = RobotState()
            state.joint_state, state.is_diff = msg, True
            msg = state
        self._g.set_start_state(to_bytes(msg))

    # -- settings

    def get_goal_tolerance(self) -> tuple[float, float, float]:
        """Return tolerances of joints, positions and orientations."""
        return (
            self._g.get_goal_joint_tolerance(),
            self._g.get_goal_position_tolerance(),
            self._g.get_goal_orientation_tolerance(),
        )

    def get_goal_joint_tolerance(self) -> float:
        """Return the tolerance of joints [rad] or [m]."""
        return self._g.get_goal_joint_tolerance()

    def get_goal_position_tolerance(self) -> float:
        """Return the tolerance of positions [m]."""
        return self._g.get_goal_position_tolerance()

    def get_goal_orientation_tolerance(self) -> float:
        """Return the tolerance of orientations [rad]."""
        return self._g.get_goal_orientation_tolerance()

    def set_goal_tolerance(self, value: float) -> None:
        """Set all three tolerances."""
        self._g.set_goal_tolerance(value)

    def set_goal_joint_tolerance(self, value: float) -> None:
        """Set the tolerance of joints [rad] or [m]."""
        self._g.set_goal_joint_tolerance(value)

    def set_goal_position_tolerance(self, value: float) -> None:
        """Set the tolerance of positions [m]."""
        self._g.set_goal_position_tolerance(value)

    def set_goal_orientation_tolerance(self, value: float) -> None:
        """Set the tolerance of orientations [rad]."""
        self._g.set_goal_orientation_tolerance(value)

    def allow_looking(self, value: bool) -> None:
        """Allow looking around before a motion."""
        self._g.allow_looking(value)

    def allow_replanning(self, value: bool) -> None:
        """Allow new plans during a motion."""
        self._g.allow_replanning(value)

    def get_known_constraints(self) -> list[str]:
        """Return the names of constraints in the database, which there is none of."""
        return self._g.get_known_constraints()

    def get_path_constraints(self) -> Any:
        """Return the path's moveit_msgs/Constraints."""
        return from_bytes(Constraints, self._g.get_path_constraints())

    def set_path_constraints(self, value: Any) -> None:
        """Set moveit_msgs/Constraints that hold all along the path; None: none."""
        if value is None:
            self.clear_path_constraints()
        elif type(value) is Constraints:
            self._g.set_path_constraints_from_msg(to_bytes(value))
        elif not self._g.set_path_constraints(value):
            raise MoveItCommanderException(f"Unable to set path constraints {value}")

    def clear_path_constraints(self) -> None:
        """Lift the path's constraints."""
        self._g.clear_path_constraints()

    def get_trajectory_constraints(self) -> Any:
        """Return the moveit_msgs/TrajectoryConstraints."""
        return from_bytes(TrajectoryConstraints, self._g.get_trajectory_constraints())

    def set_trajectory_constraints(self, value: Any) -> None:
        """Set moveit_msgs/TrajectoryConstraints; None: none."""
        if value is None:
            self.clear_trajectory_constraints()
        elif type(value) is TrajectoryConstraints:
            self._g.set_trajectory_constraints_from_msg(to_bytes(value))
        else:
            raise MoveItCommanderException(f"Unable to set trajectory constraints {value}")

    def clear_trajectory_constraints(self) -> None:
        """Lift the trajectory's constraints."""
        self._g.clear_trajectory_constraints()

    def set_constraints_database(self, host: str, port: int) -> None:
        """Warn that there is no database of constraints."""
        self._g.set_constraints_database(host, port)

    def set_planning_time(self, seconds: float) -> None:
        """Set the time of a plan [s]."""
        self._g.set_planning_time(seconds)

    def get_planning_time(self) -> float:
        """Return the time of a plan [s]."""
        return self._g.get_planning_time()

    def set_planning_pipeline_id(self, planning_pipeline: str) -> None:
        """Set the planning pipeline."""
        self._g.set_planning_pipeline_id(planning_pipeline)

    def get_planning_pipeline_id(self) -> str:
        """Return the planning pipeline."""
        return self._g.get_planning_pipeline_id()

    def set_planner_id(self, planner_id: str) -> None:
        """Set the planner."""
        self._g.set_planner_id(planner_id)

    def get_planner_id(self) -> str:
        """Return the planner."""
        return self._g.get_planner_id()

    def set_num_planning_attempts(self, num_planning_attempts: int) -> None:
        """Set how many plans are made, of which the shortest is taken."""
        self._g.set_num_planning_attempts(num_planning_attempts)

    def set_workspace(self, ws: Sequence[float]) -> None:
        """Set the box in which the robot may move: none, or min and max of x and y, or of x, y and z [m]."""
        if len(ws) == 0:
            self._g.set_workspace(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        elif len(ws) == 4:
            self._g.set_workspace(ws[0], ws[1], 0.0, ws[2], ws[3], 0.0)
        elif len(ws) == 6:
            self._g.set_workspace(*ws)
        else:
            raise MoveItCommanderException("Expected 0, 4 or 6 values in list specifying workspace")

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """Set the share of the greatest velocities, in (0, 1]."""
        self._g.set_max_velocity_scaling_factor(_share(value))

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """Set the share of the greatest accelerations, in (0, 1]."""
        self._g.set_max_acceleration_scaling_factor(_share(value))

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """Limit the speed of a link [m/s], by default the end effector's."""
        if not speed > 0.0:
            raise MoveItCommanderException("Expected speed value to be greater than 0")
        self._g.limit_max_cartesian_link_speed(speed, link_name)

    def clear_max_cartesian_link_speed(self) -> None:
        """Lift the limit of a link's speed."""
        self._g.clear_max_cartesian_link_speed()

    # -- named states

    def get_named_targets(self) -> list[str]:
        """Return the names of the SRDF's states and of remembered ones."""
        return self._g.get_named_targets()

    def get_named_target_values(self, target: str) -> dict[str, float]:
        """Return positions by joint of a named state."""
        return self._g.get_named_target_values(target)

    def remember_joint_values(self, name: str, values: Iterable[float] | None = None) -> None:
        """Remember positions under a name; by default the present ones."""
        self._g.remember_joint_values(name, self.get_current_joint_values() if values is None else values)

    def get_remembered_joint_values(self) -> dict[str, list[float]]:
        """Return all remembered positions."""
        return self._g.get_remembered_joint_values()

    def forget_joint_values(self, name: str) -> None:
        """Forget remembered positions."""
        self._g.forget_joint_values(name)

    def set_support_surface_name(self, value: str) -> None:
        """Set the object on which picked objects stand, and onto which they are placed."""
        self._g.set_support_surface_name(value)

    def retime_trajectory(
        self,
        ref_state_in: Any,
        traj_in: Any,
        velocity_scaling_factor: float = 1.0,
        acceleration_scaling_factor: float = 1.0,
        algorithm: str = "iterative_time_parameterization",
    ) -> Any:
        """Return a moveit_msgs/RobotTrajectory with new times, velocities and accelerations."""
        shares = velocity_scaling_factor, acceleration_scaling_factor
        trajectory = self._g.retime_trajectory(to_bytes(ref_state_in), to_bytes(traj_in), *shares, algorithm)
        return from_bytes(type(traj_in), trajectory)

    def get_jacobian_matrix(self, joint_values: Sequence[float], reference_point: Any = None) -> Any:
        """Return the Jacobian (6, joints) of the group's last link, about a point of it."""
        import numpy as np

        point = [0.0, 0.0, 0.0] if reference_point is None else reference_point
        return np.array(self._g.get_jacobian_matrix(joint_values, point))

    def enforce_bounds(self, robot_state_msg: Any) -> Any:
        """Return a moveit_msgs/RobotState within the limits."""
        return from_bytes(RobotState, self._g.enforce_bounds(to_bytes(robot_state_msg)))

    @staticmethod
    def _numbers(pose: Any) -> Any:
        """Return a pose as numbers; lists are taken as they are."""
        if type(pose) is PoseStamped:
            pose = pose.pose
        return conversions.pose_to_list(pose) if hasattr(pose, "position") else pose


def _share(value: float) -> float:
    if not 0.0 < value <= 1.0:
        raise MoveItCommanderException("Expected value in the range from 0 to 1 for scaling factor")
    return value
