"""JointTrajectoryController of position_, velocity_ and effort_controllers."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Self

from trundle.control import ToolboxPid
from trundle.ros import ActionOutcome, ActionServer, to_nsec

from .controller import ControllerContext, Endpoints, PublishTimer
from .gains import reconfigurable_pid
from .hardware import JointHardware
from .trajectory_goal import GoalError, SampledTrajectory, Tolerances, read_tolerances, read_trajectory
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs, trajectory_msgs

_GRACE_S = 0.2
"""Added to `goal_time` [s]: joints here lag by a few steps, while gazebo_ros_control sets positions at once."""


class TrajectoryController:
    """Follows trajectories of `~command` (trajectory_msgs/JointTrajectory) and the action `~follow_joint_trajectory`;
    publishes `~state`, and answers `~query_state`.

    Parameters: joints (required), gains/<joint> (p, i, d, i_clamp; not of position_controllers), velocity_ff/<joint>,
    constraints (goal_time, stopped_velocity_tolerance, <joint>/trajectory, <joint>/goal), state_publish_rate 50,
    action_monitor_rate 20, allow_partial_joints_goal false.
    """

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        settings, node = context.settings, context.node
        self._node = node
        self._joints = [context.joint(name, self.interface) for name in context.joint_setting()]
        names = [joint.name for joint in self._joints]
        self.claims: dict[Interface | str, list[str]] = {self.interface: names}
        self._endpoints = Endpoints()
        self._pids: list[ToolboxPid] = []
        if self.interface != "PositionJointInterface":
            gains = settings.section("gains")
            self._pids = [reconfigurable_pid(node, gains.section(name), self._endpoints) for name in names]
        forward = settings.section("velocity_ff")
        self._forward = [forward.number(name, 0.0) for name in names]
        self._default_tolerances = read_tolerances(settings.section("constraints"), names)
        self._partial = settings.flag("allow_partial_joints_goal", default=False)
        self._states = PublishTimer(settings.number("state_publish_rate", 50.0, above=0.0))
        self._monitors = PublishTimer(settings.number("action_monitor_rate", 20.0, above=0.0))
        self._trajectory: SampledTrajectory | None = None
        self._time_ns = 0
        self._settled: Callable[[ActionOutcome], None] | None = None
        """Called once with the outcome of the action's goal."""
        self._is_running = False
        self._state = node.advertise(
            f"{context.name}/state", "control_msgs/JointTrajectoryControllerState", queue_size=1
        )
        kind = "trajectory_msgs/JointTrajectory"
        self._endpoints.add(
            self._state,
            node.subscribe(f"{context.name}/command", kind, self._on_command, queue_size=1),
            node.advertise_service(f"{context.name}/query_state", "control_msgs/QueryTrajectoryState", self._query),
        )
        action = f"{context.name}/follow_joint_trajectory"
        self._server = ActionServer(
            node, action, "control_msgs/FollowJointTrajectory", self._on_goal, side_by_side=True
        )

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold the current positions."""
        self._time_ns = time_ns
        for joint in self._joints:
            joint.start()
        for pid in self._pids:
            pid.reset()
        self._settle("aborted", 0, "the controller was restarted")
        self._hold()
        self._states.restart(time_ns)
        self._is_running = True

    def update(self, time_ns: int, dt: float) -> None:
        """Command the trajectory's current state."""
        self._time_ns = time_ns
        sampled = self._trajectory
        if sampled is None:
            return
        desired = sampled.sample(time_ns)
        for number, (joint, (position, velocity, _)) in enumerate(zip(self._joints, desired, strict=True)):
            if not self._pids:
                joint.command = position
                continue
            slope = velocity - joint.velocity
            command = self._pids[number].command(joint.error(position), dt, slope=slope)
            joint.command = command + self._forward[number] * velocity
        if self._settled is not None:
            self._check_tolerances(sampled, desired)
        if self._states.due(time_ns) and self._state.has_subscribers:
            self._state.publish({"header": {"stamp": time_ns}, **self._desired_fields(desired)})

    def stop(self) -> None:
        """Stop commanding."""
        self._is_running = False
        self._settle("preempted", 0, "the controller was stopped")
        for joint in self._joints:
            joint.stop()

    def close(self) -> None:
        """Unregister its action, topics and service."""
        self._settle("aborted", 0, "the controller was unloaded")
        self._server.close()
        self._endpoints.close()

    # -- commands, on the simulation's thread

    def _on_command(self, trajectory: "trajectory_msgs.JointTrajectory") -> None:
        """Follow a trajectory from the topic; one without points holds the joints."""
        if not self._is_running:
            self._node.log.error("Can't accept new commands. Controller is not running.")
            return
        try:
            self._begin(trajectory, self._default_tolerances)
        except GoalError as error:
            self._node.log.error(str(error))
            return
        self._settle("preempted", 0, "a trajectory came on the topic")

    def _begin(self, trajectory: "trajectory_msgs.JointTrajectory", tolerances: Tolerances) -> None:
        if not trajectory.points:
            self._hold()
            return
        assert self._trajectory is not None, "start() comes first"
        now = self._trajectory.sample(self._time_ns)
        names = [joint.name for joint in self._joints]
        sampled = read_trajectory(trajectory, names, now, self._time_ns, tolerances, partial=self._partial)
        for number, joint in enumerate(self._joints):
            if joint.is_continuous:  # take the shorter way round to the first point
                sampled.unwind(number)
        self._trajectory = sampled

    def _hold(self) -> None:
        self._trajectory = SampledTrajectory.hold_position(
            [joint.position for joint in self._joints], self._time_ns, self._default_tolerances
        )

    def _query(self, request: "control_msgs.QueryTrajectoryStateRequest") -> dict[str, Any]:
        sampled = self._trajectory or SampledTrajectory.hold_position(
            [joint.position for joint in self._joints], 0, self._default_tolerances
        )
        position, velocity, acceleration = zip(*sampled.sample(to_nsec(request.time)), strict=True)
        return {
            "name": [joint.name for joint in self._joints],
            "position": list(position),
            "velocity": list(velocity),
            "acceleration": list(acceleration),
        }

    # -- the action

    async def _on_goal(
        self, goal: "control_msgs.FollowJointTrajectoryGoal", accept: Callable[[], None]
    ) -> ActionOutcome:
        """Run a goal to its end, on the loop; a rejected one does not stop the trajectory before it."""
        loop = asyncio.get_running_loop()
        ended: asyncio.Future[ActionOutcome] = loop.create_future()

        def settle(outcome: ActionOutcome) -> None:
            self._node.loop.call_soon(lambda: None if ended.done() else ended.set_result(outcome))

        def begin() -> None:
            if not self._is_running:
                settle(_outcome("rejected", GoalError.INVALID_GOAL, "the controller is not running"))
                return
            names = [joint.name for joint in self._joints]
            try:
                self._begin(goal.trajectory, self._default_tolerances.with_goal(goal, names))
            except GoalError as error:
                settle(_outcome("rejected", error.code, str(error)))
                return
            self._settle("preempted", 0, "another goal came")
            self._node.loop.call_soon(accept)
            self._settled = settle

        assert self._node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
        self._node.deliver(begin)
        try:
            return await ended
        except asyncio.CancelledError:
            self._node.deliver(lambda: self._abandon(settle))
            raise

    def _abandon(self, settle: Callable[[ActionOutcome], None]) -> None:
        """Hold after a goal was cancelled, unless another has replaced it."""
        if self._settled is settle:
            self._settled = None
            self._hold()

    def _check_tolerances(self, sampled: SampledTrajectory, desired: list[tuple[float, float, float]]) -> None:
        """Check the tolerances, and settle the action or publish its feedback."""
        tolerances, late_s = sampled.tolerances, (self._time_ns - sampled.end_ns) / 1e9
        for number, joint in enumerate(self._joints):
            error = abs(joint.error(desired[number][0]))
            if late_s < 0.0 and 0.0 < tolerances.path[number] < error:
                text = f"{joint.name} is {error:.4g} off its path, more than {tolerances.path[number]:g}"
                self._hold()
                self._settle("aborted", GoalError.PATH_TOLERANCE_VIOLATED, text)
                return
        if late_s >= 0.0:
            far = [j for n, j in enumerate(self._joints) if not self._has_arrived(j, desired[n][0], n, tolerances)]
            if not far:
                self._settle("succeeded", 0, "")
            elif late_s > tolerances.time_s + _GRACE_S:
                text = f"{far[0].name} is {abs(far[0].error(desired[self._joints.index(far[0])][0])):.4g} off its goal"
                self._settle("aborted", GoalError.GOAL_TOLERANCE_VIOLATED, text)
            return
        if self._monitors.due(self._time_ns):
            self._server.publish_feedback(self._desired_fields(desired))

    def _has_arrived(self, joint: JointHardware, position: float, number: int, tolerances: Tolerances) -> bool:
        at = tolerances.goal[number] <= 0.0 or abs(joint.error(position)) <= tolerances.goal[number]
        return at and (tolerances.stopped <= 0.0 or abs(joint.velocity) <= tolerances.stopped)

    def _settle(self, status: Any, code: int, text: str) -> None:
        if self._settled is not None:
            settle, self._settled = self._settled, None
            settle(_outcome(status, code, text))

    def _desired_fields(self, desired: list[tuple[float, float, float]]) -> dict[str, Any]:
        joints = self._joints
        positions, velocities, accelerations = (list(values) for values in zip(*desired, strict=True))
        return {
            "joint_names": [joint.name for joint in joints],
            "desired": {"positions": positions, "velocities": velocities, "accelerations": accelerations},
            "actual": {"positions": [j.position for j in joints], "velocities": [j.velocity for j in joints]},
            "error": {
                "positions": [j.error(p) for j, p in zip(joints, positions, strict=True)],
                "velocities": [v - j.velocity for j, v in zip(joints, velocities, strict=True)],
            },
        }


def _outcome(status: Any, code: int, text: str) -> ActionOutcome:
    return ActionOutcome(status=status, result={"error_code": code, "error_string": text}, text=text)


class EffortTrajectory(TrajectoryController):
    """effort_controllers/JointTrajectoryController."""

    interface = "EffortJointInterface"


class PositionTrajectory(TrajectoryController):
    """position_controllers/JointTrajectoryController."""

    interface = "PositionJointInterface"


class VelocityTrajectory(TrajectoryController):
    """velocity_controllers/JointTrajectoryController."""

    interface = "VelocityJointInterface"
