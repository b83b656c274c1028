"""Joint motors: effort, velocity and position commands within limits.

A motor is a velocity constraint with bounded force, as in ODE; see `cpp/velocity_motor.cc`.
"""

import math
from collections.abc import Callable, Iterable

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from ..compile.law_tables import find_table

HOLD_RATE = 3.0
"""Rate at which a held joint approaches its target [1/s]: a first-order lag of a third of a second, within the motor's
effort.
"""
_KINEMATIC = -1.0
"""Value of the rate that marks a kinematic drive."""
_KEEPS_UP = 0.05, 0.01
"""Relative and absolute [rad/s or m/s] speed error below which a kinematic axis takes a new speed at once."""
_HUGE = 1e10
_NO_MOTORS = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)


class MotorCommand(Struct, frozen=True):
    """Command of one axis."""

    target: float
    """Speed [rad/s or m/s], or position [rad or m] where there is a rate to approach it."""
    max_effort: float
    """Limit of the motor [N·m or N]; 0: it is off."""
    rate: float
    """Rate of the approach [1/s]; 0: the target is a speed."""
    effort: float
    """Constant effort beside the motor [N·m or N]."""

    @property
    def is_drive(self) -> bool:
        """True if the motor keeps a speed or position; else the command is an effort."""
        return self.max_effort > 0.0 and self.effort == 0.0

    @property
    def whole_effort(self) -> float:
        """Commanded effort [N·m or N], of which a motor may give half; 0 for a drive."""
        return self.effort + math.copysign(self.max_effort, self.effort) if self.effort else 0.0


class MotorCommands(Struct, frozen=True, eq=False):
    """Effort limits and rates of a model's motors, whose targets are in the data, and the commands."""

    max_efforts: NDArray[np.float64]
    rates: NDArray[np.float64]
    last: dict[int, tuple[float, ...]]
    direct: dict[int, MotorCommand]
    hardware: dict[int, MotorCommand]


def copy_commands(source: mujoco.MjModel, target: mujoco.MjModel) -> None:
    """Give the motors of a model the commands of another one of the same world, but for the targets."""
    target.tendon_frictionloss[:] = source.tendon_frictionloss
    find_table(target, "motors")[:, 1] = find_table(source, "motors")[:, 1]


class Motors:
    """One motor per hinge or slide axis, inactive until commanded."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData, wake: Callable[[int], None]) -> None:
        """Bind the engine's arrays.

        Args:
            compiled: the world.
            data: its state.
            wake: called with the degree of freedom of a new command.
        """
        self._model = compiled.model
        self._data = data
        self._wake = wake
        # Lists, because a single array element costs four times as much, and controllers write at every step.
        self._dofs: list[int] = compiled.axis_dof.tolist()
        self._actuators: list[int] = compiled.axis_actuator.tolist()
        self._max_efforts: list[float] = compiled.axis_effort.tolist()
        self._max_velocities: list[float] = compiled.axis_velocity.tolist()
        self._commands: dict[int, tuple[float, ...]] = {}
        self._hardware: dict[int, MotorCommand] = {}
        """Commands of hardware interfaces, by actuator."""
        self._direct: dict[int, MotorCommand] = {}
        """Direct commands of the axes with a hardware interface."""
        self._rates = find_table(compiled.model, "motors")[:, 1]
        self._motor_dofs = find_table(compiled.model, "motors")[:, 3].astype(np.intp)
        self._sleeping_efforts: tuple[bytes, NDArray[np.float64]] = (b"", np.empty(0))
        """Degrees of freedom and positions of sleeping motors, and the efforts (nv,) of all."""
        self._active: tuple[NDArray[np.intp], NDArray[np.int32], NDArray[np.int32]]
        """Degrees of freedom of active motors, their trees, and where their positions are in qpos."""
        self._always_enabled = False
        self._update_active()

    def command_effort(self, axis: int, effort: float, *, hardware: bool = False) -> None:
        """Apply an effort [N·m or N] to an axis within its limits, and switch its motor off.

        As in Gazebo, an axis beyond its velocity limit is not accelerated further: with such a limit the effort comes
        from a motor with that target speed, which acts in one direction only.

        Args:
            axis: axis index.
            effort: replaces the last command.
            hardware: the command is a hardware interface's, which acts beside direct commands, as in Gazebo: efforts
                add up, also to a motor's; the later of two speeds counts; a kinematic drive overrides all.
        """
        largest = self._max_efforts[axis]
        self._command(axis, self._effort_command(axis, min(max(effort, -largest), largest)), hardware=hardware)

    def command_velocity(self, axis: int, velocity: float, max_effort: float, *, hardware: bool = False) -> None:
        """Drive an axis at a speed [rad/s or m/s] with limited effort."""
        self._drive(axis, velocity, max_effort, rate=0.0, hardware=hardware)

    def drive_kinematically(self, axis: int, velocity: float, *, hardware: bool = False) -> None:
        """Drive an axis at a speed [rad/s or m/s] that it takes at once; only its child links feel a reaction.

        Its effort limit applies to obstacles, not to its own weight; no limit or zero is unlimited. An axis held back
        by an obstacle is accelerated by the motor alone.
        """
        dof, actuator = self._dofs[axis], self._actuators[axis]
        last = self._commands.get(actuator)
        speed = float(self._data.qvel[dof])
        now = last[0] if last is not None and last[2] == _KINEMATIC else speed
        most = min(self._max_efforts[axis] or _HUGE, _HUGE)
        self._command(axis, MotorCommand(velocity, most, _KINEMATIC, 0.0), hardware=hardware)
        if velocity != now and abs(speed - now) <= _KEEPS_UP[0] * abs(now) + _KEEPS_UP[1]:
            self._data.qvel[dof] = velocity

    def command_of(self, axis: int) -> MotorCommand:
        """Return the direct command that an axis follows."""
        actuator = self._actuators[axis]
        if actuator in self._direct:
            return self._direct[actuator]
        effort = float(self._data.qfrc_applied[self._dofs[axis]])
        if actuator < 0:
            return MotorCommand(0.0, 0.0, 0.0, effort)
        most = float(self._model.tendon_frictionloss[actuator])
        return MotorCommand(float(self._data.ctrl[actuator]), most, float(self._rates[actuator]), effort)

    def repeat(self, axis: int, command: MotorCommand) -> None:
        """Give an axis a command that it had before."""
        self._command(axis, command)

    def command_position(self, axis: int, position: float, max_effort: float) -> None:
        """Drive an axis to a position [rad or m] and hold it."""
        self._drive(axis, position, max_effort, rate=HOLD_RATE)

    def _drive(self, axis: int, target: float, max_effort: float, *, rate: float, hardware: bool = False) -> None:
        most = max(min(max_effort, self._max_efforts[axis], _HUGE), 0.0)
        self._command(axis, MotorCommand(target, most, rate, 0.0), hardware=hardware)

    def _effort_command(self, axis: int, effort: float) -> MotorCommand:
        fastest = self._max_velocities[axis]
        if math.isinf(fastest) or effort == 0.0 or not math.isfinite(effort):
            return MotorCommand(0.0, 0.0, 0.0, effort)
        # Half of the effort is constant, half a motor's: together from zero to the full effort.
        return MotorCommand(math.copysign(fastest, effort), abs(effort) / 2, 0.0, effort / 2)

    def _command(self, axis: int, command: MotorCommand, *, hardware: bool = False) -> None:
        """Set the motor's target with an effort limit, beside a constant effort."""
        dof, actuator = self._dofs[axis], self._actuators[axis]
        if hardware or actuator in self._hardware:
            command = self._superpose(axis, command, hardware=hardware)
        self._data.qfrc_applied[dof] = command.effort
        if actuator < 0:
            return
        order = (command.target, command.max_effort, command.rate)
        # A repeated command, as controllers send at every cycle, wakes nothing.
        last = self._commands.get(actuator)
        if last == order:
            return
        self._commands[actuator] = order
        self._model.tendon_frictionloss[actuator] = command.max_effort
        self._rates[actuator] = command.rate
        self._data.ctrl[actuator] = command.target
        if last is None or (last[1] > 0.0) != (command.max_effort > 0.0):
            self._update_active()
        self._wake(dof)

    def _superpose(self, axis: int, command: MotorCommand, *, hardware: bool) -> MotorCommand:
        """Store a command; return the sum of the axis' direct command and its hardware interface's."""
        actuator = self._actuators[axis]
        if hardware:
            direct = self._direct[actuator] = self.command_of(axis)
            self._hardware[actuator] = interface = command
        else:
            self._direct[actuator] = direct = command
            interface = self._hardware[actuator]
        if interface.rate == _KINEMATIC or (direct.max_effort == 0.0 and direct.effort == 0.0):
            return interface
        if interface.is_drive and direct.is_drive:
            return command
        if interface.is_drive or direct.is_drive:
            drive, effort = (interface, direct) if interface.is_drive else (direct, interface)
            beside = self._below_velocity_limit(axis, effort.whole_effort)
            return MotorCommand(drive.target, drive.max_effort, drive.rate, beside)
        return self._effort_command(axis, direct.whole_effort + interface.whole_effort)

    def _below_velocity_limit(self, axis: int, effort: float) -> float:
        """Return the effort, or 0 if it would accelerate an axis beyond its velocity limit."""
        forward = math.copysign(1.0, effort) * float(self._data.qvel[self._dofs[axis]])
        return 0.0 if forward > self._max_velocities[axis] else effort

    def write_efforts(self) -> None:
        """Write the motors' efforts to qfrc_actuator after a step."""
        if not self._model.opt.disableflags & _NO_MOTORS:
            _contact_laws.report_efforts(self._model._address, self._data._address)

    def write_sleeping_efforts(self, evaluate: Callable[[], NDArray[np.float64]]) -> None:
        """Write the efforts of motors whose trees sleep, which MuJoCo's step leaves out.

        Args:
            evaluate: returns the efforts (nv,) of the current state with all trees awake.
        """
        dofs, trees, positions = self._active
        asleep = self._data.tree_asleep[trees] >= 0
        if not asleep.all():
            dofs, positions = dofs[asleep], positions[asleep]
        if not dofs.size:
            return
        key = dofs.tobytes() + self._data.qpos[positions].tobytes()
        if key != self._sleeping_efforts[0]:
            self._sleeping_efforts = key, evaluate()
        self._data.qfrc_actuator[dofs] = self._sleeping_efforts[1][dofs]

    @property
    def always_enabled(self) -> bool:
        """True if actuation stays enabled without active motors, because the contact laws depend on it."""
        return self._always_enabled

    @always_enabled.setter
    def always_enabled(self, value: bool) -> None:
        if value != self._always_enabled:
            self._always_enabled = value
            self._update_active()

    def invalidate(self) -> None:
        """Forget the last commands after another writer changed the arrays."""
        for commands in (self._commands, self._direct, self._hardware):
            commands.clear()
        self._update_active()

    def transfer_from(self, old: "Motors", actuators: Iterable[tuple[int, int]]) -> None:
        """Continue with the commands of another model's motors, whose effort limits and rates were copied.

        Args:
            old: the other motors.
            actuators: old and new index of each motor that both have.
        """
        self.invalidate()
        for source, target in actuators:
            if source in old._hardware:
                self._direct[target], self._hardware[target] = old._direct[source], old._hardware[source]

    def save(self) -> MotorCommands:
        """Save the commands."""
        return MotorCommands(
            self._model.tendon_frictionloss.copy(),
            self._rates.copy(),
            dict(self._commands),
            dict(self._direct),
            dict(self._hardware),
        )

    def restore(self, saved: MotorCommands) -> None:
        """Restore saved commands."""
        self._model.tendon_frictionloss[:] = saved.max_efforts
        self._rates[:] = saved.rates
        self._commands = dict(saved.last)
        self._direct, self._hardware = dict(saved.direct), dict(saved.hardware)
        self._update_active()

    def switch_off(self) -> None:
        """Switch every motor off."""
        self._model.tendon_frictionloss[:] = 0
        self.invalidate()

    def _update_active(self) -> None:
        """Disable actuation while all motors are inactive, which saves a seventh of a step at rest."""
        model = self._model
        dofs = self._motor_dofs[model.tendon_frictionloss > 0.0]
        self._active = dofs, model.dof_treeid[dofs], model.jnt_qposadr[model.dof_jntid[dofs]]
        is_on = self._always_enabled or dofs.size > 0
        flags = model.opt.disableflags
        model.opt.disableflags = flags & ~_NO_MOTORS if is_on else flags | _NO_MOTORS
