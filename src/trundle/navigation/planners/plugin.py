"""Base classes of users' planners in Python."""

import asyncio
import math
from abc import ABC, abstractmethod
from typing import final

import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from ..costmap import Costmap, CostmapRos
from ..plugin_classes import describe
from .followed_plan import FollowedPlan
from .interfaces import Plan, Pose2D
from .motion import OdometryReader, angle_between
from .path_message import path_message


class GlobalPlannerPlugin(ABC):
    """Base of a global planner: subclasses find a path through a costmap."""

    def __init__(self, node: Node, name: str, settings: RosParameters, costmap: CostmapRos) -> None:
        """Advertise `~NAME/plan`; a subclass that reads parameters calls this first."""
        self.node = node
        """Node of move_base: its topics, services, log and clock."""
        self.settings = settings
        """Parameters of the planner."""
        self.costmap_ros = costmap
        """The global costmap with its frame and footprint."""
        self._name = name
        self._plans = node.advertise(f"~{name}/plan", "nav_msgs/Path", queue_size=1)

    @abstractmethod
    def find_path(
        self, costmap: Costmap, start: Pose2D, goal: Pose2D, tolerance_m: float
    ) -> NDArray[np.float64] | None:
        """Return poses (n, 3) from start to goal: x, y [m], yaw [rad]; None: there is no path.

        It runs in a thread of its own.

        Args:
            costmap: a copy of the costs.
            start: pose of the robot.
            goal: last pose.
            tolerance_m: greatest distance of the path's end from the goal.
        """

    @final
    async def make_plan(self, start: Pose2D, goal: Pose2D, tolerance: float | None = None) -> Plan | None:
        """See `GlobalPlanner`."""
        grid = self.costmap_ros.costmap.copy()
        try:
            found = await asyncio.to_thread(self.find_path, grid, start, goal, tolerance or 0.0)
            if found is None or not len(found):
                return None
            poses = np.array(found, dtype=np.float64)
            if poses.ndim != 2 or poses.shape[1] != 3 or not np.isfinite(poses).all():
                raise ValueError(f"a path of shape {poses.shape}; expected finite numbers (n, 3)")
        except Exception as error:
            self.node.log.error(f"{self._name}: {describe(error)}")
            return None
        return Plan(self.costmap_ros.frame, poses)

    @final
    def publish(self, plan: Plan) -> None:
        """See `GlobalPlanner`."""
        if self._plans.has_subscribers:
            self._plans.publish(path_message(plan, self.node.clock.now_ns()))


class LocalPlannerPlugin(ABC):
    """Base of a local planner: subclasses choose velocities along a path.

    Parameters: xy_goal_tolerance 0.1 [m], yaw_goal_tolerance 0.1 [rad].
    """

    speed_limits = (math.inf, math.inf)
    """See `LocalPlanner`; set by move_slow_and_clear."""

    def __init__(
        self,
        node: Node,
        name: str,
        section: RosParameters,
        root: RosParameters,
        costmap: CostmapRos,
        buffer: TransformBuffer,
        odom: OdometryReader,
    ) -> None:
        """Read the tolerances; a subclass that reads parameters calls this first."""
        del root
        self.node = node
        """Node of move_base: its topics, services, log and clock."""
        self.settings = section
        """Parameters of the planner."""
        self.costmap_ros = costmap
        """The local costmap with its frame and footprint."""
        self.odometry = odom
        """The robot's velocity."""
        self._name = name
        self._plan = FollowedPlan(node, costmap, buffer)
        self._tolerances = section.number("xy_goal_tolerance", 0.1), section.number("yaw_goal_tolerance", 0.1)

    @abstractmethod
    def choose_velocity(
        self, pose: Pose2D, path: NDArray[np.float64], goal: Pose2D
    ) -> tuple[float, float, float] | None:
        """Return the velocity to command, x, y [m/s] and yaw [rad/s] in the robot's frame; None: none is valid.

        It is called in each control cycle, on the graph's thread.

        Args:
            pose: pose of the robot in the local costmap's frame.
            path: (n, 3) poses of the plan from the robot on, as far as the local costmap reaches.
            goal: the plan's last pose.
        """

    def start(self) -> None:
        """Forget the last goal's plan; subclasses may extend it."""
        self._plan.clear()

    def is_goal_reached(self) -> bool:
        """True if the robot is within the tolerances of the plan's last pose; subclasses may replace it."""
        found, goal = self.costmap_ros.robot_pose(), self._plan.goal()
        if found is None or goal is None:
            return False
        distance = math.hypot(goal.x - found[0], goal.y - found[1])
        return distance <= self._tolerances[0] and abs(angle_between(found[2], goal.yaw)) <= self._tolerances[1]

    @final
    def set_plan(self, plan: Plan) -> None:
        """See `LocalPlanner`."""
        self._plan.set(plan)

    @final
    def velocity(self) -> tuple[float, float, float] | None:
        """See `LocalPlanner`."""
        found = self.costmap_ros.robot_pose()
        if found is None:
            return None
        pose = Pose2D(*found)
        path, goal = self._plan.local(pose), self._plan.goal()
        if path is None or goal is None:
            return None
        try:
            chosen = self.choose_velocity(pose, path, goal)
            if chosen is None:
                return None
            x, y, turn = (float(value) for value in chosen)
            if not all(map(math.isfinite, (x, y, turn))):
                raise ValueError(f"the velocity {chosen} is not finite")
        except Exception as error:
            self.node.log.error(f"{self._name}: {describe(error)}")
            return None
        return x, y, turn
