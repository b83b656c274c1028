"""A group's commands to move_group: plan, move, execute, pick, place."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from geometry_msgs.msg import Point, PoseStamped
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    ExecuteTrajectoryAction,
    ExecuteTrajectoryGoal,
    Grasp,
    MotionPlanRequest,
    MoveGroupAction,
    MoveGroupGoal,
    MoveItErrorCodes,
    PickupAction,
    PickupGoal,
    PlaceAction,
    PlaceGoal,
    PlaceLocation,
    PlannerInterfaceDescription,
    RobotState,
    RobotTrajectory,
)
from moveit_msgs.srv import GetCartesianPath, QueryPlannerInterfaces
from std_msgs.msg import String

import actionlib
import rospy
from trundle.base.diagnostics import TrundleError

from .group_targets import GroupTargets
from .retiming import RETIMING_ALGORITHMS, retimed
from .robot_state import in_namespace, pose_from_list, stamped
from .serialization import from_bytes, to_bytes

_DESCRIBE_S = 5.0
_REPLAN_DELAY_S = 2.0


class MoveGroupInterface(GroupTargets):
    """Plans and moves one group."""

    def __init__(
        self, group: str, robot_description: str = "robot_description", ns: str = "", wait_for_servers: float = 5.0
    ) -> None:
        """Connect to move_group.

        Args:
            group: a group of the SRDF.
            robot_description: parameter of the URDF.
            ns: namespace of move_group.
            wait_for_servers: time to wait for each action [s]; 0: without limit.

        Raises:
            RuntimeError: the model is missing or invalid, the group does not exist, or move_group does not answer.
        """
        super().__init__(group, robot_description, ns)
        self._wait_s = float(wait_for_servers)
        self._clients: dict[str, Any] = {}
        for name, kind in (("move_group", MoveGroupAction), ("execute_trajectory", ExecuteTrajectoryAction)):
            self._clients[name] = actionlib.SimpleActionClient(in_namespace(ns, name), kind)
        self._events = rospy.Publisher(in_namespace(ns, "trajectory_execution_event"), String, queue_size=1)
        self._attachments = rospy.Publisher(
            in_namespace(ns, "attached_collision_object"), AttachedCollisionObject, queue_size=10
        )
        for name, client in self._clients.items():
            if not client.wait_for_server(rospy.Duration.from_sec(self._wait_s)):
                raise RuntimeError(
                    f"Unable to connect to move_group action server '{name}' within allotted time ({self._wait_s:g}s)"
                )
        rospy.loginfo(f"Ready to take commands for planning group {self.get_name()}.")

    def get_interface_description(self) -> bytes:
        """Return the serialized moveit_msgs/PlannerInterfaceDescription."""
        name = in_namespace(self._namespace, "query_planner_interface")
        try:
            rospy.wait_for_service(name, timeout=_DESCRIBE_S)
            found = rospy.ServiceProxy(name, QueryPlannerInterfaces)().planner_interfaces
        except (rospy.ROSException, rospy.ServiceException) as error:
            rospy.logerr(f"{name}: {error}")
            found = []
        return to_bytes(found[0] if found else PlannerInterfaceDescription())

    # -- plans and motions

    def _request(self) -> Any:
        request: Any = MotionPlanRequest()
        request.group_name = self.get_name()
        request.pipeline_id, request.planner_id = self._pipeline, self._planner
        request.num_planning_attempts = self._attempts
        request.allowed_planning_time = self._planning_time
        request.max_velocity_scaling_factor = self._velocity_scaling
        request.max_acceleration_scaling_factor = self._acceleration_scaling
        request.cartesian_speed_limited_link = self._limited_link
        request.max_cartesian_speed = self._link_speed
        request.workspace_parameters = self._workspace
        request.start_state = self._start_state()
        request.goal_constraints = self._goal()
        if not request.goal_constraints:
            rospy.logerr("Unable to construct MotionPlanRequest representation: no target is set")
        if self._path_constraints is not None:
            request.path_constraints = self._path_constraints
        if self._trajectory_constraints is not None:
            request.trajectory_constraints = self._trajectory_constraints
        return request

    def construct_motion_plan_request(self) -> bytes:
        """Return the serialized moveit_msgs/MotionPlanRequest of the present goal."""
        return to_bytes(self._request())

    def _move_goal(self, *, plan_only: bool) -> Any:
        goal: Any = MoveGroupGoal()
        goal.request = self._request()
        options = goal.planning_options
        options.plan_only = plan_only
        options.look_around = self._can_look and not plan_only
        options.replan = self._can_replan and not plan_only
        options.replan_delay = _REPLAN_DELAY_S
        options.planning_scene_diff.is_diff = True
        options.planning_scene_diff.robot_state.is_diff = True
        return goal

    def plan(self) -> tuple[bytes, bytes, float]:
        """Plan; returns error code and trajectory, serialized, and the planning time [s]."""
        result = self._run("move_group", self._move_goal(plan_only=True))
        if result is None:
            return to_bytes(_failure()), to_bytes(RobotTrajectory()), 0.0
        return to_bytes(result.error_code), to_bytes(result.planned_trajectory), float(result.planning_time)

    def move(self) -> bool:
        """Plan, and move; returns when the motion ends."""
        return _is_success(self._run("move_group", self._move_goal(plan_only=False)))

    def async_move(self) -> bool:
        """Plan, and move; returns at once."""
        self._clients["move_group"].send_goal(self._move_goal(plan_only=False))
        return True

    def execute(self, trajectory: bytes) -> bool:
        """Execute a serialized moveit_msgs/RobotTrajectory; returns when the motion ends."""
        return _is_success(self._run("execute_trajectory", self._execute_goal(trajectory)))

    def async_execute(self, trajectory: bytes) -> bool:
        """Execute a serialized moveit_msgs/RobotTrajectory; returns at once."""
        self._clients["execute_trajectory"].send_goal(self._execute_goal(trajectory))
        return True

    def _execute_goal(self, trajectory: bytes) -> Any:
        goal: Any = ExecuteTrajectoryGoal()
        goal.trajectory = from_bytes(RobotTrajectory, trajectory)
        return goal

    def stop(self) -> None:
        """Stop the robot."""
        message: Any = String()
        message.data = "stop"
        self._events.publish(message)

    def _run(self, name: str, goal: Any) -> Any:
        """Send a goal and await its result; None without an answer."""
        client = self._clients[name]
        client.send_goal(goal)
        if not client.wait_for_result():
            rospy.loginfo(f"{name} action returned early")
        result = client.get_result()
        if client.get_state() != actionlib.GoalStatus.SUCCEEDED:
            text = client.get_goal_status_text()
            rospy.logwarn(f"Fail: {actionlib.GoalStatus.to_string(client.get_state())}: {text}")
        return result

    def compute_cartesian_path(
        self,
        waypoints: Iterable[Sequence[float]],
        eef_step: float,
        jump_threshold: float,
        avoid_collisions: bool = True,
        path_constraints: bytes | None = None,
    ) -> tuple[bytes, float]:
        """Follow straight lines between poses; returns the serialized trajectory and the share that is reached.

        The share is −1 if the service failed.
        """
        name = in_namespace(self._namespace, "compute_cartesian_path")
        service: Any = rospy.ServiceProxy(name, GetCartesianPath)
        request: Any = GetCartesianPath._request_class()
        request.header.frame_id, request.header.stamp = self._frame, rospy.get_rostime()
        request.start_state = self._start_state()
        request.group_name, request.link_name = self.get_name(), self._link
        request.waypoints = [pose_from_list(pose) for pose in waypoints]
        request.max_step, request.jump_threshold = float(eef_step), float(jump_threshold)
        request.avoid_collisions = bool(avoid_collisions)
        request.cartesian_speed_limited_link, request.max_cartesian_speed = self._limited_link, self._link_speed
        if path_constraints is not None:
            request.path_constraints = from_bytes(Constraints, path_constraints)
        try:
            answer = service(request)
        except rospy.ServiceException as error:
            rospy.logerr(f"{name}: {error}")
            return to_bytes(RobotTrajectory()), -1.0
        if answer.error_code.val != MoveItErrorCodes.SUCCESS:
            return to_bytes(RobotTrajectory()), -1.0
        return to_bytes(answer.solution), float(answer.fraction)

    # -- objects

    def attach_object(self, name: str, link: str = "", touch_links: Sequence[str] = ()) -> bool:
        """Attach an object to a link, by default the end effector's; False: no link is known."""
        link = link or self._link or (self._group.links[0] if self._group.links else "")
        if not link:
            rospy.logerr(f"No known link to attach object '{name}' to")
            return False
        message: Any = AttachedCollisionObject()
        message.link_name, message.object.id = link, name
        message.touch_links = list(touch_links) or [link]
        message.object.operation = CollisionObject.ADD
        self._attachments.publish(message)
        return True

    def detach_object(self, name: str = "") -> bool:
        """Detach the object, or the objects of a link of the name; without one, all of the group's links."""
        messages: list[Any] = []
        for link in [name] if name else self._group.updated_links:
            message: Any = AttachedCollisionObject()
            if link in self._robot.model.links:
                message.link_name = link
            else:
                message.object.id = link
            message.object.operation = CollisionObject.REMOVE
            messages.append(message)
        for message in messages:
            self._attachments.publish(message)
        return bool(messages)

    # -- pick and place

    def pick(self, name: str, grasps: Any = (), plan_only: bool = False) -> int:
        """Pick an object with serialized moveit_msgs/Grasp, one or several; returns moveit_msgs/MoveItErrorCodes."""
        if isinstance(grasps, bool):
            grasps, plan_only = (), grasps
        parts = [grasps] if isinstance(grasps, bytes) else list(grasps)
        goal: Any = PickupGoal()
        goal.target_name, goal.group_name, goal.end_effector = name, self.get_name(), self._end_effector()
        goal.support_surface_name = self._support_surface
        goal.possible_grasps = [from_bytes(Grasp, part) for part in parts]
        if self._support_surface:
            goal.allow_gripper_support_collision = True
        self._fill(goal, plan_only)
        result = self._run(self._action("pickup", PickupAction), goal)
        return MoveItErrorCodes.FAILURE if result is None else int(result.error_code.val)

    def place(self, name: str, location: Any = None, plan_only: bool = False) -> bool:
        """Place an object: at a pose of numbers, a serialized moveit_msgs/PlaceLocation, or anywhere."""
        if isinstance(location, bool):
            location, plan_only = None, location
        if location is None:
            return self._place(name, [], plan_only)
        if isinstance(location, bytes):
            return self._place(name, [from_bytes(PlaceLocation, location)], plan_only)
        return self._place(name, [self._location(stamped(pose_from_list(location), self._frame))], plan_only)

    def place_poses_list(self, name: str, poses: Iterable[bytes], plan_only: bool = False) -> bool:
        """Place an object at one of serialized geometry_msgs/PoseStamped."""
        return self._place(name, [self._location(from_bytes(PoseStamped, pose)) for pose in poses], plan_only)

    def place_locations_list(self, name: str, locations: Iterable[bytes], plan_only: bool = False) -> bool:
        """Place an object at one of serialized moveit_msgs/PlaceLocation."""
        return self._place(name, [from_bytes(PlaceLocation, location) for location in locations], plan_only)

    def _location(self, pose: Any) -> Any:
        """Return a location at a pose with the original's ways: 10 to 20 cm down to it, up to 20 cm back from it."""
        location: Any = PlaceLocation()
        location.place_pose = pose
        approach, retreat = location.pre_place_approach, location.post_place_retreat
        approach.direction.header.frame_id, approach.direction.vector.z = self.get_planning_frame(), -1.0
        retreat.direction.header.frame_id, retreat.direction.vector.x = self._link, -1.0
        approach.min_distance, approach.desired_distance = 0.1, 0.2
        retreat.min_distance, retreat.desired_distance = 0.0, 0.2
        return location

    def _place(self, name: str, locations: list[Any], plan_only: bool) -> bool:
        goal: Any = PlaceGoal()
        goal.group_name, goal.attached_object_name, goal.place_locations = self.get_name(), name, locations
        goal.support_surface_name = self._support_surface
        if self._support_surface:
            goal.allow_gripper_support_collision = True
        self._fill(goal, plan_only)
        return _is_success(self._run(self._action("place", PlaceAction), goal))

    def _fill(self, goal: Any, plan_only: bool) -> None:
        goal.planner_id, goal.allowed_planning_time = self._planner, self._planning_time
        if self._path_constraints is not None:
            goal.path_constraints = self._path_constraints
        options = goal.planning_options
        options.plan_only, options.look_around, options.replan = plan_only, self._can_look, self._can_replan
        options.replan_delay = _REPLAN_DELAY_S
        options.planning_scene_diff.is_diff = True
        options.planning_scene_diff.robot_state.is_diff = True

    def _action(self, name: str, kind: Any) -> str:
        """Connect to an action that not every program needs.

        Raises:
            RuntimeError: move_group does not have it.
        """
        if name not in self._clients:
            client: Any = actionlib.SimpleActionClient(in_namespace(self._namespace, name), kind)
            if not client.wait_for_server(rospy.Duration.from_sec(self._wait_s)):
                raise RuntimeError(f"the action '{name}' of move_group is not there")
            self._clients[name] = client
        return name

    def _end_effector(self) -> str:
        """Return the end effector on the group's link, or the first that the group moves."""
        moved = [self._robot.model.end_effectors[name] for name in self._group.attached_end_effectors]
        return next((eef.name for eef in moved if eef.parent_link == self._link), moved[0].name if moved else "")

    # -- tools

    def retime_trajectory(
        self,
        reference: bytes,
        trajectory: bytes,
        velocity_scaling: float = 1.0,
        acceleration_scaling: float = 1.0,
        algorithm: str = "iterative_time_parameterization",
    ) -> bytes:
        """Return the serialized trajectory with new times, velocities and accelerations; empty if that fails."""
        del reference  # velocities and accelerations are limited for each joint alone
        if algorithm not in RETIMING_ALGORITHMS:
            known = ", ".join(RETIMING_ALGORITHMS)
            rospy.logerr(f"Unknown time parameterization algorithm: {algorithm}; algorithms: {known}")
            return to_bytes(RobotTrajectory())
        message: Any = from_bytes(RobotTrajectory, trajectory)
        try:
            return to_bytes(retimed(self._robot.model, message, velocity_scaling, acceleration_scaling, algorithm))
        except TrundleError as error:
            rospy.logerr(str(error))
            return to_bytes(RobotTrajectory())

    def get_current_state(self) -> bytes:
        """Return the present moveit_msgs/RobotState, serialized."""
        return to_bytes(self._robot.message(self._robot.positions()))

    def get_current_state_bounded(self) -> bytes:
        """Return the present state, serialized, each position within its limits."""
        return to_bytes(self._robot.message(self._bounded(self._robot.positions())))

    def enforce_bounds(self, state: bytes) -> bytes:
        """Return a serialized moveit_msgs/RobotState with each position within its limits; b"" for an empty one."""
        message: Any = from_bytes(RobotState, state)
        if not message.joint_state.name and not message.multi_dof_joint_state.joint_names:
            rospy.logerr("Found empty JointState message")
            return b""
        values = self._bounded(self._robot.with_message(self._robot.positions(), message))
        result = self._robot.message(values)
        result.attached_collision_objects = message.attached_collision_objects
        return to_bytes(result)

    def _bounded(self, values: np.ndarray) -> np.ndarray:
        model = self._robot.model
        wrapped = np.where(model.is_bounded, np.clip(values, model.lower, model.upper), values)
        turning = ~model.is_bounded & (model.upper - model.lower < 7.0)  # continuous joints, of −π … π
        return np.where(turning, (wrapped + np.pi) % (2.0 * np.pi) - np.pi, wrapped)

    def get_jacobian_matrix(self, joint_values: Sequence[float], reference_point: Any = None) -> list[list[float]]:
        """Return the rows (6) of the Jacobian of the group's last link in its base's frame, about a point in the link.

        Linear velocity comes before angular velocity.
        """
        model, group = self._robot.model, self._group
        values = model.state_of(dict(zip(group.variables, map(float, joint_values), strict=False)))
        tip = group.links[-1]
        jacobian = np.array(self._robot.kinematics.jacobian(group.name, values, tip), dtype=np.float64)
        poses = self._robot.kinematics.link_poses(values)
        links = list(model.links)
        tip_rotation = _rotation(poses[links.index(tip)][3:])
        point: Any = reference_point or Point()
        offset = tip_rotation @ np.array(
            [point.x, point.y, point.z] if hasattr(point, "x") else list(point), dtype=np.float64
        )
        jacobian[:3] += np.cross(jacobian[3:].T, offset).T
        base_rotation = _rotation(poses[links.index(group.base)][3:]) if group.base in links else np.eye(3)
        jacobian[:3], jacobian[3:] = base_rotation.T @ jacobian[:3], base_rotation.T @ jacobian[3:]
        return jacobian.tolist()


def _rotation(quaternion: np.ndarray) -> np.ndarray:
    x, y, z, w = map(float, quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _failure() -> Any:
    code: Any = MoveItErrorCodes()
    code.val = MoveItErrorCodes.FAILURE
    return code


def _is_success(result: Any) -> bool:
    return result is not None and result.error_code.val == MoveItErrorCodes.SUCCESS
