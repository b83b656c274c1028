"""GripperActionController of position_ and effort_controllers: moves a finger until it arrives or stalls."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Self

from trundle.ros import ActionOutcome, ActionServer

from .controller import ControllerContext, Endpoints
from .gains import reconfigurable_pid
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs


class GripperController:
    """Action `~gripper_cmd` (control_msgs/GripperCommand).

    Parameters, with the original's defaults: joint (required), goal_tolerance 0.01, stall_velocity_threshold 0.001,
    stall_timeout 1, action_monitor_rate 20 (unused: every update is checked), gains/<joint> (effort only).
    """

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        self._node = context.node
        self._joint = context.joint(settings.text("joint"), self.interface)
        self.claims: dict[Interface | str, list[str]] = {self.interface: [self._joint.name]}
        self._endpoints = Endpoints()
        self._pid = None
        if self.interface == "EffortJointInterface":
            self._pid = reconfigurable_pid(
                context.node, settings.section("gains").section(self._joint.name), self._endpoints
            )
        self._tolerance = abs(settings.number("goal_tolerance", 0.01))
        self._slow = abs(settings.number("stall_velocity_threshold", 0.001))
        self._stall_ns = round(settings.number("stall_timeout", 1.0) * 1e9)
        self._wanted = 0.0
        self._most_effort = 0.0
        self._moved_ns = 0
        self._is_running = False
        self._settled: Callable[[ActionOutcome], None] | None = None
        self._server = ActionServer(
            context.node, f"{context.name}/gripper_cmd", "control_msgs/GripperCommand", self._on_goal, side_by_side=True
        )

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold the current position."""
        self._joint.start()
        self._wanted, self._moved_ns, self._is_running = self._joint.position, time_ns, True
        self._most_effort = 0.0
        if self._pid is not None:
            self._pid.reset()

    def update(self, time_ns: int, dt: float) -> None:
        """Command the goal, and settle the action at its end."""
        joint = self._joint
        error = joint.error(self._wanted)
        if self._pid is None:
            joint.command = self._wanted
        else:
            effort = self._pid.command(error, dt, slope=-joint.velocity)
            most = self._most_effort
            joint.command = min(max(effort, -most), most) if most > 0.0 else effort
        if abs(joint.velocity) > self._slow or time_ns < self._moved_ns:
            self._moved_ns = time_ns
        if self._settled is None:
            return
        if abs(error) < self._tolerance:
            self._settle("succeeded", reached=True)
        elif time_ns - self._moved_ns > self._stall_ns:
            self._settle("aborted", reached=False)

    def stop(self) -> None:
        """Stop commanding."""
        self._is_running = False
        self._settle("preempted", reached=False)
        self._joint.stop()

    def close(self) -> None:
        """Unregister its action and topics."""
        self._settle("aborted", reached=False)
        self._server.close()
        self._endpoints.close()

    async def _on_goal(self, goal: "control_msgs.GripperCommandGoal", accept: Callable[[], None]) -> ActionOutcome:
        """Run a goal to its end; on the loop."""
        ended: asyncio.Future[ActionOutcome] = asyncio.get_running_loop().create_future()

        def settle(outcome: ActionOutcome) -> None:
            self._node.loop.call_soon(lambda: None if ended.done() else ended.set_result(outcome))

        def begin() -> None:
            if not self._is_running:
                settle(ActionOutcome(status="rejected", text="the controller is not running"))
                return
            self._settle("preempted", reached=False)
            self._node.loop.call_soon(accept)
            self._wanted, self._most_effort = float(goal.command.position), float(goal.command.max_effort)
            self._moved_ns = self._node.clock.now_ns()
            self._settled = settle

        def abandon() -> None:
            if self._settled is settle:
                self._settled = None
                self._wanted = self._joint.position

        assert self._node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
        self._node.deliver(begin)
        try:
            return await ended
        except asyncio.CancelledError:
            self._node.deliver(abandon)
            raise

    def _settle(self, status: Any, *, reached: bool) -> None:
        if self._settled is None:
            return
        settle, self._settled = self._settled, None
        joint = self._joint
        result = {"position": joint.position, "effort": joint.effort, "stalled": not reached, "reached_goal": reached}
        settle(ActionOutcome(status=status, result=result))


class EffortGripper(GripperController):
    """effort_controllers/GripperActionController."""

    interface = "EffortJointInterface"


class PositionGripper(GripperController):
    """position_controllers/GripperActionController."""

    interface = "PositionJointInterface"
