"""arbotix_python's follow_controller: trajectories for servos, as an action and on a topic."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import ActionResult, ActionServer, Node, to_nsec

from ..rate import Rate
from .controller import ArbotixJoint, DiagnosticStatus, JointReading
from .servo_controller import Servo

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs, trajectory_msgs

_ARRIVAL_MARGIN_NS = 10_000_000
"""Time before a point's time at which the point counts as reached [s]."""
_TOLERANCE_RAD = 0.001


class FollowController:
    """Commands its servos in every cycle, interpolating linearly to the next point."""

    def __init__(self, node: Node, name: str, settings: RosParameters, joints: dict[str, ArbotixJoint]) -> None:
        """Create from `~controllers/<name>`.

        Raises:
            ParamError: joints are missing, or are not servos of this driver.
        """
        self.readings: list[JointReading] = []
        self._node = node
        self._name = name
        self._rate_hz = settings.number("rate", 50.0, above=0.0)
        self._joints = settings.texts("joints")
        if not self._joints:
            raise ParamError("joints is not set; it names the servos to move")
        servos = {joint: joints.get(joint) for joint in self._joints}
        self._servos = {joint: servo for joint, servo in servos.items() if isinstance(servo, Servo)}
        if missing := sorted(set(servos) - set(self._servos)):
            raise ParamError(f"no servo {missing[0]!r}; servos here: {', '.join(joints) or 'none'}")
        action = settings.text("action_name", "follow_joint_trajectory")
        # Not below the controller's name, which `action_name` contains already: arm_controller/follow_joint_trajectory.
        self._server = ActionServer(node, action, "control_msgs/FollowJointTrajectory", self._on_goal)
        self._topic_task: asyncio.Task[ActionResult] | None = None
        for servo in self._servos.values():
            servo.is_controlled = lambda: self._active
        node.subscribe(f"{name}/command", "trajectory_msgs/JointTrajectory", self._command, queue_size=1)
        node.log.info(
            f"Started FollowController ({name}). Joints: {self._joints} on C{settings.number('index', 0.0):g}"
        )

    @property
    def _active(self) -> bool:
        return self._server.active or (self._topic_task is not None and not self._topic_task.done())

    async def _on_goal(
        self, goal: "control_msgs.FollowJointTrajectoryGoal", accept: Callable[[], None]
    ) -> ActionResult:
        accept()
        return await self._follow(goal.trajectory)

    def _command(self, trajectory: "trajectory_msgs.JointTrajectory") -> None:
        """Follow a trajectory from the topic, unless the action is active."""
        if self._server.active:
            self._node.log.info("Received trajectory, but action is active")
            return
        if self._topic_task is not None:
            self._topic_task.cancel()
        self._topic_task = asyncio.get_running_loop().create_task(self._follow(trajectory))

    async def _follow(self, trajectory: "trajectory_msgs.JointTrajectory") -> ActionResult:
        names = list(trajectory.joint_names)
        if missing := [joint for joint in self._joints if joint not in names]:
            text = f"Trajectory joint names does not match action controlled joints: {missing[0]!r} is missing"
            self._node.log.error(text)
            return ActionResult(status="aborted", text=text)
        if not trajectory.points:
            self._node.log.error("Trajectory empty.")
            return ActionResult(status="aborted", text="Trajectory empty.")
        if len(names) > len(self._joints):
            self._node.log.warn("Extra joints in trajectory")
        order = [names.index(joint) for joint in self._joints]
        if any(len(point.positions) <= max(order) for point in trajectory.points):
            return ActionResult(status="aborted", text="a point has fewer positions than there are joints")
        clock = self._node.clock
        start_ns = to_nsec(trajectory.header.stamp) or clock.now_ns()
        await clock.sleep_until(start_ns)
        rate = Rate(self._node, self._rate_hz)
        last = [self._servos[joint].reading.position for joint in self._joints]
        for point in trajectory.points:
            target = [float(point.positions[index]) for index in order]
            end_ns = start_ns + to_nsec(point.time_from_start)
            while clock.now_ns() + _ARRIVAL_MARGIN_NS < end_ns:
                self._step(last, target, cycles=self._rate_hz * (end_ns - clock.now_ns()) / 1e9)
                await rate.sleep()
        return ActionResult(text="Trajectory execution complete")

    def _step(self, last: list[float], target: list[float], *, cycles: float) -> None:
        """Move by one of the remaining cycles until the point."""
        for index, joint in enumerate(self._joints):
            error = target[index] - last[index]
            if abs(error) > _TOLERANCE_RAD:
                last[index] += error / max(cycles, 1.0)
                self._servos[joint].command(last[index])

    def update(self) -> None:
        """No-op: trajectories run in tasks."""

    def status(self) -> DiagnosticStatus:
        """Name, OK and activity."""
        state = "Active" if self._active else "Not Active"
        return DiagnosticStatus(name=self._name, values=(("State", state),))
