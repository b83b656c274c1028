"""Gazebo's joint controller: lasting efforts and PID loops of one joint."""

from dataclasses import dataclass, field

from trundle.sim.control import Pid
from trundle.sim.simulation import JointHandle, Simulation


def gazebo_pid() -> Pid:
    """Default gains of a joint in Gazebo."""
    return Pid(p=1.0, i=0.1, d=0.01, i_min=-1.0, i_max=1.0)


@dataclass(slots=True)
class _Loop:
    pid: Pid = field(default_factory=gazebo_pid)
    target: float | None = None


class ControlledJoint:
    """First axis of one joint; commanded effort, position and velocity loops add up."""

    def __init__(self, joint: JointHandle) -> None:
        self.joint = joint
        self._effort: float | None = None
        self._step_effort = 0.0
        self._position, self._velocity = _Loop(), _Loop()
        self._is_idle = True

    def command_effort(self, effort: float) -> None:
        """Set the lasting effort [N·m or N]."""
        self._effort = effort

    def apply_effort(self, effort: float) -> None:
        """Add an effort [N·m or N] for one step."""
        self._step_effort += effort

    def command_position(self, target: float | None, pid: Pid | None = None) -> None:
        """Set target position [rad or m] and gains; None keeps the present value."""
        self._position = _Loop(pid or self._position.pid, self._position.target if target is None else target)

    def command_velocity(self, target: float | None, pid: Pid | None = None) -> None:
        """Set target velocity [rad/s or m/s] and gains; None keeps the present value."""
        self._velocity = _Loop(pid or self._velocity.pid, self._velocity.target if target is None else target)

    def update(self, sim: Simulation) -> None:
        """Apply the effort of the coming step."""
        dt = sim.step_ns / 1e9
        effort, self._step_effort = self._step_effort, 0.0
        is_commanded = effort != 0.0
        if self._effort is not None:
            effort, is_commanded = effort + self._effort, True
        for loop, value in ((self._position, self.joint.position), (self._velocity, self.joint.velocity)):
            if loop.target is not None:
                effort, is_commanded = effort + loop.pid.command(value - loop.target, dt), True
        if is_commanded or not self._is_idle:
            self.joint.command_effort(effort)
        self._is_idle = not is_commanded

    def clear(self) -> None:
        """Clear all commands."""
        self._effort = self._position.target = self._velocity.target = None
        self.reset()

    def reset(self) -> None:
        """Reset the PID loops; commands stay."""
        self._step_effort = 0.0
        self._position.pid.reset()
        self._velocity.pid.reset()
