"""What a group's plans have in common: tolerances, times, planner, workspace, start, constraints."""

from typing import Any

import numpy as np
from moveit_msgs.msg import Constraints, RobotState, TrajectoryConstraints, WorkspaceParameters

import rospy

from .robot_state import SharedRobot, in_namespace, shared_robot
from .serialization import from_bytes, to_bytes


class GroupSettings:
    """Settings of one group, which each request contains."""

    def __init__(self, group: str, robot_description: str = "robot_description", ns: str = "") -> None:
        """Read the model.

        Raises:
            RuntimeError: the parameters are missing or invalid, or the group does not exist.
        """
        self._robot: SharedRobot = shared_robot(robot_description, ns)
        self._namespace = ns
        self._group = self._robot.group(group)
        self._joint_tolerance = 1e-4
        self._position_tolerance = 1e-4
        self._orientation_tolerance = 1e-3
        self._planning_time = 5.0
        self._attempts = 1
        self._pipeline = self._planner = ""
        self._can_look = self._can_replan = False
        self._velocity_scaling = self._default_scaling("velocity")
        self._acceleration_scaling = self._default_scaling("acceleration")
        self._limited_link, self._link_speed = "", 0.0
        self._workspace: Any = WorkspaceParameters()
        self._start: np.ndarray | None = None
        self._start_message: Any = None
        self._path_constraints: Any = None
        self._trajectory_constraints: Any = None
        self._support_surface = ""
        self._robot.start_monitor()

    def _default_scaling(self, what: str) -> float:
        name = f"{in_namespace(self._namespace, self._robot.description)}_planning/default_{what}_scaling_factor"
        return float(rospy.get_param(name, 0.1))

    def get_name(self) -> str:
        """Return the group's name."""
        return self._group.name

    def get_planning_frame(self) -> str:
        """Return the frame of plans."""
        return self._robot.model.model_frame

    def get_joints(self) -> list[str]:
        """Return the group's joints, fixed ones too."""
        return list(self._group.all_joints)

    def get_active_joints(self) -> list[str]:
        """Return the group's joints that move by themselves."""
        return list(self._group.joints)

    def get_variables(self) -> list[str]:
        """Return the group's variables."""
        return list(self._group.all_variables)

    def get_variable_count(self) -> int:
        """Return the number of variables."""
        return len(self._group.all_variables)

    def get_goal_joint_tolerance(self) -> float:
        """Return the tolerance of joints [rad] or [m]."""
        return self._joint_tolerance

    def get_goal_position_tolerance(self) -> float:
        """Return the tolerance of positions [m]."""
        return self._position_tolerance

    def get_goal_orientation_tolerance(self) -> float:
        """Return the tolerance of orientations [rad]."""
        return self._orientation_tolerance

    def set_goal_joint_tolerance(self, value: float) -> None:
        """Set the tolerance of joints."""
        self._joint_tolerance = float(value)

    def set_goal_position_tolerance(self, value: float) -> None:
        """Set the tolerance of positions."""
        self._position_tolerance = float(value)

    def set_goal_orientation_tolerance(self, value: float) -> None:
        """Set the tolerance of orientations."""
        self._orientation_tolerance = float(value)

    def set_goal_tolerance(self, value: float) -> None:
        """Set all three tolerances."""
        self._joint_tolerance = self._position_tolerance = self._orientation_tolerance = float(value)

    def allow_looking(self, value: bool) -> None:
        """Allow looking around before a motion, which move_group answers as without sensors."""
        self._can_look = bool(value)

    def allow_replanning(self, value: bool) -> None:
        """Allow new plans during a motion."""
        self._can_replan = bool(value)

    def set_planning_time(self, seconds: float) -> None:
        """Set the time of a plan [s]."""
        if seconds > 0.0:
            self._planning_time = float(seconds)

    def get_planning_time(self) -> float:
        """Return the time of a plan [s]."""
        return self._planning_time

    def set_num_planning_attempts(self, attempts: int) -> None:
        """Set how many plans are made, of which the shortest is taken."""
        self._attempts = int(attempts)

    def set_planning_pipeline_id(self, pipeline: str) -> None:
        """Set the planning pipeline."""
        if pipeline != self._pipeline:
            self._pipeline, self._planner = pipeline, ""

    def get_planning_pipeline_id(self) -> str:
        """Return the planning pipeline; empty: move_group's default."""
        return self._pipeline

    def set_planner_id(self, planner: str) -> None:
        """Set the planner."""
        self._planner = planner

    def get_planner_id(self) -> str:
        """Return the planner; empty: the pipeline's default."""
        return self._planner

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """Set the share of the joints' greatest velocities, in (0, 1]."""
        self._velocity_scaling = self._scaling(value, "velocity")

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """Set the share of the joints' greatest accelerations, in (0, 1]."""
        self._acceleration_scaling = self._scaling(value, "acceleration")

    def _scaling(self, value: float, what: str) -> float:
        if value > 1.0:
            rospy.logwarn(f"Limiting max_{what}_scaling_factor ({value:.2f}) to 1.0.")
            return 1.0
        if value <= 0.0:
            default = self._default_scaling(what)
            if value < 0.0:
                rospy.logwarn(f"max_{what}_scaling_factor < 0.0! Setting to default: {default:.2f}.")
            return default
        return float(value)

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """Limit the speed of a link [m/s]."""
        self._limited_link, self._link_speed = link_name or self.get_end_effector_link(), float(speed)

    def clear_max_cartesian_link_speed(self) -> None:
        """Lift the limit of the link's speed."""
        self._limited_link, self._link_speed = "", 0.0

    def get_end_effector_link(self) -> str:
        """Return the link of pose targets; empty: there is none."""
        return self._group.links[-1] if self._group.is_chain and self._group.links else ""

    def set_workspace(self, x1: float, y1: float, z1: float, x2: float, y2: float, z2: float) -> None:
        """Set the box in which the robot may move [m]."""
        workspace = self._workspace
        workspace.header.frame_id = self.get_planning_frame()
        workspace.header.stamp = rospy.get_rostime()
        low, high = workspace.min_corner, workspace.max_corner
        low.x, low.y, low.z = float(x1), float(y1), float(z1)
        high.x, high.y, high.z = float(x2), float(y2), float(z2)

    def set_start_state_to_current_state(self) -> None:
        """Plan from where the robot is."""
        self._start = self._start_message = None

    def set_start_state(self, state: bytes) -> None:
        """Plan from a serialized moveit_msgs/RobotState."""
        message: Any = from_bytes(RobotState, state)
        base = self._robot.positions() if message.is_diff else self._robot.model.default_positions()
        self._start, self._start_message = self._robot.with_message(base, message), message

    def _start_state(self) -> Any:
        """Return the start of a request; a diff that is empty means the present state."""
        if self._start_message is None:
            state: Any = RobotState()
            state.is_diff = True
            return state
        return self._start_message

    def set_path_constraints(self, name: str) -> bool:
        """False: named constraints are in a database, which there is none of."""
        rospy.logerr(f"path constraints {name!r}: a database of constraints (MongoDB) is not available")
        return False

    def set_path_constraints_from_msg(self, constraints: bytes) -> None:
        """Set serialized moveit_msgs/Constraints, which hold all along the path."""
        self._path_constraints = from_bytes(Constraints, constraints)

    def get_path_constraints(self) -> bytes:
        """Return the path's constraints, serialized."""
        return to_bytes(self._path_constraints or Constraints())

    def clear_path_constraints(self) -> None:
        """Lift the path's constraints."""
        self._path_constraints = None

    def set_trajectory_constraints_from_msg(self, constraints: bytes) -> None:
        """Set serialized moveit_msgs/TrajectoryConstraints."""
        self._trajectory_constraints = from_bytes(TrajectoryConstraints, constraints)

    def get_trajectory_constraints(self) -> bytes:
        """Return the trajectory's constraints, serialized."""
        return to_bytes(self._trajectory_constraints or TrajectoryConstraints())

    def clear_trajectory_constraints(self) -> None:
        """Lift the trajectory's constraints."""
        self._trajectory_constraints = None

    def get_known_constraints(self) -> list[str]:
        """Return no names: there is no database of constraints."""
        return []

    def set_constraints_database(self, host: str, port: int) -> None:
        """Warn that there is no database."""
        rospy.logwarn(f"{host}:{port}: a database of constraints (MongoDB) is not available")

    def set_support_surface_name(self, name: str) -> None:
        """Set the object on which picked objects stand, and onto which they are placed."""
        self._support_surface = name
