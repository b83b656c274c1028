"""Controllers with a PID loop for one joint, or for each joint of a group."""

import math
from typing import ClassVar, Self

from trundle.robots.parameters import RosParameters
from trundle.ros import Message
from trundle.sim.control import PidLoop, ToolboxPid

from .controller import ControllerContext, Endpoints, InStepController, group_command
from .gains import reconfigurable_pid
from .transmissions import Interface

_UPDATES_PER_STATE = 10
"""Updates per message on `~state`, as in the original."""


class PidController(InStepController):
    """Loop of `joint` with gains `pid`, by `~command` (std_msgs/Float64); publishes `~state`
    (control_msgs/JointControllerState)."""

    interface: ClassVar[Interface]
    is_velocity: ClassVar[bool] = False

    def __init__(self, context: ControllerContext) -> None:
        joint = context.joint(context.settings.text("joint"), self.interface)
        self.claims: dict[Interface | str, list[str]] = {self.interface: [joint.name]}
        self._endpoints = Endpoints()
        self._joint = joint
        self._pid = reconfigurable_pid(context.node, context.settings.section("pid"), self._endpoints)
        self._loop = PidLoop(joint, self._pid, self.is_velocity)
        self.laws = (self._loop,)
        self._state = context.node.advertise(f"{context.name}/state", "control_msgs/JointControllerState", queue_size=1)
        commands = context.node.subscribe(f"{context.name}/command", "std_msgs/Float64", self._on_command, queue_size=1)
        self._endpoints.add(self._state, commands)

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold until the first command."""
        self._loop.start(time_ns)

    def due_ns(self, time_ns: int) -> float:
        """Return the time of the next message [ns]."""
        if not self._state.has_subscribers:
            return math.inf
        return time_ns + (_UPDATES_PER_STATE - self._loop.updates % _UPDATES_PER_STATE) * self._loop.period_ns

    def update(self, time_ns: int, dt: float) -> None:
        """Publish when due."""
        if self._loop.updates % _UPDATES_PER_STATE == 0 and self._state.has_subscribers:
            self._publish_state(time_ns, dt)

    def stop(self) -> None:
        """Stop commanding."""
        self._joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        if math.isfinite(message.data):
            self._loop.target = float(message.data)

    def _publish_state(self, time_ns: int, dt: float) -> None:
        loop, joint, pid = self._loop, self._joint, self._pid
        self._state.publish(
            {
                "header": {"stamp": time_ns},
                "set_point": loop.target,
                "process_value": joint.velocity if self.is_velocity else joint.position,
                "process_value_dot": 0.0 if self.is_velocity else joint.velocity,
                "error": loop.error(),
                "time_step": dt,
                "command": joint.command,
                "p": pid.p,
                "i": pid.i,
                "d": pid.d,
                "i_clamp": pid.i_clamp,
                "antiwindup": pid.antiwindup,
            }
        )


class EffortGroupPosition(InStepController):
    """effort_controllers/JointGroupPositionController: loops of `joints`, each with gains `<joint>/pid`."""

    def __init__(self, context: ControllerContext) -> None:
        self._node, self._endpoints = context.node, Endpoints()
        self._joints = [context.joint(name, "EffortJointInterface") for name in context.joint_setting()]
        self._loops = [
            PidLoop(joint, self._gains(context.settings, joint.name), of_speed=False) for joint in self._joints
        ]
        self.laws = self._loops
        self.claims: dict[Interface | str, list[str]] = {"EffortJointInterface": [joint.name for joint in self._joints]}
        kind = "std_msgs/Float64MultiArray"
        self._endpoints.add(context.node.subscribe(f"{context.name}/command", kind, self._on_command, queue_size=1))

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold until the first command."""
        for loop in self._loops:
            loop.start(time_ns)

    def stop(self) -> None:
        """Stop commanding."""
        for joint in self._joints:
            joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        values = group_command(message, len(self._loops), self._node)
        for loop, value in zip(self._loops, values, strict=False):
            loop.target = value

    def _gains(self, settings: RosParameters, joint: str) -> ToolboxPid:
        return reconfigurable_pid(self._node, settings.section(joint).section("pid"), self._endpoints)


class EffortPosition(PidController):
    """effort_controllers/JointPositionController."""

    interface = "EffortJointInterface"


class EffortVelocity(PidController):
    """effort_controllers/JointVelocityController."""

    interface = "EffortJointInterface"
    is_velocity = True


class VelocityPosition(PidController):
    """velocity_controllers/JointPositionController."""

    interface = "VelocityJointInterface"
