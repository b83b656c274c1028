"""Joint motors: effort, velocity and position commands within limits.

A motor is a velocity constraint with bounded force, as in ODE; see `cpp/contact/velocity_motor.cc`. Commands are set in
`cpp/contact/motor_bank.cc`, fast enough for every step.
"""

from collections.abc import Callable, Iterable
from typing import TypeAlias

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
_STATE_WIDTH = 13
"""Numbers of a `MotorState` in `cpp/contact/motor_bank.h`."""
_SHARED = slice(4, _STATE_WIDTH)
"""Columns of the commands of an axis that a hardware interface shares with direct ones."""
_NO_MOTORS = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)


MotorBank: TypeAlias = _contact_laws.MotorBank
"""Motors of an engine, for laws in C++."""
MotorAxis: TypeAlias = tuple[_contact_laws.MotorBank, int, int, int, float]
"""Axis of an engine for laws in C++: its motors, its index, addresses in qpos and qvel, and the sign of both."""


class MotorCommand(Struct, frozen=True):
    """Command of one axis."""

    target: float
    """Speed [rad/s or m/s]; with a rate, position [rad or m]."""
    max_effort: float
    """Limit of the motor [N·m or N]; 0: it is off."""
    rate: float
    """Rate of the approach [1/s]; 0: the target is a speed."""
    effort: float
    """Constant effort in addition to the motor [N·m or N]."""


class MotorCommands(Struct, frozen=True, eq=False):
    """Effort limits, rates and commands of a model's motors; the targets are in the data."""

    max_efforts: NDArray[np.float64]
    rates: NDArray[np.float64]
    states: NDArray[np.float64]
    """(motors, 13) last commands, as in `cpp/contact/motor_bank.h`."""


def copy_commands(source: mujoco.MjModel, target: mujoco.MjModel) -> None:
    """Copy the commands of motors, except for the targets, between two models of one world."""
    target.tendon_frictionloss[:] = source.tendon_frictionloss
    find_table(target, "motors")[:, 1] = find_table(source, "motors")[:, 1]


class Motors:
    """One motor per hinge or slide axis, inactive until commanded.

    A command with `hardware` comes from a hardware interface and is combined with direct commands, as in Gazebo:
    efforts add up, also to a motor's; the later of two speeds counts; a kinematic drive overrides all.
    """

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        """Bind the engine's arrays.

        Args:
            compiled: the world.
            data: its state.
        """
        self._model = model = compiled.model
        self._data = data
        self._states = np.zeros((model.nu, _STATE_WIDTH))
        axes = (compiled.axis_dof, compiled.axis_actuator, compiled.axis_effort, compiled.axis_velocity)
        self.bank = _contact_laws.MotorBank(model, data, np.column_stack(axes).astype(np.float64), self._states)
        """Motors for laws in C++."""
        self._signs = compiled.axis_sign
        self._addresses = compiled.axis_qpos, compiled.axis_dof
        self._rates = find_table(model, "motors")[:, 1]
        self._motor_dofs = find_table(model, "motors")[:, 3].astype(np.intp)
        self._sleeping_efforts: tuple[bytes, NDArray[np.float64]] = (b"", np.empty(0))
        """Cache: degrees of freedom and positions of sleeping motors, and the efforts (nv,) of all motors."""
        self._active: tuple[NDArray[np.intp], NDArray[np.int32], NDArray[np.int32]]
        """Degrees of freedom of active motors, their trees, and their addresses in qpos."""
        self._switches = -1
        """Value of the bank's counter for which `_active` is valid; −1: none."""

    def axis(self, axis: int) -> MotorAxis:
        """Return an axis for laws in C++."""
        qpos, dof = (int(addresses[axis]) for addresses in self._addresses)
        return self.bank, axis, qpos, dof, float(self._signs[axis])

    def command_effort(self, axis: int, effort: float, *, hardware: bool = False) -> None:
        """Apply an effort [N·m or N], in place of the last one, to an axis within its limits; switch its motor off."""
        self.bank.command_effort(axis, effort, hardware)

    def command_velocity(self, axis: int, velocity: float, max_effort: float, *, hardware: bool = False) -> None:
        """Drive an axis at a speed [rad/s or m/s] with limited effort."""
        self.bank.command_velocity(axis, velocity, max_effort, hardware)

    def drive_kinematically(self, axis: int, velocity: float, *, hardware: bool = False) -> None:
        """Drive an axis at a speed [rad/s or m/s] that it reaches at once; only its child links feel a reaction."""
        self.bank.drive_kinematically(axis, velocity, hardware)

    def command_position(self, axis: int, position: float, max_effort: float) -> None:
        """Drive an axis to a position [rad or m] and hold it."""
        self.bank.command_position(axis, position, max_effort, HOLD_RATE)

    def command_of(self, axis: int) -> MotorCommand:
        """Return an axis' current direct command."""
        return MotorCommand(*self.bank.command_of(axis))

    def repeat(self, axis: int, command: MotorCommand) -> None:
        """Set an axis' command to an earlier one."""
        self.bank.repeat(axis, (command.target, command.max_effort, command.rate, command.effort))

    def write_efforts(self) -> None:
        """Write the motors' efforts to qfrc_actuator after a step."""
        if not self._model.opt.disableflags & _NO_MOTORS:
            _contact_laws.report_efforts(self._model._address, self._data._address)

    def write_sleeping_efforts(self, evaluate: Callable[[], NDArray[np.float64]]) -> None:
        """Write the efforts of motors of sleeping trees, which MuJoCo's step skips.

        Args:
            evaluate: returns the efforts (nv,) of the current state with all trees awake.
        """
        dofs, trees, positions = self._find_active()
        asleep = self._data.tree_asleep[trees] >= 0
        if not asleep.all():
            dofs, positions = dofs[asleep], positions[asleep]
        if not dofs.size:
            return
        key = dofs.tobytes() + self._data.qpos[positions].tobytes()
        if key != self._sleeping_efforts[0]:
            self._sleeping_efforts = key, evaluate()
        self._data.qfrc_actuator[dofs] = self._sleeping_efforts[1][dofs]

    def enable(self, *, always: bool) -> None:
        """Enable actuation if there are motors, or always; without it a step is a seventh faster.

        Args:
            always: True if the contact laws depend on actuation.
        """
        flags, is_on = self._model.opt.disableflags, always or self._model.nu > 0
        self._model.opt.disableflags = flags & ~_NO_MOTORS if is_on else flags | _NO_MOTORS

    def invalidate(self) -> None:
        """Clear the last commands after another writer changed the arrays."""
        self._states[:] = 0.0
        self._switches = -1

    def transfer_from(self, old: "Motors", actuators: Iterable[tuple[int, int]]) -> None:
        """Continue with the commands of another model's motors, whose effort limits and rates were copied.

        Args:
            old: the other motors.
            actuators: old and new index of each motor in both models.
        """
        self.invalidate()
        for source, target in actuators:
            self._states[target, _SHARED] = old._states[source, _SHARED]

    def save(self) -> MotorCommands:
        """Save the commands."""
        return MotorCommands(self._model.tendon_frictionloss.copy(), self._rates.copy(), self._states.copy())

    def restore(self, saved: MotorCommands) -> None:
        """Restore saved commands."""
        self._model.tendon_frictionloss[:] = saved.max_efforts
        self._rates[:] = saved.rates
        self._states[:] = saved.states
        self._switches = -1

    def switch_off(self) -> None:
        """Switch every motor off."""
        self._model.tendon_frictionloss[:] = 0
        self.invalidate()

    def _find_active(self) -> tuple[NDArray[np.intp], NDArray[np.int32], NDArray[np.int32]]:
        if self._switches != self.bank.switches:
            model, self._switches = self._model, self.bank.switches
            dofs = self._motor_dofs[model.tendon_frictionloss > 0.0]
            self._active = dofs, model.dof_treeid[dofs], model.jnt_qposadr[model.dof_jntid[dofs]]
        return self._active
