"""move_base's node: topics, services, the action, the present goal."""

import asyncio
import math
from typing import TYPE_CHECKING, Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta

from trundle.gazebo.nodes import NodeHost
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import ActionResult, ActionServer, Message, Node, TransformError, TransformListener
from trundle.spatial import Pose

from ..costmap import CostmapRos
from ..planners import (
    GlobalPlanner,
    LocalPlanner,
    Plan,
    Pose2D,
    find_global_planner,
    find_local_planner,
)
from ..planners.motion import OdometryReader
from ..planners.path_message import path_message
from ..settings import read_settings, reconfigure
from .goal_run import GoalRun
from .recovery import Surroundings, read_behaviors

if TYPE_CHECKING:
    from collections.abc import Callable

    from trundle.ros.message_types import geometry_msgs, nav_msgs


class MoveBaseSettings(msgspec.Struct, kw_only=True):
    """Parameters, with the original's defaults."""

    base_global_planner: str = "navfn/NavfnROS"
    base_local_planner: str = "base_local_planner/TrajectoryPlannerROS"
    planner_frequency: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0
    controller_frequency: Annotated[float, Meta(ge=0.0, le=100.0)] = 20.0
    planner_patience: Annotated[float, Meta(ge=0.0, le=100.0)] = 5.0
    controller_patience: Annotated[float, Meta(ge=0.0, le=100.0)] = 15.0
    max_planning_retries: Annotated[int, Meta(ge=-1, le=1000)] = -1
    conservative_reset_dist: Annotated[float, Meta(ge=0.0, le=50.0)] = 3.0
    recovery_behavior_enabled: bool = True
    clearing_rotation_allowed: bool = True
    shutdown_costmaps: bool = False
    oscillation_timeout: Annotated[float, Meta(ge=0.0, le=60.0)] = 0.0
    oscillation_distance: Annotated[float, Meta(ge=0.0, le=10.0)] = 0.5
    make_plan_clear_costmap: bool = True
    make_plan_add_unreachable_goal: bool = True


class MoveBase:
    """Drives to the goals of the action `move_base`, whatever the node's name, and of `move_base_simple/goal`.

    Parameters, with the original's defaults: `MoveBaseSettings`, recovery_behaviors, and the namespaces
    global_costmap, local_costmap, and those of the planners and behaviors. Services: `~make_plan`, `~clear_costmaps`.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Drive until cancelled."""
        node = self._node
        try:
            root = RosParameters(await node.params.get("~", {}), node.name, warn=node.log.warn)
            self._settings = read_settings(MoveBaseSettings, root)
            await self._start(root)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        await node.closed.wait()
        return 0

    async def _start(self, root: RosParameters) -> None:
        node, settings = self._node, self._settings
        self._buffer = TransformListener(node).buffer
        self._commands = node.advertise("cmd_vel", "geometry_msgs/Twist", queue_size=1)
        self._current_goal = node.advertise("~current_goal", "geometry_msgs/PoseStamped", queue_size=1)
        kind = "move_base_msgs/RecoveryStatus"
        self._recovery_status = node.advertise("move_base/recovery_status", kind, queue_size=1)
        self._global_costmap = CostmapRos(node, "global_costmap", root, self._buffer)
        await self._global_costmap.start()
        make, space, section = find_global_planner(node, settings.base_global_planner, root)
        self._global_planner: GlobalPlanner = make(node, space, section, self._global_costmap)
        self._local_costmap = CostmapRos(node, "local_costmap", root, self._buffer)
        await self._local_costmap.start()
        make, space, section = find_local_planner(node, settings.base_local_planner, root)
        odometry = OdometryReader(node, "odom")
        self._local_planner: LocalPlanner = make(
            node, space, section, root, self._local_costmap, self._buffer, odometry
        )
        node.log.info(f"Created local_planner {settings.base_local_planner}")
        costmaps = (self._global_costmap, self._local_costmap)
        surroundings = Surroundings(node, *costmaps, self._drive, root, self._local_planner, space)
        self._behaviors = read_behaviors(root, surroundings)
        node.advertise_service("~make_plan", "nav_msgs/GetPlan", self._on_make_plan)
        node.advertise_service("~clear_costmaps", "std_srvs/Empty", self._on_clear_costmaps)
        self._goals = node.advertise("move_base/goal", "move_base_msgs/MoveBaseActionGoal", queue_size=1)
        self._server = ActionServer(node, "move_base", "move_base_msgs/MoveBase", self._execute)
        # After the server, which would not hear of a goal that is latched there.
        node.subscribe("move_base_simple/goal", "geometry_msgs/PoseStamped", self._on_simple_goal, queue_size=1)
        reconfigure(node, node.name, settings, lambda: None)

    def _drive(self, x: float, y: float, turn: float) -> None:
        self._commands.publish({"linear": {"x": x, "y": y}, "angular": {"z": turn}})

    def _on_simple_goal(self, message: "geometry_msgs.PoseStamped") -> None:
        self._goals.publish({"header": {"stamp": self._node.clock.now_ns()}, "goal": {"target_pose": message}})

    def _on_clear_costmaps(self, _request: Any) -> dict[str, Any]:
        self._local_costmap.reset()
        self._global_costmap.reset()
        return {}

    async def _execute(self, goal: Message, accept: "Callable[[], None]") -> ActionResult:
        """Drive to one goal of the action."""
        node = self._node
        stamped = goal.target_pose
        if not _is_quaternion_valid(stamped.pose.orientation):
            node.log.error(
                "Quaternion is invalid: its length is near zero, or it is not a rotation about z; the goal is discarded"
            )
            return ActionResult(
                status="aborted", text="Aborting on goal because it was sent with an invalid quaternion"
            )
        target = self._in_global_frame(stamped)
        accept()
        self._current_goal.publish(stamped if target is None else self._stamped(target))
        if target is None:
            target = _pose_2d(stamped)
        run = GoalRun(
            node,
            self._settings,
            target,
            global_costmap=self._global_costmap,
            local_costmap=self._local_costmap,
            global_planner=self._global_planner,
            local_planner=self._local_planner,
            behaviors=self._behaviors,
            drive=self._drive,
            report=self._report_recovery,
        )
        try:
            return await run.drive(lambda pose: self._feed_back(pose, goal))
        except asyncio.CancelledError:
            self._drive(0.0, 0.0, 0.0)
            raise

    def _feed_back(self, pose: Pose2D, goal: Message) -> None:
        self._server.publish_feedback({"base_position": self._stamped(pose)}, goal=goal)

    def _report_recovery(self, pose: Pose2D, number: int, name: str) -> None:
        status = {
            "pose_stamped": self._stamped(pose),
            "current_recovery_number": number,
            "total_number_of_recoveries": len(self._behaviors),
            "recovery_behavior_name": name,
        }
        self._recovery_status.publish(status)

    def _stamped(self, pose: Pose2D) -> dict[str, Any]:
        plan = Plan(self._global_costmap.frame, np.array([pose]))
        return path_message(plan, self._node.clock.now_ns())["poses"][0]

    def _in_global_frame(self, stamped: "geometry_msgs.PoseStamped") -> Pose2D | None:
        """Return a pose in the global costmap's frame, by the latest transform; None without one."""
        frame = stamped.header.frame_id.lstrip("/")
        pose = _pose_2d(stamped)
        if not frame or frame == self._global_costmap.frame:
            return pose
        try:
            transform = self._buffer.lookup_transform(self._global_costmap.frame, frame)
        except TransformError as error:
            self._node.log.warn(
                f"Failed to transform the goal pose from {frame} into the {self._global_costmap.frame} frame: {error}"
            )
            return None
        moved = transform.pose @ Pose.from_rpy(pose.x, pose.y, 0.0, 0.0, 0.0, pose.yaw)
        return Pose2D(moved.position[0], moved.position[1], moved.rpy[2])

    async def _on_make_plan(self, request: "nav_msgs.GetPlanRequest") -> dict[str, Any]:
        """Plan without driving; if the goal cannot be reached, plan to the nearest place within the tolerance."""
        node = self._node
        if self._server.active:
            node.log.error("move_base must be in an inactive state to make a plan for an external user")
            return {}
        start = self._in_global_frame(request.start) if request.start.header.frame_id else None
        if start is None:
            found = self._global_costmap.robot_pose()
            start = None if found is None else Pose2D(*found)
        goal = self._in_global_frame(request.goal)
        if start is None or goal is None:
            node.log.error("move_base cannot make a plan for you because it could not get the start pose of the robot")
            return {}
        plan = await self._global_planner.make_plan(start, goal, 0.0)
        tolerance = request.tolerance
        if plan is None and tolerance > 0.0:
            plan = await self._global_planner.make_plan(start, goal, tolerance)
            if plan is not None and self._settings.make_plan_add_unreachable_goal:
                plan = Plan(plan.frame, np.vstack([plan.poses, goal]))
        if plan is None:
            return {}
        self._global_planner.publish(plan)
        return {"plan": path_message(plan, node.clock.now_ns())}


def _pose_2d(stamped: "geometry_msgs.PoseStamped") -> Pose2D:
    position, q = stamped.pose.position, stamped.pose.orientation
    yaw = math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    return Pose2D(float(position.x), float(position.y), yaw)


def _is_quaternion_valid(q: "geometry_msgs.Quaternion") -> bool:
    """True for a rotation about z alone, which move_base requires of goals."""
    norm = math.hypot(q.w, q.x, q.y, q.z)
    if not math.isfinite(norm) or norm < 1e-3:
        return False
    return 1.0 - 2.0 * (q.x * q.x + q.y * q.y) / (norm * norm) >= 1.0 - 1e-3
