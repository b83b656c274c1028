"""The action exe_path: a controller follows one path."""

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

from trundle.gazebo.nodes.rate import Rate
from trundle.ros import Node
from trundle.spatial import NS_PER_S

from ..costmap import CostmapRos
from ..planners import LocalPlanner, Plan, Pose2D

SUCCESS, NO_VALID_COMMAND, PATIENCE_EXCEEDED, OSCILLATION, TF_ERROR, STOPPED = 0, 102, 103, 105, 111, 117
Velocity = tuple[float, float, float]


class ControllerSettings(Protocol):
    """Parameters of a run; dynamic_reconfigure may change them during it."""

    controller_frequency: float
    controller_patience: float
    controller_max_retries: int
    oscillation_timeout: float
    oscillation_distance: float


class Ended(NamedTuple):
    """How a run ended: result code of mbf_msgs/ExePath, and its message."""

    outcome: int
    message: str


async def follow_path(
    node: Node,
    settings: ControllerSettings,
    plan: Plan,
    *,
    costmap: CostmapRos,
    controller: LocalPlanner,
    drive: Callable[[float, float, float], None],
    feed_back: Callable[[Pose2D, Velocity], None],
) -> Ended:
    """Follow a path until its end is reached or the controller gives up; the robot stops at the end."""
    clock = node.clock
    rate = Rate(node, max(settings.controller_frequency, 0.1))
    controller.start()
    controller.set_plan(plan)
    valid_ns = moved_ns = clock.now_ns()
    moved_from: Pose2D | None = None
    failures = 0
    try:
        while not node.closed.is_set():
            found, now_ns = costmap.robot_pose(), clock.now_ns()
            if found is None:
                return Ended(TF_ERROR, "Could not get the robot pose")
            pose = Pose2D(*found)
            if moved_from is None or math.dist(pose[:2], moved_from[:2]) >= settings.oscillation_distance:
                moved_ns, moved_from = now_ns, pose
            if controller.is_goal_reached():
                return Ended(SUCCESS, "Controller succeeded; arrived at goal!")
            if 0.0 < settings.oscillation_timeout < (now_ns - moved_ns) / NS_PER_S:
                return Ended(OSCILLATION, "Oscillation detected!")
            velocity = controller.velocity() if costmap.is_current else (0.0, 0.0, 0.0)
            if velocity is not None:
                valid_ns, failures = now_ns, 0
            else:
                failures += 1
                if 0 <= settings.controller_max_retries < failures:
                    return Ended(NO_VALID_COMMAND, "Controller failed to compute a valid velocity command")
                if 0.0 < settings.controller_patience < (now_ns - valid_ns) / NS_PER_S:
                    return Ended(PATIENCE_EXCEEDED, "Controller patience exceeded")
            command = velocity or (0.0, 0.0, 0.0)
            drive(*command)
            feed_back(pose, command)
            await rate.sleep()
        return Ended(STOPPED, "The node has been stopped")
    finally:
        drive(0.0, 0.0, 0.0)
