"""move_group's node: the robot, the scene, pipelines, controllers, and the capabilities asked for."""

import asyncio
import os
from pathlib import Path

from trundle.base.diagnostics import TrundleError
from trundle.gazebo.nodes import NodeHost
from trundle.planning.kinematics import Kinematics
from trundle.robots.packages import Packages
from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformListener

from .capabilities import CAPABILITIES, DEFAULTS
from .current_state_monitor import CurrentStateMonitor
from .move_group_context import MoveGroupContext
from .octomap_monitor import OctomapMonitor
from .pipelines import Pipelines
from .planning_scene_monitor import MonitorSettings, PlanningSceneMonitor
from .robot_description import RobotDescription, read_robot_description
from .scene import SceneMirror
from .settings import read_settings
from .trajectory_execution import ExecutionSettings, TrajectoryExecution

_READY = "You can start planning now!"


class MoveGroup:
    """Plans and executes for the groups of an SRDF: MoveIt's node, by its names.

    Parameters: robot_description with _semantic, _planning and _kinematics; ~planning_pipelines (or ~planning_plugin
    and its settings in the node's own namespace), ~default_planning_pipeline, ~capabilities, ~disable_capabilities,
    ~allow_trajectory_execution, ~moveit_controller_manager with its lists, ~trajectory_execution,
    ~planning_scene_monitor, ~sensors.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        self._node = node
        self._arguments = arguments
        self._env = host.env

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        try:
            root = RosParameters(await node.params.get("~", {}), node.name, warn=node.log.warn)
            description = await read_robot_description(node, root.text("robot_description", "robot_description"))
            context = await self._context(root, description)
            names = self._capabilities(root, context)
        except TrundleError as error:
            node.log.fatal(str(error))
            return 1
        for name in names:
            for offer in CAPABILITIES[name]:
                offer(context)
        listed = "\n".join(f"*     - {name.partition('/')[2]}" for name in names)
        stars = "*" * 56
        node.log.info(f"\n\n{stars}\n* MoveGroup using: \n{listed}\n{stars}\n")
        node.log.info(f"MoveGroup context using planning plugin {context.pipelines.default.plugin}")
        node.log.info("MoveGroup context initialization complete")
        await node.wait_registered()
        node.log.info(_READY if names else "move_group is running but no capabilities are loaded.")
        tasks = [asyncio.create_task(context.monitor.publish_changes())]
        try:
            await node.closed.wait()
        finally:
            for task in tasks:
                task.cancel()
        return 0

    async def _context(self, root: RosParameters, description: RobotDescription) -> MoveGroupContext:
        node = self._node
        buffer = TransformListener(node).buffer
        kinematics = Kinematics(description.model)
        settings = read_settings(MonitorSettings, root.section("planning_scene_monitor"))
        monitor = PlanningSceneMonitor(node, description, kinematics, buffer, settings)
        packages = Packages({**os.environ, **self._env}, start=Path.cwd())
        mirror = await asyncio.to_thread(SceneMirror, node, description.model, packages)
        execution = None
        if root.flag("allow_trajectory_execution", default=True):
            execution = self._execution(root, description, monitor.state)
        OctomapMonitor(node, root, monitor)
        return MoveGroupContext(
            node=node,
            description=description,
            monitor=monitor,
            pipelines=Pipelines(node, root, description, mirror),
            execution=execution,
            display=node.advertise("~display_planned_path", "moveit_msgs/DisplayTrajectory", latch=True),
        )

    def _execution(
        self, root: RosParameters, description: RobotDescription, state: CurrentStateMonitor
    ) -> TrajectoryExecution:
        settings = read_settings(ExecutionSettings, root.section("trajectory_execution"))
        execution = TrajectoryExecution(self._node, description, state, settings)
        execution.open(root)
        return execution

    def _capabilities(self, root: RosParameters, context: MoveGroupContext) -> list[str]:
        """Return the capabilities: the default ones, those of ~capabilities and of pipelines, less the disabled."""
        wanted = [*DEFAULTS, *root.text("capabilities", "").split(), *context.pipelines.capabilities()]
        disabled = set(root.text("disable_capabilities", "").split())
        names: list[str] = []
        for name in dict.fromkeys(wanted):
            if name in disabled:
                continue
            if name in CAPABILITIES:
                names.append(name)
            else:
                known = ", ".join(CAPABILITIES)
                self._node.log.error(f"no capability '{name}'; there are: {known}")
        return names
