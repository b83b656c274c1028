"""Commands of motors as rules in Python, to which the C++ is compared."""

import math

import mujoco
import numpy as np

from trundle.sim.physics import CompiledWorld, MotorCommand
from trundle.sim.physics.compile.law_tables import find_table

_KINEMATIC, _HUGE = -1.0, 1e10


class PythonMotors:
    """Motors of a model, as `Motors`."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self.model, self.data = compiled.model, data
        self._dofs, self._actuators = compiled.axis_dof.tolist(), compiled.axis_actuator.tolist()
        self._max_efforts, self._max_velocities = compiled.axis_effort.tolist(), compiled.axis_velocity.tolist()
        self._last: dict[int, tuple[float, ...]] = {}
        self._hardware: dict[int, MotorCommand] = {}
        self._direct: dict[int, MotorCommand] = {}
        self.rates = find_table(compiled.model, "motors")[:, 1]

    def command_effort(self, axis: int, effort: float, *, hardware: bool = False) -> None:
        largest = self._max_efforts[axis]
        self._send(axis, self._effort_command(axis, min(max(effort, -largest), largest)), hardware=hardware)

    def command_velocity(self, axis: int, velocity: float, max_effort: float, *, hardware: bool = False) -> None:
        largest = max(min(max_effort, self._max_efforts[axis], _HUGE), 0.0)
        self._send(axis, MotorCommand(velocity, largest, 0.0, 0.0), hardware=hardware)

    def command_position(self, axis: int, position: float, max_effort: float) -> None:
        largest = max(min(max_effort, self._max_efforts[axis], _HUGE), 0.0)
        self._send(axis, MotorCommand(position, largest, 3.0, 0.0), hardware=False)

    def drive_kinematically(self, axis: int, velocity: float, *, hardware: bool = False) -> None:
        dof, last = self._dofs[axis], self._last.get(self._actuators[axis])
        speed = float(self.data.qvel[dof])
        now = last[0] if last is not None and last[2] == _KINEMATIC else speed
        largest = min(self._max_efforts[axis] or _HUGE, _HUGE)
        self._send(axis, MotorCommand(velocity, largest, _KINEMATIC, 0.0), hardware=hardware)
        if velocity != now and abs(speed - now) <= 0.05 * abs(now) + 0.01:
            self.data.qvel[dof] = velocity

    def command_of(self, axis: int) -> MotorCommand:
        actuator = self._actuators[axis]
        if actuator in self._direct:
            return self._direct[actuator]
        max_effort, effort = self.model.tendon_frictionloss[actuator], self.data.qfrc_applied[self._dofs[axis]]
        return MotorCommand(self.data.ctrl[actuator], max_effort, float(self.rates[actuator]), effort)

    def repeat(self, axis: int, command: MotorCommand) -> None:
        self._send(axis, command, hardware=False)

    def _effort_command(self, axis: int, effort: float) -> MotorCommand:
        fastest = self._max_velocities[axis]
        if math.isinf(fastest) or effort == 0.0:
            return MotorCommand(0.0, 0.0, 0.0, effort)
        return MotorCommand(math.copysign(fastest, effort), abs(effort) / 2, 0.0, effort / 2)

    def _send(self, axis: int, command: MotorCommand, *, hardware: bool) -> None:
        dof, actuator = self._dofs[axis], self._actuators[axis]
        if hardware or actuator in self._hardware:
            command = self._superpose(axis, command, hardware=hardware)
        self.data.qfrc_applied[dof] = command.effort
        order = (command.target, command.max_effort, command.rate)
        if self._last.get(actuator) == order:
            return
        self._last[actuator] = order
        self.model.tendon_frictionloss[actuator], self.rates[actuator] = command.max_effort, command.rate
        self.data.ctrl[actuator] = command.target

    def _superpose(self, axis: int, command: MotorCommand, *, hardware: bool) -> MotorCommand:
        actuator = self._actuators[axis]
        if hardware:
            self._direct[actuator] = self.command_of(axis)
            self._hardware[actuator] = command
        else:
            self._direct[actuator] = command
        direct, interface = self._direct[actuator], self._hardware[actuator]
        if interface.rate == _KINEMATIC or (direct.max_effort == 0.0 and direct.effort == 0.0):
            return interface
        if _is_drive(interface) and _is_drive(direct):
            return command
        if _is_drive(interface) or _is_drive(direct):
            drive, effort = (interface, direct) if _is_drive(interface) else (direct, interface)
            forward = math.copysign(1.0, _whole(effort)) * float(self.data.qvel[self._dofs[axis]])
            added = 0.0 if forward > self._max_velocities[axis] else _whole(effort)
            return MotorCommand(drive.target, drive.max_effort, drive.rate, added)
        return self._effort_command(axis, _whole(direct) + _whole(interface))

    def numbers(self) -> bytes:
        """Return all that commands write."""
        arrays = (self.data.qfrc_applied, self.data.ctrl, self.data.qvel, self.model.tendon_frictionloss, self.rates)
        return np.concatenate(arrays).tobytes()


def _is_drive(command: MotorCommand) -> bool:
    return command.max_effort > 0.0 and command.effort == 0.0


def _whole(command: MotorCommand) -> float:
    return command.effort + math.copysign(command.max_effort, command.effort) if command.effort else 0.0
