"""GripperActionController of position_ and effort_controllers: moves fingers until they arrive or stall."""

import asyncio
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self

from trundle.ros import ActionResult, ActionServer, Node
from trundle.sim.control import GripperLaw, ToolboxPid

from .controller import ControllerContext, Endpoints, InStepController
from .gains import reconfigurable_pid
from .hardware import JointHardware
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs


class FingersController(InStepController):
    """Base of controllers with an action control_msgs/GripperCommand; its position is the sum of the fingers'."""

    stalled_status: ClassVar[Literal["succeeded", "aborted"]]
    """Status of a goal that the fingers did not reach."""

    def __init__(self, node: Node, fingers: Sequence[JointHardware], laws: Sequence[GripperLaw]) -> None:
        """Make a controller without its action, which `_on_goal` answers.

        Args:
            node: robot's node.
            fingers: its joints, all of one interface.
            laws: law of each finger.
        """
        self._node = node
        self._fingers, self._finger_laws = list(fingers), list(laws)
        self.claims: dict[Interface | str, list[str]] = {fingers[0].interface: [finger.name for finger in fingers]}
        self.laws = tuple(laws)
        self._arrivals: list[bool | None] = [None] * len(laws)
        """Whether each finger arrived; None while it moves."""
        self._is_running = False
        self._settle_goal: Callable[[ActionResult], None] | None = None
        self._server: ActionServer

    def start(self, time_ns: int) -> None:
        """Hold the current position."""
        for law in self._finger_laws:
            law.start(time_ns)
        self._is_running = True

    def finish_stride(self) -> None:
        """Settle the goal when every finger has arrived or stalled."""
        for number, law in enumerate(self._finger_laws):
            reached = law.take_event()
            if reached is not None:
                self._arrivals[number] = reached
                law.watches = False
        if None not in self._arrivals:
            reached = all(self._arrivals)
            self._settle("succeeded" if reached else self.stalled_status, reached=reached)

    def stop(self) -> None:
        """Stop commanding."""
        self._is_running = False
        self._settle("preempted", reached=False)
        for finger in self._fingers:
            finger.stop()

    def close(self) -> None:
        """Unregister its action."""
        self._settle("aborted", reached=False)
        self._server.close()

    def prepare(self) -> bool:
        """Return True if a goal may begin; called on the simulation's thread."""
        return self._is_running

    def limit(self, position: float, max_effort: float) -> tuple[float, float]:
        """Return the position and the effort that a goal's stand for."""
        return position, max_effort

    async def _on_goal(self, goal: "control_msgs.GripperCommandGoal", accept: Callable[[], None]) -> ActionResult:
        """Run a goal to its end; on the loop."""
        ended: asyncio.Future[ActionResult] = asyncio.get_running_loop().create_future()

        def settle(result: ActionResult) -> None:
            self._node.loop.call_soon(lambda: None if ended.done() else ended.set_result(result))

        def begin() -> None:
            if not self.prepare():
                settle(ActionResult(status="rejected", text="the controller is not running"))
                return
            self._settle("preempted", reached=False)
            self._node.loop.call_soon(accept)
            position, effort = self.limit(float(goal.command.position), float(goal.command.max_effort))
            self._settle_goal, self._arrivals = settle, [None] * len(self._finger_laws)
            for law in self._finger_laws:
                law.begin(position / len(self._finger_laws), effort, self._node.clock.now_ns())
                law.watches = True

        def abandon() -> None:
            if self._settle_goal is settle:
                self._settle_goal = None
                for law in self._finger_laws:
                    law.watches = False
                    law.hold()

        assert self._node.deliver is not None, "plugins' nodes deliver to the simulation's thread"
        self._node.deliver(begin)
        try:
            return await ended
        except asyncio.CancelledError:
            self._node.deliver(abandon)
            raise

    def _settle(self, status: Any, *, reached: bool) -> None:
        self._arrivals = [None] * len(self._finger_laws)
        for law in self._finger_laws:
            law.watches = False
        if self._settle_goal is None:
            return
        settle, self._settle_goal = self._settle_goal, None
        position, effort = (sum(getattr(finger, name) for finger in self._fingers) for name in ("position", "effort"))
        result = {"position": position, "effort": effort, "stalled": not reached, "reached_goal": reached}
        settle(ActionResult(status=status, result=result))


class GripperController(FingersController):
    """Action `~gripper_cmd` (control_msgs/GripperCommand).

    Parameters, with the original's defaults: joint (required), goal_tolerance 0.01, stall_velocity_threshold 0.001,
    stall_timeout 1, action_monitor_rate 20 (unused: every update is checked), gains/<joint> (effort only).
    """

    interface: ClassVar[Interface]
    stalled_status = "aborted"

    def __init__(self, context: ControllerContext) -> None:
        settings = context.settings
        joint = context.joint(settings.text("joint"), self.interface)
        self._endpoints = Endpoints()
        pid: ToolboxPid | None = None
        if self.interface == "EffortJointInterface":
            pid = reconfigurable_pid(context.node, settings.section("gains").section(joint.name), self._endpoints)
        law = GripperLaw(
            joint,
            pid,
            tolerance=abs(settings.number("goal_tolerance", 0.01)),
            min_speed=abs(settings.number("stall_velocity_threshold", 0.001)),
            stall_ns=round(settings.number("stall_timeout", 1.0) * 1e9),
        )
        super().__init__(context.node, [joint], [law])
        self._server = ActionServer(
            context.node, f"{context.name}/gripper_cmd", "control_msgs/GripperCommand", self._on_goal, concurrent=True
        )

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def close(self) -> None:
        """Unregister its action and topics."""
        super().close()
        self._endpoints.close()


class EffortGripper(GripperController):
    """effort_controllers/GripperActionController."""

    interface = "EffortJointInterface"


class PositionGripper(GripperController):
    """position_controllers/GripperActionController."""

    interface = "PositionJointInterface"
