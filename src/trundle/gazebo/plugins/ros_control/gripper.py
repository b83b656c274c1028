"""GripperActionController of position_ and effort_controllers: moves a finger until it arrives or stalls."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, Self

from trundle.ros import ActionResult, ActionServer
from trundle.sim.control import GripperLaw

from .controller import ControllerContext, Endpoints, InStepController
from .gains import reconfigurable_pid
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs


class GripperController(InStepController):
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
        pid = None
        if self.interface == "EffortJointInterface":
            pid = reconfigurable_pid(context.node, settings.section("gains").section(self._joint.name), self._endpoints)
        self._law = GripperLaw(
            self._joint,
            pid,
            tolerance=abs(settings.number("goal_tolerance", 0.01)),
            min_speed=abs(settings.number("stall_velocity_threshold", 0.001)),
            stall_ns=round(settings.number("stall_timeout", 1.0) * 1e9),
        )
        self.laws = (self._law,)
        self._is_running = False
        self._settle_goal: Callable[[ActionResult], None] | None = None
        self._server = ActionServer(
            context.node, f"{context.name}/gripper_cmd", "control_msgs/GripperCommand", self._on_goal, concurrent=True
        )

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold the current position."""
        self._law.start(time_ns)
        self._is_running = True

    def finish_stride(self) -> None:
        """Settle the goal at its end."""
        reached = self._law.take_event()
        if reached is not None:
            self._settle("succeeded" if reached else "aborted", reached=reached)

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

    async def _on_goal(self, goal: "control_msgs.GripperCommandGoal", accept: Callable[[], None]) -> ActionResult:
        """Run a goal to its end; on the loop."""
        ended: asyncio.Future[ActionResult] = asyncio.get_running_loop().create_future()

        def settle(result: ActionResult) -> None:
            self._node.loop.call_soon(lambda: None if ended.done() else ended.set_result(result))

        def begin() -> None:
            if not self._is_running:
                settle(ActionResult(status="rejected", text="the controller is not running"))
                return
            self._settle("preempted", reached=False)
            self._node.loop.call_soon(accept)
            command = goal.command
            self._law.begin(float(command.position), float(command.max_effort), self._node.clock.now_ns())
            self._settle_goal, self._law.watches = settle, True

        def abandon() -> None:
            if self._settle_goal is settle:
                self._settle_goal, self._law.watches = None, False
                self._law.hold()

        assert self._node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
        self._node.deliver(begin)
        try:
            return await ended
        except asyncio.CancelledError:
            self._node.deliver(abandon)
            raise

    def _settle(self, status: Any, *, reached: bool) -> None:
        if self._settle_goal is None:
            return
        settle, self._settle_goal = self._settle_goal, None
        self._law.watches = False
        joint = self._joint
        result = {"position": joint.position, "effort": joint.effort, "stalled": not reached, "reached_goal": reached}
        settle(ActionResult(status=status, result=result))


class EffortGripper(GripperController):
    """effort_controllers/GripperActionController."""

    interface = "EffortJointInterface"


class PositionGripper(GripperController):
    """position_controllers/GripperActionController."""

    interface = "PositionJointInterface"
