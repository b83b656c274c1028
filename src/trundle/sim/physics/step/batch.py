"""Batch: many states of one compiled world, stepped by threads in C++.

A row is the state that the next step depends on, with the commands of its motors. Every thread has its own model and
data, so that a row's numbers depend on the row only. Nothing sleeps.
"""

import copy
from collections.abc import Sequence

import mujoco
import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from ..compile.law_tables import find_table
from .motors import HOLD_RATE, MotorCommands
from .sleeping import STATE, SleepPolicy
from .velocities import midpoints_moved

_Array = NDArray[np.float64]
_STATE = mujoco.mjtState
_HUGE = 1e10
"""Effort of a motor without a limit [N·m or N]."""


class WorldRow(Struct, frozen=True, eq=False):
    """State of one world, with its motors."""

    state: _Array
    """mjSTATE_INTEGRATION"""
    motors: MotorCommands


class Batch:
    """Rows of one world; created by `Engine.batch`."""

    def __init__(self, compiled: CompiledWorld, rows: int, threads: int, *, actuated: bool, max_speed: float) -> None:
        """Reserve the rows.

        Args:
            compiled: the world.
            rows: number of states.
            threads: number of threads.
            actuated: True if the contact laws need actuation without motors.
            max_speed: speed from which on a row is unstable [m/s or rad/s].
        """
        self._compiled = compiled
        model = compiled.model
        self._workers = [_make_worker(compiled) for _ in range(max(1, min(threads, rows)))]
        self._stepper = _contact_laws.make_row_stepper(
            [(model._address, data._address) for model, data in self._workers],
            compiled.link_bodies.tolist(),
            max_speed,
            actuated,
        )
        self.states = np.zeros((rows, mujoco.mj_stateSize(model, STATE)))
        """(rows, …) mjSTATE_INTEGRATION."""
        self._max_efforts = np.zeros((rows, model.ntendon))
        self._rates = np.zeros((rows, model.ntendon))
        self.unstable = np.zeros(rows, dtype=np.bool_)
        """(rows,) True for rows that diverged in the last step; they keep the state before it."""
        self.poses = np.zeros((rows, len(compiled.link_names), 7))
        """(rows, links, 7) poses of the link frames: x y z [m], qw qx qy qz."""
        self.twists = np.zeros((rows, len(compiled.link_names), 6))
        """(rows, links, 6) velocity of the link frame's origin [m/s] and angular velocity [rad/s], world axes."""
        self._all = np.ones(rows, dtype=np.bool_)

    @property
    def time_s(self) -> _Array:
        """(rows,) simulation time [s]."""
        return self._part(_STATE.mjSTATE_TIME)[:, 0]

    def positions(self, axes: Sequence[int]) -> _Array:
        """Return (rows, axes) positions [rad or m]; not of ball joints."""
        chosen = list(axes)
        qpos = self._part(_STATE.mjSTATE_QPOS)[:, self._compiled.axis_qpos[chosen]]
        return qpos * self._compiled.axis_sign[chosen]

    def velocities(self, axes: Sequence[int]) -> _Array:
        """Return (rows, axes) velocities [rad/s or m/s]."""
        chosen = list(axes)
        qvel = velocities_of(self._compiled.model, self.states)[:, self._compiled.axis_dof[chosen]]
        return qvel * self._compiled.axis_sign[chosen]

    def step(self, count: int, *, chosen: NDArray[np.bool_] | None = None) -> None:
        """Step every row, or those marked in `chosen` (rows,), and compute their poses and twists, with the GIL
        released.
        """
        self._stepper.step(
            self._all if chosen is None else chosen,
            self.states,
            self._max_efforts,
            self._rates,
            self.unstable,
            self.poses,
            self.twists,
            count,
        )

    # -- motors, as `Motors`; values are (rows,)

    def command_effort(self, axis: int, efforts: _Array) -> None:
        """Apply efforts [N·m or N] to an axis within its limits, and switch its motors off."""
        max_effort, max_speed = float(self._compiled.axis_effort[axis]), float(self._compiled.axis_velocity[axis])
        efforts = np.clip(efforts, -max_effort, max_effort)
        if np.isinf(max_speed):
            self._command(axis, commands=np.zeros_like(efforts), max_efforts=0.0, efforts=efforts)
            return
        commands = np.where(efforts == 0.0, 0.0, np.copysign(max_speed, efforts))
        self._command(axis, commands=commands, max_efforts=np.abs(efforts) / 2, efforts=efforts / 2)

    def command_velocity(self, axis: int, velocities: _Array, max_effort: float) -> None:
        """Drive an axis at speeds [rad/s or m/s] with limited effort."""
        self._command(axis, commands=velocities, max_efforts=self._limited(axis, max_effort))

    def command_position(self, axis: int, positions: _Array, max_effort: float) -> None:
        """Drive an axis to positions [rad or m], within its limits, and hold it there."""
        low, high = self._compiled.axis_range[axis].tolist()
        commands = np.minimum(np.maximum(positions, low), high)
        self._command(axis, commands=commands, max_efforts=self._limited(axis, max_effort), rate=HOLD_RATE)

    def _limited(self, axis: int, max_effort: float) -> float:
        return max(min(max_effort, float(self._compiled.axis_effort[axis]), _HUGE), 0.0)

    def _command(
        self,
        axis: int,
        *,
        commands: _Array,
        max_efforts: _Array | float,
        rate: float = 0.0,
        efforts: _Array | float = 0.0,
    ) -> None:
        dof, actuator = int(self._compiled.axis_dof[axis]), int(self._compiled.axis_actuator[axis])
        self._part(_STATE.mjSTATE_QFRC_APPLIED)[:, dof] = efforts
        self._part(_STATE.mjSTATE_CTRL)[:, actuator] = commands
        self._max_efforts[:, actuator] = max_efforts
        self._rates[:, actuator] = rate

    # -- rows

    def write_row(self, row: int, source: WorldRow) -> None:
        """Set a row, and compute its poses and twists."""
        self.write_rows([row], [source])

    def write_rows(self, rows: Sequence[int], sources: Sequence[WorldRow]) -> None:
        """Set rows, and compute their poses and twists at once."""
        chosen = np.zeros_like(self._all)
        for row, source in zip(rows, sources, strict=True):
            self.states[row] = source.state
            self._max_efforts[row], self._rates[row] = source.motors.max_efforts, source.motors.rates
            chosen[row] = True
        self.step(0, chosen=chosen)

    def _part(self, part: mujoco.mjtState) -> _Array:
        """Return a part of the states as a view."""
        return part_of(self._compiled.model, self.states, part)


def part_of(model: mujoco.MjModel, states: _Array, part: mujoco.mjtState) -> _Array:
    """Return a part of (rows, …) states, mjSTATE_INTEGRATION, as a view."""
    first = mujoco.mj_stateSize(model, STATE & (int(part) - 1))
    return states[:, first : first + mujoco.mj_stateSize(model, int(part))]


def velocities_of(model: mujoco.MjModel, states: _Array) -> _Array:
    """Return the velocities (rows, nv) of (rows, …) states, mjSTATE_INTEGRATION, at the time of their positions."""
    qvel, qacc = (part_of(model, states, part) for part in (_STATE.mjSTATE_QVEL, _STATE.mjSTATE_WARMSTART))
    times = part_of(model, states, _STATE.mjSTATE_USERDATA)[:, model.nu : model.nu + model.nv]
    if not times.any():
        return qvel
    return midpoints_moved(qvel, times, qacc, 0.5 * model.opt.timestep)


def _make_worker(compiled: CompiledWorld) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a thread's copy of the model, without sleeping, and data."""
    model = copy.copy(compiled.model)
    data = mujoco.MjData(model)
    SleepPolicy(replace(compiled, model=model), data).set_flags(False)
    find_table(model, "laws")[0, 7] = data._address
    return model, data
