"""Joints as ros_control's hardware: a state to read, and a command to write."""

import math
from collections.abc import Mapping

from trundle.robots.model import JointType
from trundle.sim.control import ServoJoint, ToolboxPid
from trundle.sim.simulation import JointHandle

from .transmissions import Interface

INTERFACE_NUMBERS: dict[Interface, int] = {
    "EffortJointInterface": 0,
    "VelocityJointInterface": 1,
    "PositionJointInterface": 2,
}


class JointHardware(ServoJoint):
    """One joint behind its transmission."""

    def __init__(self, handle: JointHandle, interface: Interface, pid: ToolboxPid | None, *, lag_s: float) -> None:
        """Wrap a joint.

        Args:
            handle: simulation's joint; it has an axis.
            interface: meaning of commands.
            pid: efforts from position or velocity errors; None: position or velocity is driven directly.
            lag_s: time constant with which a directly driven position follows its command [s]. The original sets the
                position in one step, through obstacles.
        """
        axis, kind = handle.joint.axis, handle.joint.type
        assert axis is not None, f"{handle.name} has no axis"
        range_ = axis.lower, axis.upper
        super().__init__(
            handle.motor,
            INTERFACE_NUMBERS[interface],
            pid,
            lag_s=lag_s,
            range=range_,
            max_effort=axis.effort,
            max_speed=axis.velocity,
            is_continuous=kind is JointType.REVOLUTE and range_ == (-math.inf, math.inf),
            is_prismatic=kind is JointType.PRISMATIC,
        )
        self.handle = handle
        self.name = handle.name
        self.interface: Interface = interface

    def rebind(self) -> None:
        """Use the joint's new handle, after models were spawned, deleted or edited."""
        self.bind(self.handle.motor)


Hardware = Mapping[str, JointHardware]
"""Joint name → joint."""
