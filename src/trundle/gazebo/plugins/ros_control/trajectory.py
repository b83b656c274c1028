"""JointTrajectoryController of position_, velocity_ and effort_controllers."""

import asyncio
import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Self

from trundle.ros import ActionResult, ActionServer, ServiceError, to_nsec
from trundle.sim.control import ToolboxPid, TrajectoryLaw

from .controller import ControllerContext, Endpoints, InStepController, PublishTimer
from .gains import reconfigurable_pid
from .tolerances import JointTolerances, goal_tolerances, read_tolerances
from .trajectory_goal import NO_GOAL, GoalError, JointPath, PathReader, holding_path, stopping_path
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs, trajectory_msgs


class TrajectoryController(InStepController):
    """Follows trajectories of `~command` (trajectory_msgs/JointTrajectory) and the action `~follow_joint_trajectory`;
    publishes `~state`, and answers `~query_state`.

    Parameters: joints (required), gains/<joint> (p, i, d, i_clamp; not of position_controllers), velocity_ff/<joint>,
    constraints (goal_time, stopped_velocity_tolerance, <joint>/trajectory, <joint>/goal), state_publish_rate 50,
    action_monitor_rate 20, allow_partial_joints_goal false, stop_trajectory_duration 0.
    """

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        settings, node = context.settings, context.node
        self._node = node
        self._joints = [context.joint(name, self.interface) for name in context.joint_setting()]
        self._names = names = [joint.name for joint in self._joints]
        self.claims: dict[Interface | str, list[str]] = {self.interface: names}
        self._endpoints = Endpoints()
        pids: list[ToolboxPid] = []
        if self.interface != "PositionJointInterface":
            gains = settings.section("gains")
            pids = [reconfigurable_pid(node, gains.section(name), self._endpoints) for name in names]
        forward = settings.section("velocity_ff")
        self._pids = pids
        self._law = TrajectoryLaw(self._joints, pids, [forward.number(name, 0.0) for name in names])
        self.laws = (self._law,)
        self._tolerances = read_tolerances(settings.section("constraints"), names)
        self._reader = PathReader(
            names,
            [joint.is_continuous for joint in self._joints],
            partial=settings.flag("allow_partial_joints_goal", default=False),
            warn=node.log.warn,
        )
        self._stop_ns = round(settings.number("stop_trajectory_duration", 0.0, minimum=0.0) * 1e9)
        self._states = PublishTimer(settings.number("state_publish_rate", 50.0, above=0.0))
        self._monitors = PublishTimer(settings.number("action_monitor_rate", 20.0, above=0.0))
        self._paths: list[JointPath] = []
        self._goal = NO_GOAL
        """Number of the last goal of the action."""
        self._settle_goal: Callable[[ActionResult], None] | None = None
        """Function to call once with the result of the action's goal."""
        self._is_running = False
        self._advertise(context)

    def _advertise(self, context: ControllerContext) -> None:
        node = context.node
        self._state = node.advertise(
            f"{context.name}/state", "control_msgs/JointTrajectoryControllerState", queue_size=1
        )
        kind = "trajectory_msgs/JointTrajectory"
        self._endpoints.add(
            self._state,
            node.subscribe(f"{context.name}/command", kind, self._on_command, queue_size=1),
            node.advertise_service(f"{context.name}/query_state", "control_msgs/QueryTrajectoryState", self._query),
        )
        self._server = self._serve(context)

    def _serve(self, context: ControllerContext) -> ActionServer:
        action = f"{context.name}/follow_joint_trajectory"
        return ActionServer(context.node, action, "control_msgs/FollowJointTrajectory", self._on_goal, concurrent=True)

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold the current positions, or slow down to rest."""
        for joint in self._joints:
            joint.start()
        for pid in self._pids:
            pid.reset()
        self._law.start(time_ns)
        self._hold()
        self._states.restart(time_ns)
        self._is_running = True

    def due_ns(self, time_ns: int) -> float:
        """Return the time of the next message [ns]."""
        del time_ns
        feedback_ns = math.inf if self._settle_goal is None else self._monitors.next_ns
        return min(self._states.next_ns if self._state.has_subscribers else math.inf, feedback_ns)

    def update(self, time_ns: int, dt: float) -> None:
        """Settle the action's goal, and publish when due."""
        self.finish_stride()
        if self._settle_goal is not None and self._monitors.due(time_ns):
            self._server.publish_feedback(self._feedback_fields())
        self._states.skip(time_ns, dt)
        if self._states.due(time_ns) and self._state.has_subscribers:
            self._state.publish(self._state_fields())

    def finish_stride(self) -> None:
        """Settle the goal if a joint violates a tolerance or all joints have reached the goal; the joints go on
        following their paths.
        """
        event = self._law.take_event()
        if event is None:
            return
        code, joint, error = event
        if not code:
            self._settle("succeeded", 0, "")
            return
        kind = "path" if code == GoalError.PATH_TOLERANCE_VIOLATED else "goal"
        self._settle("aborted", code, f"{self._names[joint]} {kind} error {error:.6f}")

    def stop(self) -> None:
        """Stop commanding."""
        self._is_running = False
        self._settle("preempted", 0, "the controller was stopped")
        for joint in self._joints:
            joint.stop()

    def close(self) -> None:
        """Unregister its action, topics and service."""
        self._server.close()
        self._endpoints.close()

    # -- commands, on the simulation's thread

    def _on_command(self, trajectory: "trajectory_msgs.JointTrajectory") -> None:
        """Follow a trajectory from the topic; one without points holds the joints."""
        if not self._is_running:
            self._node.log.error("Can't accept new commands. Controller is not running.")
            return
        try:
            self._begin(trajectory, None, NO_GOAL)
        except GoalError as error:
            self._log_rejection(error)
            return
        self._settle("preempted", 0, "a trajectory came on the topic")

    def _begin(
        self,
        trajectory: "trajectory_msgs.JointTrajectory",
        tolerances: Sequence[JointTolerances] | None,
        goal: int,
    ) -> None:
        if not trajectory.points:
            self._hold(goal)
            return
        next_ns = self._law.time_ns + self._law.period_ns
        self._follow(self._reader.read(trajectory, self._paths, next_ns, tolerances, goal))

    def _log_rejection(self, error: GoalError) -> None:
        (self._node.log.warn if error.is_late else self._node.log.error)(str(error))

    def _hold(self, goal: int = NO_GOAL) -> None:
        """Hold the current positions; with a stop_trajectory_duration, slow down to rest."""
        time_ns = self._law.time_ns
        if not self._stop_ns:
            self._follow([holding_path(joint.position, time_ns, goal=goal) for joint in self._joints])
            return
        states = self._law.desired
        self._follow([stopping_path(x, v, time_ns, self._stop_ns, goal=goal) for x, v, _ in states])

    def _follow(self, paths: list[JointPath]) -> None:
        self._paths = paths
        self._law.set_paths([path.rows() for path in paths])

    def _query(self, request: "control_msgs.QueryTrajectoryStateRequest") -> dict[str, Any]:
        time_ns = to_nsec(request.time)
        if not self._is_running:
            raise self._sample_error("Can't sample trajectory. Controller is not running.")
        if any(path.index_at(time_ns) < 0 for path in self._paths):
            raise self._sample_error("Requested sample time precedes trajectory start time.")
        samples = [path.at(time_ns).segment.sample(time_ns) for path in self._paths]
        position, velocity, acceleration = map(list, zip(*samples, strict=True))
        return {"name": self._names, "position": position, "velocity": velocity, "acceleration": acceleration}

    def _sample_error(self, text: str) -> ServiceError:
        self._node.log.error(text)
        return ServiceError(text)

    # -- the action

    async def _on_goal(
        self, goal: "control_msgs.FollowJointTrajectoryGoal", accept: Callable[[], None]
    ) -> ActionResult:
        """Run a goal to its end, on the loop; a rejected goal does not stop the current trajectory."""
        loop = asyncio.get_running_loop()
        ended: asyncio.Future[ActionResult] = loop.create_future()

        def settle(result: ActionResult) -> None:
            self._node.loop.call_soon(lambda: None if ended.done() else ended.set_result(result))

        def begin() -> None:
            try:
                self._begin_goal(goal)
            except GoalError as error:
                self._log_rejection(error)
                settle(_action_result("rejected", error.code, str(error)))
                return
            self._settle("preempted", 0, "another goal came")
            self._node.loop.call_soon(accept)
            self._settle_goal = settle
            self._law.watches = True

        assert self._node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
        self._node.deliver(begin)
        try:
            return await ended
        except asyncio.CancelledError:
            self._node.deliver(lambda: self._abandon(settle))
            raise

    def _begin_goal(self, goal: "control_msgs.FollowJointTrajectoryGoal") -> None:
        if not self._is_running:
            raise GoalError("Can't accept new action goals. Controller is not running.")
        error = "Joints on incoming goal don't match the controller joints."
        self._reader.check_joints(goal.trajectory, error, GoalError.INVALID_JOINTS)
        self._begin(goal.trajectory, goal_tolerances(self._tolerances, goal, self._names), self._goal + 1)
        self._goal += 1
        self._law.begin_goal(self._goal)

    def _abandon(self, settle: Callable[[ActionResult], None]) -> None:
        """Hold after a goal was cancelled, unless another goal has replaced it."""
        if self._settle_goal is settle:
            self._settle_goal, self._law.watches = None, False
            self._hold()

    def _settle(self, status: Any, code: int, text: str) -> None:
        if self._settle_goal is not None:
            settle, self._settle_goal = self._settle_goal, None
            self._law.watches = False
            settle(_action_result(status, code, text))

    def _feedback_fields(self) -> dict[str, Any]:
        return self._state_fields()

    def _state_fields(self) -> dict[str, Any]:
        """Return the fields of JointTrajectoryControllerState and of the feedback; times are the first joint's."""
        joints, time_ns = self._joints, self._law.time_ns
        positions, velocities, accelerations = (list(values) for values in zip(*self._law.desired, strict=True))
        first = self._paths[0].at(time_ns)
        elapsed_ns, from_start_ns = time_ns - first.segment.start_ns, first.from_start_ns
        return {
            "header": {"stamp": time_ns},
            "joint_names": self._names,
            "desired": {
                "positions": positions,
                "velocities": velocities,
                "accelerations": accelerations,
                "time_from_start": from_start_ns,
            },
            "actual": {
                "positions": [joint.position for joint in joints],
                "velocities": [joint.velocity for joint in joints],
                "time_from_start": from_start_ns + elapsed_ns,
            },
            "error": {
                "positions": [j.shortest_error(p) for j, p in zip(joints, positions, strict=True)],
                "velocities": [v - j.velocity for j, v in zip(joints, velocities, strict=True)],
                "time_from_start": -elapsed_ns,
            },
        }


def _action_result(status: Any, code: int, text: str) -> ActionResult:
    return ActionResult(status=status, result={"error_code": code, "error_string": text}, text=text)


class EffortTrajectory(TrajectoryController):
    """effort_controllers/JointTrajectoryController."""

    interface = "EffortJointInterface"


class PositionTrajectory(TrajectoryController):
    """position_controllers/JointTrajectoryController."""

    interface = "PositionJointInterface"


class VelocityTrajectory(TrajectoryController):
    """velocity_controllers/JointTrajectoryController."""

    interface = "VelocityJointInterface"
