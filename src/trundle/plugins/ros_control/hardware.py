"""Joints as controllers see them: a state to read, and a command to write."""

import math
from collections.abc import Mapping

from trundle.control import ToolboxPid
from trundle.model import JointType
from trundle.simulation import JointHandle

from .transmissions import Interface

_SETTLING_NS = 200_000_000


class JointHardware:
    """One joint behind its transmission."""

    def __init__(self, handle: JointHandle, interface: Interface, pid: ToolboxPid | None, *, lag_s: float) -> None:
        """Wrap a joint.

        Args:
            handle: the simulation's joint; it has an axis.
            interface: meaning of commands.
            pid: efforts from position or velocity errors; None: position or velocity is driven directly.
            lag_s: time constant of driven positions [s]; gazebo_ros_control sets them at once, through obstacles.
        """
        self.handle = handle
        self.name = handle.name
        self.interface = interface
        self.command = 0.0
        """Command [N·m or N], [rad or m] or [rad/s or m/s], by the interface."""
        self.position = self.velocity = self.effort = 0.0
        """State at the last `read`."""
        self._pid = pid
        self.lag_s = lag_s
        self._is_at_rest = True
        axis = handle.joint.axis
        assert axis is not None, f"{self.name} has no axis"
        self.lower, self.upper = axis.lower, axis.upper
        self._most_effort, self._most_speed = axis.effort, axis.velocity

    @property
    def is_continuous(self) -> bool:
        """True if it is a revolute joint without limits."""
        return self.handle.joint.type is JointType.REVOLUTE and math.isinf(self.upper) and math.isinf(self.lower)

    def read(self) -> None:
        """Read position, velocity and effort."""
        handle = self.handle
        self.position, self.velocity, self.effort = handle.position, handle.velocity, handle.effort

    def error(self, wanted: float) -> float:
        """Difference of a position to the joint's [rad or m]; the shorter way round if continuous."""
        way = wanted - self.position
        return math.remainder(way, math.tau) if self.is_continuous else way

    def shortest_error(self, wanted: float) -> float:
        """Difference of a position to the joint's [rad or m]; the shorter way round unless prismatic, as of
        joint_trajectory_controller.
        """
        way = wanted - self.position
        return way if self.handle.joint.type is JointType.PRISMATIC else math.remainder(way, math.tau)

    @property
    def settling_ns(self) -> int:
        """Time that a driven position has to settle [ns]: gazebo_ros_control sets it at once."""
        return _SETTLING_NS if self.interface == "PositionJointInterface" and self._pid is None else 0

    @property
    def resting_command(self) -> float:
        """Command that holds the position read last, or zero effort or velocity."""
        return self.position if self.interface == "PositionJointInterface" else 0.0

    def stop(self) -> None:
        """Command zero effort, zero velocity, or the last position."""
        self._is_at_rest = True
        if self.interface != "PositionJointInterface":
            self.command = 0.0
        if self._pid is not None:
            self._pid.reset()

    def start(self) -> None:
        """Command the current position, or zero, until the controller writes."""
        self._is_at_rest = False
        self.command = self.resting_command

    def write(self, dt: float) -> None:
        """Apply the command for a control period [s]."""
        match self.interface:
            case "EffortJointInterface":
                self.handle.command_effort(self.command, hardware=True)
            case "VelocityJointInterface":
                self._write_velocity(dt)
            case _:
                self._write_position(dt)

    def _write_velocity(self, dt: float) -> None:
        wanted = min(max(self.command, -self._most_speed), self._most_speed)
        if self._pid is not None:
            self.handle.command_effort(self._pid.command(wanted - self.velocity, dt), hardware=True)
        else:
            self.handle.command_velocity(wanted, max_effort=self._most_effort, hardware=True)

    def _write_position(self, dt: float) -> None:
        if self._is_at_rest and self.velocity == 0.0 and self.error(self.command) != 0.0:
            self.command = self.position  # its position was set while no controller ran
        wanted = min(max(self.command, self.lower), self.upper)
        error = self.error(wanted)
        if self._pid is not None:
            self.handle.command_effort(self._pid.command(error, dt), hardware=True)
            return
        speed = error / self.lag_s
        self.handle.drive_kinematically(min(max(speed, -self._most_speed), self._most_speed), hardware=True)


Hardware = Mapping[str, JointHardware]
"""Joint name → joint."""
