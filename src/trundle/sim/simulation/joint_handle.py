"""Joint handle: state, reaction and commands."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeAlias

from trundle.base.arguments import count_of, number_of
from trundle.base.diagnostics import UsageError
from trundle.base.documented import documented
from trundle.robots.model import Joint
from trundle.spatial import Pose, Wrench, cross

from .handle import Handle

if TYPE_CHECKING:
    from trundle.sim.physics import MotorAxis, MotorCommand

    from .runtime import Runtime

TimedCommand: TypeAlias = "tuple[MotorCommand, float | None]"
"""Command of an axis, and its remaining duration [s]; None: until the next one."""


@documented(
    "name index is_valid position velocity effort positions velocities efforts reaction is_driven set_position "
    "set_velocity command_position command_velocity command_effort"
)
class JointHandle(Handle):
    """Handle of a joint; axes are counted from 0 in file order. A ball joint has three: their positions are a rotation
    vector, and their only commands are efforts.
    """

    __module__ = "trundle"

    KIND = "joint"

    def __init__(self, simulation: "Runtime", joint: Joint, index: int) -> None:
        super().__init__(simulation, index)
        self.joint = joint

    @property
    def name(self) -> str:
        """Name as in the file."""
        return self.joint.name

    def __repr__(self) -> str:
        if not self.is_valid:
            return f"<JointHandle {self.name!r} of a deleted model>"
        state = f"positions {_rounded(self.positions)}, velocities {_rounded(self.velocities)}"
        return f"<JointHandle {self.name!r}: {self.joint.type.value}, {state if self.axes else 'rigid'}>"

    @property
    def axes(self) -> range:
        """Axes as indices into the engine's arrays; empty for a rigid joint."""
        return self._simulation.engine.compiled.joint_axes[self.index]

    @property
    def position(self) -> float:
        """Position of the first axis [rad or m]; 0 for a rigid joint."""
        axes = self.axes
        return self._simulation.engine.reader.positions_of(axes)[0] if axes else 0.0

    @property
    def velocity(self) -> float:
        """Velocity of the first axis [rad/s or m/s]."""
        axes = self.axes
        return self._simulation.engine.reader.velocities_of(axes)[0] if axes else 0.0

    @property
    def effort(self) -> float:
        """Effort on the first axis [N·m or N]."""
        axes = self.axes
        return self._simulation.engine.reader.efforts_of(axes)[0] if axes else 0.0

    @property
    def is_driven(self) -> bool:
        """True if the joint has an axis that can be driven or positioned."""
        return bool(self.axes) and bool(self._simulation.engine.compiled.axis_actuator[self.axes[0]] >= 0)

    @property
    def motor(self) -> "MotorAxis":
        """First axis, for laws in C++; another one after models were spawned, deleted or edited.

        Raises:
            UsageError: there is no axis that can be driven.
        """
        return self._simulation.engine.motors.axis(self._driven(0))

    @property
    def positions(self) -> tuple[float, ...]:
        """Position of each axis [rad or m]."""
        return tuple(self._simulation.engine.reader.positions_of(self.axes))

    @property
    def velocities(self) -> tuple[float, ...]:
        """Velocity of each axis [rad/s or m/s]."""
        return tuple(self._simulation.engine.reader.velocities_of(self.axes))

    @property
    def efforts(self) -> tuple[float, ...]:
        """Effort on each axis [N·m or N]."""
        return tuple(self._simulation.engine.reader.efforts_of(self.axes))

    @property
    def reaction(self) -> Wrench:
        """Wrench of the parent on the child through this joint, at the joint, world axes: motors, limits and weight.

        Raises:
            UsageError: the joint closes a loop of links.
        """
        engine = self._simulation.engine
        link, anchor, sign = engine.compiled.joint_anchors[self.index]
        if link < 0:
            name = engine.compiled.joint_names[self.index]
            raise UsageError(f"joint {name!r} closes a loop of links or carries no link; its reaction is not available")
        _, _, _, qw, qx, qy, qz = engine.reader.link_poses()[link].tolist()
        arm = Pose(quaternion=(qw, qx, qy, qz)).transform_vector(anchor)
        fx, fy, fz, tx, ty, tz = (sign * component for component in engine.reactions()[link].tolist())
        mx, my, mz = cross(arm, (fx, fy, fz))
        return Wrench((fx, fy, fz), (tx - mx, ty - my, tz - mz))

    # -- state

    def set_position(self, position: float, *, axis: int = 0) -> None:
        """Set the position of an axis [rad or m] at once; its velocity stays, and no motor is switched.

        Raises:
            UsageError: there is no such axis, or the joint is a ball, set by `ModelHandle.joint_positions`.
        """
        position = number_of(position, "position [rad or m]")
        driven = self._driven(axis)
        self._simulation.engine.writer.set_axis_positions(range(driven, driven + 1), (position,))

    def set_velocity(self, velocity: float, *, axis: int = 0) -> None:
        """Set the velocity of an axis [rad/s or m/s] once; no motor is switched.

        Raises:
            UsageError: there is no such axis.
        """
        velocity = number_of(velocity, "velocity [rad/s or m/s]")
        index = self._axis(axis)
        self._simulation.engine.writer.set_axis_velocities(range(index, index + 1), (velocity,))

    # -- motors: the last command holds until the next one; a command of a hardware interface (ros_control) is combined
    # with direct ones, as in Gazebo: efforts add up, the later speed counts, a kinematic drive overrides all

    def command_position(self, position: float, *, max_effort: float = math.inf, axis: int = 0) -> None:
        """Drive an axis to a position [rad or m] within the joint's limits, and hold it.

        The approach is exponential with a time constant of a third of a second, as far as the effort allows.

        Args:
            position: target.
            max_effort: motor's effort limit [N·m or N]; the joint's effort limit applies, too.
            axis: axis index.

        Raises:
            UsageError: there is no such axis, or the joint is a ball.
        """
        position, max_effort = number_of(position, "position [rad or m]"), _limit_of(max_effort)
        driven = self._driven(axis)
        self._simulation.loads.limit_effort(self, axis, None)
        self._simulation.engine.motors.command_position(driven, self._within_limits(position, driven), max_effort)

    def command_velocity(
        self, velocity: float, *, max_effort: float = math.inf, axis: int = 0, hardware: bool = False
    ) -> None:
        """Drive an axis at a velocity, as Gazebo's SetVelocity with fmax.

        Args:
            velocity: target [rad/s or m/s].
            max_effort: motor's effort limit [N·m or N]; the joint's effort limit applies, too.
            axis: axis index.
            hardware: True: command of a hardware interface, which lasts until its next one.

        Raises:
            UsageError: there is no such axis, or the joint is a ball.
        """
        velocity, max_effort = number_of(velocity, "velocity [rad/s or m/s]"), _limit_of(max_effort)
        if not hardware:
            self._simulation.loads.limit_effort(self, axis, None)
        self._simulation.engine.motors.command_velocity(self._driven(axis), velocity, max_effort, hardware=hardware)

    def command_effort(
        self, effort: float, *, axis: int = 0, duration_s: float | None = None, hardware: bool = False
    ) -> None:
        """Drive an axis with an effort [N·m or N], within the joint's effort and velocity limits.

        Args:
            effort: effort in place of the previous command.
            axis: axis index.
            duration_s: simulation time [s], at least one step; None: until the next command.
            hardware: True: command of a hardware interface, which lasts until its next one.

        Raises:
            UsageError: there is no such axis.
        """
        effort = number_of(effort, "effort [N·m or N]")
        if duration_s is not None:
            duration_s = number_of(duration_s, "duration_s [s]", minimum=0.0)
        self._simulation.engine.motors.command_effort(self._axis(axis), effort, hardware=hardware)
        if not hardware:
            self._simulation.loads.limit_effort(self, axis, duration_s)

    @property
    def commands(self) -> "tuple[TimedCommand, ...]":
        """Last direct command of each axis, and its remaining duration [s]; None: until the next one."""
        simulation = self._simulation
        remaining_s = [simulation.loads.effort_left_s(self, axis) for axis in range(len(self.axes))]
        commands = map(simulation.engine.motors.command_of, self.axes)
        return tuple(zip(commands, remaining_s, strict=True))

    def repeat(self, commands: "Iterable[TimedCommand]") -> None:
        """Repeat an earlier command of every axis."""
        for axis, (command, remaining_s) in enumerate(commands):
            self._simulation.engine.motors.repeat(self._axis(axis), command)
            self._simulation.loads.limit_effort(self, axis, remaining_s)

    def drive_kinematically(self, velocity: float, *, axis: int = 0, hardware: bool = False) -> None:
        """Drive an axis at a velocity [rad/s or m/s] at once; the reaction on the parent is the weight only."""
        velocity = number_of(velocity, "velocity [rad/s or m/s]")
        if not hardware:
            self._simulation.loads.limit_effort(self, axis, None)
        engine = self._simulation.engine
        engine.motors.drive_kinematically(self._driven(axis), velocity, hardware=hardware)
        engine.reader.invalidate()

    def _axis(self, axis: int) -> int:
        axes = self.axes
        if not count_of(axis, "axis") < len(axes):
            axes_text = f"it has {len(axes)}" if axes else "it cannot move"
            raise UsageError(f"joint {self.name!r} has no axis {axis}: {axes_text}")
        return axes[axis]

    def _driven(self, axis: int) -> int:
        index = self._axis(axis)
        if self._simulation.engine.compiled.axis_actuator[index] < 0:
            raise UsageError(f"joint {self.name!r} is a ball joint without a single axis; use an effort command")
        return index

    def _within_limits(self, position: float, axis: int) -> float:
        low, high = self._simulation.engine.compiled.axis_range[axis].tolist()
        return min(max(position, low), high)


def _limit_of(max_effort: float) -> float:
    return max_effort if max_effort == math.inf else number_of(max_effort, "max_effort [N·m or N]", minimum=0.0)


def _rounded(values: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(round(value, 4) + 0.0 for value in values)
