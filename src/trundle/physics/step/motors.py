"""Drives joints: efforts, speeds and positions, within their limits.

A motor is a constraint that keeps a speed with a force up to a limit, as ODE's; `cpp/velocity_motor.cc` has how.
"""

import math
from collections.abc import Callable

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from ..compile.law_tables import find_table

HOLD_RATE = 3.0
"""[1/s] How fast a held joint closes in: a first-order lag of a third of a second, as its motor's torque allows."""
_KINEMATIC = -1.0
"""In place of such a rate."""
_KEEPS_UP = 0.05, 0.01
"""Part of its speed, and [rad/s or m/s], that a kinematic axis may be off, to be given another at once."""
_HUGE = 1e10
_NO_MOTORS = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)


class MotorCommands(Struct, frozen=True, eq=False):
    """Orders of a model's motors, without the speeds and positions, which are in its data."""

    max_efforts: NDArray[np.float64]
    rates: NDArray[np.float64]

    @classmethod
    def from_model(cls, model: mujoco.MjModel) -> "MotorCommands":
        """Those of a model now."""
        return cls(model.tendon_frictionloss.copy(), find_table(model, "motors")[:, 1].copy())

    def apply(self, model: mujoco.MjModel) -> None:
        """Tell them a model."""
        model.tendon_frictionloss[:] = self.max_efforts
        find_table(model, "motors")[:, 1] = self.rates


class Motors:
    """One motor for each axis of a hinge or slide; each does nothing until told to."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData, wake: Callable[[int], None]) -> None:
        """Take the engine's arrays.

        Args:
            compiled: the world.
            data: its state.
            wake: called with a degree of freedom that is told something new.
        """
        self._model = compiled.model
        self._data = data
        self._wake = wake
        # Lists: one number of an array costs four times as much, and controllers give orders at every step.
        self._dofs: list[int] = compiled.axis_dof.tolist()
        self._actuators: list[int] = compiled.axis_actuator.tolist()
        self._max_efforts: list[float] = compiled.axis_effort.tolist()
        self._max_velocities: list[float] = compiled.axis_velocity.tolist()
        self._commands: dict[int, tuple[float, ...]] = {}
        self._rates = find_table(compiled.model, "motors")[:, 1]
        self._always_enabled = False
        self._update_actuation_flag()

    def command_effort(self, axis: int, effort: float) -> None:
        """Hold an effort [N·m or N] on an axis, as far as its limits let it, and switch its motor off.

        As in Gazebo, an axis that is faster than its limit is not pushed on: with such a limit the effort is a
        motor's, which wants that speed and pulls one way only.
        """
        largest, fastest = self._max_efforts[axis], self._max_velocities[axis]
        effort = min(max(effort, -largest), largest)
        if math.isinf(fastest) or effort == 0.0 or not math.isfinite(effort):
            self._command(axis, command=0.0, most=0.0, effort=effort)
            return
        # Half of the effort, and a motor of the other half: together from nothing to all of it.
        self._command(axis, command=math.copysign(fastest, effort), most=abs(effort) / 2, effort=effort / 2)

    def command_velocity(self, axis: int, velocity: float, max_effort: float) -> None:
        """Have a motor keep a speed [rad/s or m/s] with at most so much effort."""
        self._drive(axis, velocity, max_effort, rate=0.0)

    def drive_kinematically(self, axis: int, velocity: float) -> None:
        """Have an axis keep a speed [rad/s or m/s] that it takes at once; only what hangs from it feels that.

        Its effort limit holds for what is in its way; its own weight does not count, and none or zero is no limit.
        What is held up by something is pushed on by the motor alone.
        """
        dof, actuator = self._dofs[axis], self._actuators[axis]
        last = self._commands.get(actuator)
        speed = float(self._data.qvel[dof])
        now = last[0] if last is not None and last[2] == _KINEMATIC else speed
        self._command(axis, command=velocity, most=min(self._max_efforts[axis] or _HUGE, _HUGE), rate=_KINEMATIC)
        if velocity != now and abs(speed - now) <= _KEEPS_UP[0] * abs(now) + _KEEPS_UP[1]:
            self._data.qvel[dof] = velocity

    def command_position(self, axis: int, position: float, max_effort: float) -> None:
        """Have a motor go to a position [rad or m] and stay there."""
        self._drive(axis, position, max_effort, rate=HOLD_RATE)

    def _drive(self, axis: int, command: float, max_effort: float, *, rate: float) -> None:
        most = min(max_effort, self._max_efforts[axis], _HUGE)
        self._command(axis, command=command, most=max(most, 0.0), rate=rate)

    def _command(self, axis: int, *, command: float, most: float, rate: float = 0.0, effort: float = 0.0) -> None:
        """Have the motor keep a command with an effort up to `most`, beside an effort that lasts."""
        dof, actuator = self._dofs[axis], self._actuators[axis]
        self._data.qfrc_applied[dof] = effort
        if actuator < 0:
            return
        order = (command, most, rate)
        # The same order again, as controllers give it at every turn, wakes nobody.
        last = self._commands.get(actuator)
        if last == order:
            return
        self._commands[actuator] = order
        self._model.tendon_frictionloss[actuator] = most
        self._rates[actuator] = rate
        self._data.ctrl[actuator] = command
        if last is None or (last[1] > 0.0) != (most > 0.0):
            self._update_actuation_flag()
        self._wake(dof)

    def write_efforts(self) -> None:
        """Write what the motors exert where efforts are read, after a step."""
        if not self._model.opt.disableflags & _NO_MOTORS:
            _contact_laws.report_efforts(self._model._address, self._data._address)

    @property
    def always_enabled(self) -> bool:
        """Whether the engine has to work the motors though none does anything: with them go its contact laws."""
        return self._always_enabled

    @always_enabled.setter
    def always_enabled(self, value: bool) -> None:
        if value != self._always_enabled:
            self._always_enabled = value
            self._update_actuation_flag()

    def invalidate(self) -> None:
        """The arrays were changed by somebody else: the next order is a new one."""
        self._commands.clear()
        self._update_actuation_flag()

    def switch_off(self) -> None:
        """Every motor."""
        self._model.tendon_frictionloss[:] = 0
        self.invalidate()

    def _update_actuation_flag(self) -> None:
        """Spare the engine the motors while none does anything: a seventh of a step of what is at rest."""
        model = self._model
        is_on = self._always_enabled or bool(model.tendon_frictionloss.any())
        flags = model.opt.disableflags
        model.opt.disableflags = flags & ~_NO_MOTORS if is_on else flags | _NO_MOTORS
