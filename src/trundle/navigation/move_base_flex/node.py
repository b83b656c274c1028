"""mbf_costmap_nav/mbf_costmap_nav: planning, control and recovery as actions."""

import asyncio
import math
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from trundle.gazebo.nodes import NodeHost
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import ActionResult, ActionServer, Message, Node, TransformError, TransformListener

from ..costmap import CostmapRos
from ..move_base.goal_run import GoalRun, Trigger
from ..move_base.recovery import RecoveryBehavior, Surroundings, read_behaviors
from ..planners import GlobalPlanner, LocalPlanner, Plan, Pose2D, find_global_planner, find_local_planner
from ..planners.motion import OdometryReader, angle_between
from ..planners.path_message import path_message
from ..pose_messages import planar, read_pose
from ..settings import read_settings, reconfigure
from .check_services import CheckServices
from .path_run import SUCCESS, Velocity, follow_path
from .settings import MbfSettings

_Plugin = TypeVar("_Plugin")
_NO_PATH, _PLAN_TF, _PLAN_PLUGIN, _OFF_MAP, _PLAN_CANCELED = 54, 57, 59, 61, 51
_CONTROL_CANCELED, _EMPTY_PATH, _CONTROL_TF, _CONTROL_PLUGIN = 101, 110, 111, 113
_RECOVERY_CANCELED, _RECOVERY_PLUGIN = 151, 155
_MOVE_CANCELED, _MOVE_TF = 11, 16
_OUTCOMES = {Trigger.PLANNING: _NO_PATH, Trigger.CONTROLLING: 102, Trigger.OSCILLATION: 13}
"""Result codes of mbf_msgs' actions."""


class MbfCostmapNav:
    """Plans, follows paths and recovers by the actions `~get_path`, `~exe_path`, `~recovery` and `~move_base`.

    Parameters, with the original's names: `MbfSettings`, `planners`, `controllers` and `recovery_behaviors` (lists of
    name and type; each plugin's parameters are in the namespace of its name), global_costmap, local_costmap. Services:
    `~check_point_cost`, `~check_pose_cost`, `~check_path_cost`, `~find_valid_pose`, `~clear_costmaps`. The action
    `~move_base` runs the cycles of move_base with the named planner and controller. Slots for concurrent goals are not
    kept apart: a new goal of an action replaces the last one.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        try:
            root = RosParameters(await node.params.get("~", {}), node.name, warn=node.log.warn)
            self._settings = read_settings(MbfSettings, root)
            await self._start(root)
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        await node.closed.wait()
        return 0

    async def _start(self, root: RosParameters) -> None:
        node = self._node
        self._buffer = buffer = TransformListener(node).buffer
        self._commands = node.advertise("cmd_vel", "geometry_msgs/Twist", queue_size=1)
        self._current_goal = node.advertise("~current_goal", "geometry_msgs/PoseStamped", latch=True, queue_size=1)
        self._global, self._local = (
            CostmapRos(node, name, root, buffer) for name in ("global_costmap", "local_costmap")
        )
        for costmap in (self._global, self._local):
            await costmap.start()
        odometry = OdometryReader(node, root.text("odom_topic", "odom"))
        self._planners: dict[str, GlobalPlanner] = {}
        for name, kind in _listed(root, "planners"):
            make, _, _ = find_global_planner(node, kind, root)
            self._planners[name] = make(node, name, root.section(name), self._global)
        self._controllers: dict[str, LocalPlanner] = {}
        for name, kind in _listed(root, "controllers"):
            # A stand-in's parameters are renamed by the catalog, which looks below the class's name.
            space = kind.replace("::", "/").rpartition("/")[2]
            make, _, section = find_local_planner(
                node, kind, RosParameters({space: root.section(name).tree()}, node.name)
            )
            named = RosParameters(section.tree(), f"{node.name}/{name}", warn=node.log.warn)
            self._controllers[name] = make(node, name, named, root, self._local, buffer, odometry)
        self._behaviors: dict[str, RecoveryBehavior] = {}
        if "recovery_behaviors" in root:
            space, controller = next(iter(self._controllers.items()))
            surroundings = Surroundings(node, self._global, self._local, self._drive, root, controller, space)
            self._behaviors = {behavior.name: behavior for behavior in read_behaviors(root, surroundings)}
        CheckServices(node, self._global, self._local, buffer)
        servers = {
            "get_path": ("GetPath", self._get_path),
            "exe_path": ("ExePath", self._exe_path),
            "recovery": ("Recovery", self._recovery),
            "move_base": ("MoveBase", self._move_base),
        }
        self._servers = {
            name: ActionServer(node, f"~{name}", f"mbf_msgs/{kind}", work) for name, (kind, work) in servers.items()
        }
        reconfigure(node, node.name, self._settings, lambda: None)

    def _drive(self, x: float, y: float, turn: float) -> None:
        self._commands.publish({"linear": {"x": x, "y": y}, "angular": {"z": turn}})

    def _pose_in(self, costmap: CostmapRos, stamped: Any) -> Pose2D:
        """Return a pose of a message in a costmap's frame.

        Raises:
            TransformError: there is no transform.
            ValueError: the pose is not finite, or has no orientation.
        """
        pose, frame = read_pose(stamped.pose), stamped.header.frame_id.lstrip("/")
        if frame and frame != costmap.frame:
            pose = self._buffer.lookup_transform(costmap.frame, frame).pose @ pose
        return Pose2D(*planar(pose))

    def _stamped(self, costmap: CostmapRos, pose: Pose2D) -> dict[str, Any]:
        plan = Plan(costmap.frame, np.array([pose]))
        return path_message(plan, self._node.clock.now_ns())["poses"][0]

    async def _get_path(self, goal: Message, accept: Callable[[], None]) -> ActionResult:
        accept()
        name, planner = _chosen(self._planners, goal.planner)
        if planner is None:
            return _failure(_PLAN_PLUGIN, f"No planner {name!r}; there are: {', '.join(self._planners)}")
        try:
            found = self._global.robot_pose()
            start = None if found is None else Pose2D(*found)
            if goal.use_start_pose:
                start = self._pose_in(self._global, goal.start_pose)
            target = self._pose_in(self._global, goal.target_pose)
        except (TransformError, ValueError) as error:
            return _failure(_PLAN_TF, str(error))
        if start is None:
            return _failure(_PLAN_TF, "Could not get the current robot pose!")
        if any(self._global.costmap.cell(pose.x, pose.y) is None for pose in (start, target)):
            return _failure(_OFF_MAP, "The start or the goal is off the global costmap")
        tolerance = float(goal.dist_tolerance) if goal.tolerance_from_action else None
        try:
            plan = await planner.make_plan(start, target, tolerance)
        except asyncio.CancelledError:
            return ActionResult(status="preempted", result={"outcome": _PLAN_CANCELED, "message": "Canceled"})
        if plan is None:
            return _failure(_NO_PATH, "No path found")
        planner.publish(plan)
        length = float(np.hypot(*np.diff(plan.poses[:, :2], axis=0).T).sum())
        path = path_message(plan, self._node.clock.now_ns())
        return ActionResult(result={"outcome": SUCCESS, "message": "Path found", "path": path, "cost": length})

    async def _exe_path(self, goal: Message, accept: Callable[[], None]) -> ActionResult:
        accept()
        name, controller = _chosen(self._controllers, goal.controller)
        if controller is None:
            return _failure(_CONTROL_PLUGIN, f"No controller {name!r}; there are: {', '.join(self._controllers)}")
        if not goal.path.poses:
            return _failure(_EMPTY_PATH, "The path is empty")
        frame = goal.path.header.frame_id.lstrip("/") or self._global.frame
        try:
            poses = np.array([planar(read_pose(stamped.pose)) for stamped in goal.path.poses])
            end = self._pose_in(self._local, goal.path.poses[-1])
        except (TransformError, ValueError) as error:
            return _failure(_CONTROL_TF, str(error))
        plan = Plan(frame, poses)

        def feed_back(pose: Pose2D, velocity: Velocity) -> None:
            self._feed_back("exe_path", goal, self._local, pose, end, velocity)

        try:
            ended = await follow_path(
                self._node,
                self._settings,
                plan,
                costmap=self._local,
                controller=controller,
                drive=self._drive,
                feed_back=feed_back,
            )
        except asyncio.CancelledError:
            return self._at(self._local, end, "preempted", _CONTROL_CANCELED, "Controller canceled")
        status = "succeeded" if ended.outcome == SUCCESS else "aborted"
        return self._at(self._local, end, status, *ended)

    async def _recovery(self, goal: Message, accept: Callable[[], None]) -> ActionResult:
        accept()
        name, behavior = _chosen(self._behaviors, goal.behavior)
        if behavior is None:
            known = ", ".join(self._behaviors) or "none"
            return _failure(_RECOVERY_PLUGIN, f"No recovery behavior {name!r}; there are: {known}")
        try:
            await behavior.run()
        except asyncio.CancelledError:
            self._drive(0.0, 0.0, 0.0)
            result = {"outcome": _RECOVERY_CANCELED, "message": "Canceled", "used_plugin": name}
            return ActionResult(status="preempted", result=result)
        result = {"outcome": SUCCESS, "message": "Recovery done", "used_plugin": name}
        return ActionResult(result=result)

    async def _move_base(self, goal: Message, accept: Callable[[], None]) -> ActionResult:
        accept()
        self._current_goal.publish(goal.target_pose)
        try:
            target = self._pose_in(self._global, goal.target_pose)
        except (TransformError, ValueError) as error:
            return _failure(_MOVE_TF, str(error))
        planner_name, planner = _chosen(self._planners, goal.planner)
        controller_name, controller = _chosen(self._controllers, goal.controller)
        if planner is None:
            return _failure(_PLAN_PLUGIN, f"No planner {planner_name!r}; there are: {', '.join(self._planners)}")
        if controller is None:
            known = ", ".join(self._controllers)
            return _failure(_CONTROL_PLUGIN, f"No controller {controller_name!r}; there are: {known}")
        names = list(goal.recovery_behaviors) or list(self._behaviors)
        if missing := [name for name in names if name not in self._behaviors]:
            known = ", ".join(self._behaviors) or "none"
            return _failure(_RECOVERY_PLUGIN, f"No recovery behavior {missing[0]!r}; there are: {known}")
        run = GoalRun(
            self._node,
            self._settings.of_run(),
            target,
            global_costmap=self._global,
            local_costmap=self._local,
            global_planner=planner,
            local_planner=controller,
            behaviors=[self._behaviors[name] for name in names],
            drive=self._drive,
            report=_ignore,
        )

        def feed_back(pose: Pose2D) -> None:
            self._feed_back("move_base", goal, self._global, pose, target, (0.0, 0.0, 0.0))

        try:
            ended = await run.drive(feed_back)
        except asyncio.CancelledError:
            self._drive(0.0, 0.0, 0.0)
            return self._at(self._global, target, "preempted", _MOVE_CANCELED, "Canceled")
        codes = {trigger.value: code for trigger, code in _OUTCOMES.items()}
        outcome = SUCCESS if ended.status == "succeeded" else codes.get(ended.text, 10)
        return self._at(self._global, target, ended.status, outcome, ended.text)

    def _feed_back(
        self, action: str, goal: Message, costmap: CostmapRos, pose: Pose2D, end: Pose2D, velocity: Velocity
    ) -> None:
        x, y, turn = velocity
        fields: dict[str, object] = {
            **_distances(pose, end),
            "current_pose": self._stamped(costmap, pose),
            "last_cmd_vel": {"twist": {"linear": {"x": x, "y": y}, "angular": {"z": turn}}},
        }
        self._servers[action].publish_feedback(fields, goal=goal)

    def _at(self, costmap: CostmapRos, end: Pose2D, status: Any, outcome: int, message: str) -> ActionResult:
        """Return a result with the pose where the robot is now."""
        found = costmap.robot_pose()
        fields: dict[str, object] = {"outcome": outcome, "message": message}
        if found is not None:
            pose = Pose2D(*found)
            fields |= {**_distances(pose, end), "final_pose": self._stamped(costmap, pose)}
        return ActionResult(status=status, result=fields, text=message)


def _listed(root: RosParameters, name: str) -> list[tuple[str, str]]:
    """Return name and type of the plugins of a list.

    Raises:
        ParamError: the list is missing, or two plugins have one name.
    """
    found = [(section.text("name"), section.text("type")) for section in root.sections(name)]
    names = [plugin for plugin, _ in found]
    if not found or len(set(names)) < len(names):
        label = f"parameter {root.namespace}/{name}"
        raise ParamError(f"{label}: expected a list of plugins, each with a name of its own and a type")
    return found


def _chosen(plugins: dict[str, _Plugin], name: str) -> tuple[str, _Plugin | None]:
    """Return a plugin by its name; without a name the first one."""
    return (name, plugins.get(name)) if name else next(iter(plugins.items()), ("", None))


def _distances(pose: Pose2D, end: Pose2D) -> dict[str, object]:
    return {
        "dist_to_goal": math.hypot(end.x - pose.x, end.y - pose.y),
        "angle_to_goal": abs(angle_between(pose.yaw, end.yaw)),
    }


def _ignore(_pose: Pose2D, _number: int, _name: str) -> None:
    """mbf has no topic for recovery behaviors."""


def _failure(outcome: int, message: str) -> ActionResult:
    return ActionResult(status="aborted", result={"outcome": outcome, "message": message}, text=message)
