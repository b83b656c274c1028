"""Controllers that forward commands: of one joint, or of a group in one array."""

import math
from typing import ClassVar, Self

from trundle.ros import Message

from .controller import ControllerContext, Endpoints, InStepController, group_command
from .transmissions import Interface


class ForwardController(InStepController):
    """Forwards `~command` (std_msgs/Float64) to `joint`, which keeps it."""

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        self._joint = context.joint(context.settings.text("joint"), self.interface)
        self.claims: dict[Interface | str, list[str]] = {self.interface: [self._joint.name]}
        self._is_running = False
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
        self._is_running = True
        self._joint.start()

    def stop(self) -> None:
        """Stop commanding."""
        self._is_running = False
        self._joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        if self._is_running and math.isfinite(message.data):
            self._joint.command = float(message.data)


class ForwardGroup(InStepController):
    """Forwards `~command` (std_msgs/Float64MultiArray) to `joints`, in their order, which keep it."""

    interface: ClassVar[Interface]

    def __init__(self, context: ControllerContext) -> None:
        self._joints = [context.joint(name, self.interface) for name in context.joint_setting()]
        self.claims: dict[Interface | str, list[str]] = {self.interface: [joint.name for joint in self._joints]}
        self._is_running = False
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
        self._is_running = True
        for joint in self._joints:
            joint.start()

    def stop(self) -> None:
        """Stop commanding."""
        self._is_running = False
        for joint in self._joints:
            joint.stop()

    def close(self) -> None:
        """Unregister its topics."""
        self._endpoints.close()

    def _on_command(self, message: Message) -> None:
        values = group_command(message, len(self._joints), self._node)
        if self._is_running:
            for joint, value in zip(self._joints, values, strict=False):
                joint.command = value


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
