"""arbotix_controllers/gripper_controller: opening [m] as an action in, servo angles out."""

import asyncio
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import ActionResult, ActionServer, Node

from ..host import NodeHost
from ..private_parameters import private_parameters

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs, sensor_msgs

_TOLERANCE_RAD = 0.02
"""Tolerance of a reached command; servos count in ticks of 0.3 degrees."""
_POLL_S = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Jaw:
    """One servo of a gripper, with its offset and direction."""

    joint: str
    center: float = 0.0
    sign: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Gripper:
    """Linkage of a gripper; with `finger_length_m` None, commands are proportional to the opening."""

    jaws: tuple[Jaw, ...]
    pad_width_m: float = 0.01
    finger_length_m: float | None = None
    scale: float = 1.0
    min_opening_m: float = -math.inf
    max_opening_m: float = math.inf
    bounded: bool = False
    """True: openings are clamped to the limits; else rejected."""

    def commands(self, opening_m: float) -> dict[str, float]:
        """Compute the commands by joint.

        Raises:
            ValueError: the opening is out of range.
        """
        if self.bounded:
            opening_m = min(max(opening_m, self.min_opening_m), self.max_opening_m)
        if not self.min_opening_m <= opening_m <= self.max_opening_m:
            raise ValueError(
                f"{opening_m:g} m exceeds the opening limits {self.min_opening_m:g} … {self.max_opening_m:g} m"
            )
        if self.finger_length_m is None:
            return {jaw.joint: opening_m * self.scale + jaw.center for jaw in self.jaws}
        sine = (opening_m - self.pad_width_m) / (2.0 * self.finger_length_m)
        if not -1.0 <= sine <= 1.0:
            raise ValueError(f"fingers of {self.finger_length_m:g} m cannot open {opening_m:g} m")
        return {jaw.joint: jaw.sign * math.asin(sine) + jaw.center for jaw in self.jaws}


def read_gripper(settings: RosParameters) -> Gripper:
    """Create from the node's parameters.

    Raises:
        ParamError: the model is missing or unknown.
    """
    model = settings.text("model")
    if model == "parallel":
        jaw = Jaw(joint=settings.text("joint", "gripper_joint"), center=settings.number("center", 0.0))
        return Gripper(jaws=(jaw,), scale=settings.number("scale", 1.0))
    if model == "singlesided":
        jaws = (_jaw(settings, "joint", "gripper_joint", "center", "invert", sign=1.0),)
    elif model == "dualservo":
        jaws = (
            _jaw(settings, "joint_left", "l_gripper_joint", "center_left", "invert_left", sign=1.0),
            _jaw(settings, "joint_right", "r_gripper_joint", "center_right", "invert_right", sign=-1.0),
        )
    else:
        raise ParamError(f"no gripper model {model!r}; models: dualservo, parallel, singlesided")
    return Gripper(
        jaws=jaws,
        pad_width_m=settings.number("pad_width", 0.01),
        finger_length_m=settings.number("finger_length", 0.02),
        min_opening_m=settings.number("min_opening", 0.0),
        max_opening_m=settings.number("max_opening", 0.09),
        bounded=model == "singlesided",
    )


def _jaw(settings: RosParameters, joint: str, default: str, center: str, invert: str, *, sign: float) -> Jaw:
    direction = -sign if settings.flag(invert, default=False) else sign
    return Jaw(joint=settings.text(joint, default), center=settings.number(center, 0.0), sign=direction)


class GripperController:
    """Commands its servos until they reach the goal or stall."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._positions: dict[str, float] = {}

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        try:
            self._gripper = read_gripper(settings)
            self._stalled_s = settings.number("stalled_time", 0.2)
        except ParamError as error:
            node.log.error(str(error))
            return 1
        self._commands = {
            jaw.joint: node.advertise(f"{jaw.joint}/command", "std_msgs/Float64", queue_size=5)
            for jaw in self._gripper.jaws
        }
        node.subscribe("joint_states", "sensor_msgs/JointState", self._on_joint_states, queue_size=10)
        ActionServer(node, f"{node.name}/gripper_action", "control_msgs/GripperCommand", self._move)
        await node.closed.wait()
        return 0

    def _on_joint_states(self, message: "sensor_msgs.JointState") -> None:
        self._positions.update(zip(message.name, map(float, message.position), strict=False))

    async def _move(self, goal: "control_msgs.GripperCommandGoal", accept: Callable[[], None]) -> ActionResult:
        accept()
        opening_m = float(goal.command.position)
        try:
            commands = self._gripper.commands(opening_m)
        except ValueError as error:
            self._node.log.error(str(error))
            return ActionResult(status="aborted", text=str(error))
        for joint, command in commands.items():
            self._commands[joint].publish({"data": command})
        clock = self._node.clock
        last, moved_ns = dict(self._positions), clock.now_ns()
        while True:
            await asyncio.sleep(_POLL_S)
            positions = {joint: self._positions.get(joint, math.inf) for joint in commands}
            if all(abs(positions[joint] - command) < _TOLERANCE_RAD for joint, command in commands.items()):
                return ActionResult(result={"position": opening_m, "reached_goal": True})
            if any(self._positions.get(joint) != last.get(joint) for joint in commands):
                last, moved_ns = dict(self._positions), clock.now_ns()
            elif clock.now_ns() - moved_ns > max(self._stalled_s, 1.0) * 1e9:
                if math.inf in positions.values():
                    return ActionResult(status="aborted", text="joint_states lacks the gripper's position")
                return ActionResult(result={"position": opening_m, "stalled": True})
