"""Controllers that hand commands on as they come: one joint's, or a group's in one array."""

import math
from typing import ClassVar, Self

from trundle.ros import Message

from .controller import ControllerContext, Endpoints, group_command
from .transmissions import Interface


class ForwardController:
    """`~command` std_msgs/Float64 for `joint`."""

    interface: ClassVar[Interface]

    def __init__(self, site: ControllerContext) -> None:
        self._joint = site.joint(site.settings.text("joint"), self.interface)
        self.claims: dict[Interface | str, list[str]] = {self.interface: [self._joint.name]}
        self._wanted: float | None = None
        self._ends = Endpoints()
        self._ends.add(site.node.subscribe(f"{site.name}/command", "std_msgs/Float64", self._take, queue_size=1))

    @classmethod
    def make(cls, site: ControllerContext) -> Self:
        """See `Controller.make`."""
        return cls(site)

    def start(self, time_ns: int) -> None:
        """Stay, until a command comes."""
        del time_ns
        self._wanted = None
        self._joint.engage()

    def update(self, time_ns: int, dt: float) -> None:
        """Hand the last command on."""
        del time_ns, dt
        if self._wanted is not None:
            self._joint.command = self._wanted

    def stop(self) -> None:
        """Let go."""
        self._joint.rest()

    def close(self) -> None:
        """Leave the graph."""
        self._ends.close()

    def _take(self, message: Message) -> None:
        if math.isfinite(message.data):
            self._wanted = float(message.data)


class ForwardGroup:
    """`~command` std_msgs/Float64MultiArray for `joints`, in their order."""

    interface: ClassVar[Interface]

    def __init__(self, site: ControllerContext) -> None:
        self._joints = [site.joint(name, self.interface) for name in site.joint_setting()]
        self.claims: dict[Interface | str, list[str]] = {self.interface: [joint.name for joint in self._joints]}
        self._wanted: list[float] = []
        self._node = site.node
        self._ends = Endpoints()
        kind = "std_msgs/Float64MultiArray"
        self._ends.add(site.node.subscribe(f"{site.name}/command", kind, self._take, queue_size=1))

    @classmethod
    def make(cls, site: ControllerContext) -> Self:
        """See `Controller.make`."""
        return cls(site)

    def start(self, time_ns: int) -> None:
        """Stay, until a command comes."""
        del time_ns
        self._wanted = []
        for joint in self._joints:
            joint.engage()

    def update(self, time_ns: int, dt: float) -> None:
        """Hand the last command on."""
        del time_ns, dt
        for joint, wanted in zip(self._joints, self._wanted, strict=False):
            joint.command = wanted

    def stop(self) -> None:
        """Let go."""
        for joint in self._joints:
            joint.rest()

    def close(self) -> None:
        """Leave the graph."""
        self._ends.close()

    def _take(self, message: Message) -> None:
        self._wanted = group_command(message, len(self._joints), self._node) or self._wanted


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
