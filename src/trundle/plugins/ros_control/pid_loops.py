"""Controllers with a PID loop around one joint, or around each of a group."""

import math
from dataclasses import dataclass
from typing import ClassVar, Self

from trundle.control import ToolboxPid
from trundle.parameters import RosParameters
from trundle.ros import Message

from .controller import ControllerContext, Endpoints, group_command
from .gains import reconfigurable_pid
from .hardware import JointHardware
from .transmissions import Interface

_STATE_EVERY = 10
"""Updates per message on `~state`, as in the original."""


@dataclass(slots=True)
class _PidLoop:
    joint: JointHardware
    pid: ToolboxPid
    of_speed: bool
    """True: velocity loop; False: position loop."""
    wanted: float = 0.0

    def start(self) -> None:
        """Hold the current position, or zero velocity."""
        self.joint.start()
        self.pid.reset()
        self.wanted = 0.0 if self.of_speed else self.joint.position

    @property
    def value(self) -> float:
        return self.joint.velocity if self.of_speed else self.joint.position

    def error(self) -> float:
        if self.of_speed:
            return self.wanted - self.joint.velocity
        self.wanted = min(max(self.wanted, self.joint.lower), self.joint.upper)
        return self.joint.error(self.wanted)

    def update(self, dt: float) -> None:
        self.joint.command = self.pid.command(self.error(), dt)


class PidController:
    """Loop of `joint` with gains `pid`, by `~command` (std_msgs/Float64); publishes `~state`
    (control_msgs/JointControllerState)."""

    interface: ClassVar[Interface]
    of_speed: ClassVar[bool] = False

    def __init__(self, context: ControllerContext) -> None:
        joint = context.joint(context.settings.text("joint"), self.interface)
        self.claims: dict[Interface | str, list[str]] = {self.interface: [joint.name]}
        self._endpoints = Endpoints()
        self._loop = _PidLoop(
            joint, reconfigurable_pid(context.node, context.settings.section("pid"), self._endpoints), self.of_speed
        )
        self._updates = 0
        self._state = context.node.advertise(f"{context.name}/state", "control_msgs/JointControllerState", queue_size=1)
        commands = context.node.subscribe(f"{context.name}/command", "std_msgs/Float64", self._on_command, queue_size=1)
        self._endpoints.add(self._state, commands)

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold until the first command."""
        del time_ns
        self._loop.start()

    def update(self, time_ns: int, dt: float) -> None:
        """Command the loop's effort or velocity."""
        self._loop.update(dt)
        self._updates += 1
        if self._updates % _STATE_EVERY == 0 and self._state.has_subscribers:
            self._publish_state(time_ns, dt)

    def stop(self) -> None:
        """Stop commanding."""
        self._loop.joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        if math.isfinite(message.data):
            self._loop.wanted = float(message.data)

    def _publish_state(self, time_ns: int, dt: float) -> None:
        loop, pid = self._loop, self._loop.pid
        self._state.publish(
            {
                "header": {"stamp": time_ns},
                "set_point": loop.wanted,
                "process_value": loop.value,
                "process_value_dot": 0.0 if loop.of_speed else loop.joint.velocity,
                "error": loop.error(),
                "time_step": dt,
                "command": loop.joint.command,
                "p": pid.p,
                "i": pid.i,
                "d": pid.d,
                "i_clamp": pid.i_clamp,
                "antiwindup": pid.antiwindup,
            }
        )


class EffortGroupPosition:
    """effort_controllers/JointGroupPositionController: loops of `joints`, each with gains `<joint>/pid`."""

    def __init__(self, context: ControllerContext) -> None:
        self._node, self._endpoints = context.node, Endpoints()
        self._loops = [
            _PidLoop(context.joint(name, "EffortJointInterface"), self._pid(context.settings, name), of_speed=False)
            for name in context.joint_setting()
        ]
        self.claims: dict[Interface | str, list[str]] = {
            "EffortJointInterface": [loop.joint.name for loop in self._loops]
        }
        kind = "std_msgs/Float64MultiArray"
        self._endpoints.add(context.node.subscribe(f"{context.name}/command", kind, self._on_command, queue_size=1))

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold until the first command."""
        del time_ns
        for loop in self._loops:
            loop.start()

    def update(self, time_ns: int, dt: float) -> None:
        """Command the loop's effort or velocity."""
        del time_ns
        for loop in self._loops:
            loop.update(dt)

    def stop(self) -> None:
        """Stop commanding."""
        for loop in self._loops:
            loop.joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        values = group_command(message, len(self._loops), self._node)
        for loop, value in zip(self._loops, values, strict=False):
            loop.wanted = value

    def _pid(self, settings: RosParameters, joint: str) -> ToolboxPid:
        return reconfigurable_pid(self._node, settings.section(joint).section("pid"), self._endpoints)


class EffortPosition(PidController):
    """effort_controllers/JointPositionController."""

    interface = "EffortJointInterface"


class EffortVelocity(PidController):
    """effort_controllers/JointVelocityController."""

    interface = "EffortJointInterface"
    of_speed = True


class VelocityPosition(PidController):
    """velocity_controllers/JointPositionController."""

    interface = "VelocityJointInterface"
