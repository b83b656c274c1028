"""Drives joints: efforts, speeds and positions, within their limits."""

import math
from collections.abc import Callable

import mujoco

from .index import CompiledWorld

HOLD_RATE = 3.0
"""[1/s] How fast a held joint closes in: a first-order lag of a third of a second, as its motor's torque allows."""
MOTOR_STIFFNESS = 10.0
"""1 would stop a joint by itself in one step, and droops under the robot's weight: a turn of 2.44 rad came out as 2.13.
10 gives 2.41; 100 gives 2.44 and chatters where the effort limit is met (measured on the RP2W at 1 ms)."""
_HUGE = 1e10
_NO_MOTORS = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)


class Motors:
    """One motor for each axis of a hinge or slide; each does nothing until told to."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData, wake: Callable[[int], None]) -> None:
        """Take the engine's arrays.

        Args:
            compiled: the world.
            data: its state.
            wake: called with a degree of freedom that is told something new.
        """
        self._compiled = compiled
        self._model = compiled.model
        self._data = data
        self._wake = wake
        self._orders: dict[int, tuple[float, ...]] = {}
        self._keep_on = False
        self._plug()

    def set_effort(self, axis: int, effort: float) -> None:
        """Hold an effort [N·m or N] on an axis, as far as its limits let it, and switch its motor off.

        As in Gazebo, an axis that is faster than its limit is not pushed on: with such a limit the effort is a
        motor's, which wants that speed and pulls one way only.
        """
        compiled = self._compiled
        largest, fastest = float(compiled.axis_effort[axis]), float(compiled.axis_velocity[axis])
        effort = min(max(effort, -largest), largest)
        if math.isinf(fastest) or effort == 0.0 or not math.isfinite(effort):
            self._motor(axis, gain=0.0, position=0.0, velocity=0.0, low=-1.0, high=1.0, command=0.0)
            self._data.qfrc_applied[compiled.axis_dof[axis]] = effort
            return
        gain, command = self._motor_gain(axis), math.copysign(fastest, effort)
        low, high = min(effort, 0.0), max(effort, 0.0)
        self._motor(axis, gain=gain, position=0.0, velocity=gain, low=low, high=high, command=command)

    def set_velocity(self, axis: int, velocity: float, max_effort: float, *, often: bool = False) -> None:
        """Have a motor keep a speed [rad/s or m/s] with at most so much effort.

        Args:
            axis: of the engine.
            velocity: to keep.
            max_effort: at most.
            often: this is told anew at every few steps. Then the motor is soft while its effort limit is all that
                keeps it from the speed: a stiff one would go past it, and back, for ever.
        """
        gain = self._motor_gain(axis)
        if often:
            missing = abs(velocity - float(self._data.qvel[self._compiled.axis_dof[axis]]))
            if gain * missing > min(max_effort, float(self._compiled.axis_effort[axis])):
                gain /= MOTOR_STIFFNESS
        self._motor(axis, gain=gain, position=0.0, velocity=gain, low=-max_effort, high=max_effort, command=velocity)

    def hold(self, axis: int, position: float, max_effort: float) -> None:
        """Have a motor go to a position [rad or m] and stay there."""
        damping = self._motor_gain(axis)
        gain = HOLD_RATE * damping
        self._motor(
            axis, gain=gain, position=gain, velocity=damping, low=-max_effort, high=max_effort, command=position
        )

    def _motor_gain(self, axis: int) -> float:
        """Effort per error of speed, by what the motor has to move with every joint at zero."""
        inertia = float(self._model.dof_M0[self._compiled.axis_dof[axis]])
        return MOTOR_STIFFNESS * inertia / self._model.opt.timestep

    def _motor(
        self, axis: int, *, gain: float, position: float, velocity: float, low: float, high: float, command: float
    ) -> None:
        """force = gain · command − position · q − velocity · q̇, from low to high."""
        dof, actuator = int(self._compiled.axis_dof[axis]), int(self._compiled.axis_actuator[axis])
        self._data.qfrc_applied[dof] = 0.0
        if actuator < 0:
            return
        order = (gain, position, velocity, max(low, -_HUGE), min(high, _HUGE), command)
        # The same order again, as controllers give it at every turn, wakes nobody.
        if self._orders.get(actuator) == order:
            return
        self._orders[actuator] = order
        self._model.actuator_gainprm[actuator, 0] = gain
        self._model.actuator_biasprm[actuator, 1:3] = (-position, -velocity)
        self._model.actuator_forcerange[actuator] = order[3:5]
        self._data.ctrl[actuator] = command
        self._plug()
        self._wake(dof)

    @property
    def keep_on(self) -> bool:
        """Whether the engine has to work the motors though none does anything: with them go its contact laws."""
        return self._keep_on

    @keep_on.setter
    def keep_on(self, value: bool) -> None:
        if value != self._keep_on:
            self._keep_on = value
            self._plug()

    def forget(self) -> None:
        """The arrays were changed by somebody else: the next order is a new one."""
        self._orders.clear()
        self._plug()

    def switch_off(self) -> None:
        """Every motor."""
        self._model.actuator_gainprm[:] = 0
        self._model.actuator_biasprm[:] = 0
        self.forget()

    def _plug(self) -> None:
        """Spare the engine the motors while none does anything: a seventh of a step of what is at rest."""
        model = self._model
        is_on = self._keep_on or bool(model.actuator_gainprm[:, 0].any() or model.actuator_biasprm[:, 1:3].any())
        flags = model.opt.disableflags
        model.opt.disableflags = flags & ~_NO_MOTORS if is_on else flags | _NO_MOTORS
