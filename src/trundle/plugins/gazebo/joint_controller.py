"""What stands between commands for joints and the joints in Gazebo: efforts that last, and PID loops."""

from dataclasses import dataclass, field

from trundle.control import Pid
from trundle.simulation import JointHandle, Simulation


def gazebo_pid() -> Pid:
    """The gains that every joint has in Gazebo until somebody sets others."""
    return Pid(p=1.0, i=0.1, d=0.01, i_min=-1.0, i_max=1.0)


@dataclass(slots=True)
class _Loop:
    pid: Pid = field(default_factory=gazebo_pid)
    target: float | None = None


class ControlledJoint:
    """The first axis of one joint; effort, position and velocity may be commanded together, and add up."""

    def __init__(self, joint: JointHandle) -> None:
        self.joint = joint
        self._effort: float | None = None
        self._once = 0.0
        self._position, self._velocity = _Loop(), _Loop()
        self._is_idle = True

    def command_effort(self, effort: float) -> None:
        """Push with it [N·m or N] from now on."""
        self._effort = effort

    def apply_effort(self, effort: float) -> None:
        """Push with it [N·m or N] for one step."""
        self._once += effort

    def command_position(self, target: float | None, pid: Pid | None = None) -> None:
        """Go to a position [rad or m], by other gains where they are given."""
        self._position = _Loop(pid or self._position.pid, self._position.target if target is None else target)

    def command_velocity(self, target: float | None, pid: Pid | None = None) -> None:
        """Keep a speed [rad/s or m/s], by other gains where they are given."""
        self._velocity = _Loop(pid or self._velocity.pid, self._velocity.target if target is None else target)

    def update(self, sim: Simulation) -> None:
        """Push for the coming step."""
        dt = sim.step_ns / 1e9
        effort, self._once = self._once, 0.0
        wanted = effort != 0.0
        if self._effort is not None:
            effort, wanted = effort + self._effort, True
        for loop, now in ((self._position, self.joint.position), (self._velocity, self.joint.velocity)):
            if loop.target is not None:
                effort, wanted = effort + loop.pid.command(now - loop.target, dt), True
        if wanted or not self._is_idle:
            self.joint.command_effort(effort)
        self._is_idle = not wanted

    def clear(self) -> None:
        """Forget every command."""
        self._effort = self._position.target = self._velocity.target = None
        self.reset()

    def reset(self) -> None:
        """Forget every error; commands stay."""
        self._once = 0.0
        self._position.pid.reset()
        self._velocity.pid.reset()
