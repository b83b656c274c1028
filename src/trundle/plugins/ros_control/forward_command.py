"""Controllers that forward commands: of one joint, or of a group in one array."""

import math
from typing import ClassVar, Self

from trundle.ros import Message

from .controller import ControllerContext, Endpoints, group_command
from .transmissions import Interface


class ForwardController:
    """Forwards `~command` (std_msgs/Float64) to `joint`."""

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        self._joint = context.joint(context.settings.text("joint"), self.interface)
        self.claims: dict[Interface | str, list[str]] = {self.interface: [self._joint.name]}
        self._command: float | None = None
        self._endpoints = Endpoints()
        self._endpoints.add(
            context.node.subscribe(f"{context.name}/command", "std_msgs/Float64", self._on_command, queue_size=1)
        )

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold until the first command."""
        del time_ns
        self._command = None
        self._joint.start()

    def update(self, time_ns: int, dt: float) -> None:
        """Write the last command."""
        del time_ns, dt
        if self._command is not None:
            self._joint.command = self._command

    def stop(self) -> None:
        """Stop commanding."""
        self._joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        if math.isfinite(message.data):
            self._command = float(message.data)


class ForwardGroup:
    """Forwards `~command` (std_msgs/Float64MultiArray) to `joints`, in their order."""

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        self._joints = [context.joint(name, self.interface) for name in context.joint_setting()]
        self.claims: dict[Interface | str, list[str]] = {self.interface: [joint.name for joint in self._joints]}
        self._command: list[float] = []
        self._node = context.node
        self._endpoints = Endpoints()
        kind = "std_msgs/Float64MultiArray"
        self._endpoints.add(context.node.subscribe(f"{context.name}/command", kind, self._on_command, queue_size=1))

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """See `Controller.create`."""
        return cls(context)

    def start(self, time_ns: int) -> None:
        """Hold until the first command."""
        del time_ns
        self._command = []
        for joint in self._joints:
            joint.start()

    def update(self, time_ns: int, dt: float) -> None:
        """Write the last command."""
        del time_ns, dt
        for joint, wanted in zip(self._joints, self._command, strict=False):
            joint.command = wanted

    def stop(self) -> None:
        """Stop commanding."""
        for joint in self._joints:
            joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        self._command = group_command(message, len(self._joints), self._node) or self._command


class EffortForward(ForwardController):
    """effort_controllers/JointEffortController."""

    interface = "EffortJointInterface"


class PositionForward(ForwardController):
    """position_controllers/JointPositionController."""

    interface = "PositionJointInterface"


class VelocityForward(ForwardController):
    """velocity_controllers/JointVelocityController."""

    interface = "VelocityJointInterface"


class EffortGroup(ForwardGroup):
    """effort_controllers/JointGroupEffortController."""

    interface = "EffortJointInterface"


class PositionGroup(ForwardGroup):
    """position_controllers/JointGroupPositionController."""

    interface = "PositionJointInterface"


class VelocityGroup(ForwardGroup):
    """velocity_controllers/JointGroupVelocityController."""

    interface = "VelocityJointInterface"
