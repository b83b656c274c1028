"""The way to one goal: plan, control, recover."""

import asyncio
import enum
import math
from collections.abc import Callable, Sequence
from typing import Protocol

from trundle.gazebo.nodes.rate import Rate
from trundle.ros import ActionResult, Node
from trundle.spatial import NS_PER_S

from ..costmap import CostmapRos
from ..planners import GlobalPlanner, LocalPlanner, Plan, Pose2D
from .recovery import Drive, RecoveryBehavior


class RunSettings(Protocol):
    """Parameters of a run; dynamic_reconfigure may change them during it."""

    planner_frequency: float
    controller_frequency: float
    planner_patience: float
    controller_patience: float
    max_planning_retries: int
    recovery_behavior_enabled: bool
    oscillation_timeout: float
    oscillation_distance: float


class State(enum.Enum):
    """move_base's states."""

    PLANNING = enum.auto()
    CONTROLLING = enum.auto()
    CLEARING = enum.auto()


class Trigger(enum.Enum):
    """Why a recovery behavior runs."""

    PLANNING = "Failed to find a valid plan. Even after executing recovery behaviors."
    CONTROLLING = "Failed to find a valid control. Even after executing recovery behaviors."
    OSCILLATION = "Robot is oscillating. Even after executing recovery behaviors."


class GoalRun:
    """Cycles at the controller's frequency until the goal is reached or given up."""

    def __init__(
        self,
        node: Node,
        settings: RunSettings,
        goal: Pose2D,
        *,
        global_costmap: CostmapRos,
        local_costmap: CostmapRos,
        global_planner: GlobalPlanner,
        local_planner: LocalPlanner,
        behaviors: Sequence[RecoveryBehavior],
        drive: Drive,
        report: Callable[[Pose2D, int, str], None],
    ) -> None:
        """Begin a run.

        Args:
            node: node that logs.
            settings: parameters.
            goal: in the global costmap's frame.
            global_costmap: costmap of the global planner.
            local_costmap: costmap of the local planner.
            global_planner: makes plans.
            local_planner: follows them.
            behaviors: recovery behaviors, in the order in which they are tried.
            drive: commands a velocity.
            report: called with pose, number and name before a behavior runs.
        """
        self._node = node
        self._settings = settings
        self._goal = goal
        self._global_costmap = global_costmap
        self._local_costmap = local_costmap
        self._global_planner = global_planner
        self._local_planner = local_planner
        self._behaviors = behaviors
        self._drive = drive
        self._report = report
        self._state = State.PLANNING
        self._trigger = Trigger.PLANNING
        self._next_behavior = 0
        self._retries = 0
        now_ns = node.clock.now_ns()
        self._planned_ns = self._valid_plan_ns = self._valid_control_ns = self._moved_ns = now_ns
        self._moved_from: Pose2D | None = None
        self._planning: asyncio.Task[Plan | None] | None = None

    async def drive(self, feed_back: Callable[[Pose2D], None]) -> ActionResult:
        """Drive to the goal; returns how it ended."""
        try:
            return await self._drive_on(feed_back)
        finally:
            if self._planning is not None:
                self._planning.cancel()

    async def _drive_on(self, feed_back: Callable[[Pose2D], None]) -> ActionResult:
        node = self._node
        rate = Rate(node, max(self._settings.controller_frequency, 0.1))
        self._local_planner.start()
        while not node.closed.is_set():
            found = self._global_costmap.robot_pose()
            if found is None:
                self._drive(0.0, 0.0, 0.0)
            else:
                feed_back(Pose2D(*found))
                result = await self._cycle(Pose2D(*found))
                if result is not None:
                    return result
            await rate.sleep()
        self._drive(0.0, 0.0, 0.0)
        return ActionResult(status="aborted", text="Aborting on the goal because the node has been killed")

    async def _cycle(self, pose: Pose2D) -> ActionResult | None:
        self._watch_oscillation(pose)
        if not self._local_costmap.is_current:
            self._node.log.warn(
                f"[{self._node.name}]:Sensor data is out of date, we're not going to allow commanding of the base "
                "for safety"
            )
            self._drive(0.0, 0.0, 0.0)
            return None
        if self._planning is not None and self._planning.done():
            self._take(self._planning.result())
        if self._is_plan_due():
            self._begin_plan(pose)
        if self._state is State.CONTROLLING:
            return self._control()
        if self._state is State.CLEARING:
            return await self._recover(pose)
        self._drive(0.0, 0.0, 0.0)
        return None

    def _seconds_since(self, time_ns: int) -> float:
        return (self._node.clock.now_ns() - time_ns) / NS_PER_S

    def _watch_oscillation(self, pose: Pose2D) -> None:
        origin = self._moved_from
        distance = self._settings.oscillation_distance
        if origin is None or math.hypot(pose.x - origin.x, pose.y - origin.y) >= distance:
            self._moved_ns, self._moved_from = self._node.clock.now_ns(), pose
            if self._trigger is Trigger.OSCILLATION:
                self._next_behavior = 0

    def _is_plan_due(self) -> bool:
        if self._planning is not None:
            return False
        if self._state is State.PLANNING:
            return True
        frequency = self._settings.planner_frequency
        period_s = 1.0 / frequency - 1e-6 if frequency > 0.0 else math.inf
        return self._state is State.CONTROLLING and self._seconds_since(self._planned_ns) >= period_s

    def _begin_plan(self, pose: Pose2D) -> None:
        """Plan beside the control cycles; simulated time waits, so that every run gets the plan at the same cycle."""
        work = self._node.loop.work
        planning = work.start("a plan")
        self._planned_ns = self._node.clock.now_ns()
        self._planning = asyncio.create_task(self._global_planner.make_plan(pose, self._goal))
        self._planning.add_done_callback(lambda _: work.finish(planning))

    def _take(self, plan: Plan | None) -> None:
        """Follow a new plan; without one, keep the last, and recover after planner_patience or max_planning_retries."""
        self._planning = None
        if plan is not None:
            self._valid_plan_ns, self._retries = self._planned_ns, 0
            self._global_planner.publish(plan)
            self._local_planner.set_plan(plan)
            if self._state is State.PLANNING:
                self._state = State.CONTROLLING
                if self._trigger is Trigger.PLANNING:
                    self._next_behavior = 0
            return
        if self._state is not State.PLANNING:
            return
        self._retries += 1
        limit = self._settings.max_planning_retries
        is_late = self._seconds_since(self._valid_plan_ns) > self._settings.planner_patience
        if is_late or 0 <= limit < self._retries:
            self._begin_recovery(Trigger.PLANNING)

    def _begin_recovery(self, trigger: Trigger) -> None:
        self._drive(0.0, 0.0, 0.0)
        self._state, self._trigger = State.CLEARING, trigger

    def _control(self) -> ActionResult | None:
        planner, settings = self._local_planner, self._settings
        if planner.is_goal_reached():
            self._drive(0.0, 0.0, 0.0)
            return ActionResult(status="succeeded", text="Goal reached.")
        if 0.0 < settings.oscillation_timeout < self._seconds_since(self._moved_ns):
            self._begin_recovery(Trigger.OSCILLATION)
            return None
        velocity = planner.velocity()
        if velocity is not None:
            self._valid_control_ns = self._node.clock.now_ns()
            self._drive(*velocity)
            if self._trigger is Trigger.CONTROLLING:
                self._next_behavior = 0
        elif self._seconds_since(self._valid_control_ns) > settings.controller_patience:
            self._begin_recovery(Trigger.CONTROLLING)
        else:
            self._valid_plan_ns, self._retries = self._node.clock.now_ns(), 0
            self._state = State.PLANNING
            self._drive(0.0, 0.0, 0.0)
        return None

    async def _recover(self, pose: Pose2D) -> ActionResult | None:
        """Run the next behavior; without one, give the goal up."""
        if not self._settings.recovery_behavior_enabled or self._next_behavior >= len(self._behaviors):
            self._drive(0.0, 0.0, 0.0)
            reason = self._trigger.value
            self._node.log.error(f"Aborting because: {reason}")
            return ActionResult(status="aborted", text=reason)
        behavior = self._behaviors[self._next_behavior]
        self._report(pose, self._next_behavior, behavior.name)
        await behavior.run()
        now_ns = self._node.clock.now_ns()
        self._moved_ns = self._valid_plan_ns = now_ns
        self._valid_control_ns = now_ns
        self._retries = 0
        self._state = State.PLANNING
        self._next_behavior += 1
        return None
