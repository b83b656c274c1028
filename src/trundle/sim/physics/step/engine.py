"""Engine: steps a compiled world in C, and reads and writes its state.

No Python runs per step: `step(n)` is one call, and the state is read on demand.
"""

import copy
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.spatial import Wrench

from ..compile.compiled_world import CompiledWorld
from ..compile.solver_settings import silence_log
from .contact import Contacts
from .contact_laws import ContactLaws
from .contact_query import ContactQuery
from .dynamics import Dynamics
from .engine_snapshot import EngineSnapshot, ScratchEngine
from .instability import Divergence, find_divergence
from .motors import MotorCommands, Motors
from .sleeping import DECISION_PERIOD, STATE, SleepPolicy
from .state_reader import StateReader
from .state_transfer import transfer_state
from .state_writer import StateWriter
from .step_timer import StepTimer
from .stepper import StepHooks, Stepper

if TYPE_CHECKING:  # a single world without belts does not import these
    from .batch import Batch, WorldRow
    from .surface_motion import LinkGrip

_DATA_BYTES = 450_000
"""Measured size of a copied `MjData` without its buffer and arena: the struct with its solver statistics (160 kB in
MuJoCo 4), and the Python binding's data."""
_MANY_SPEEDS = 10_000
"""Number of values from which on BLAS uses several threads; their synchronization may take longer than a step."""
_BAD = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
MAX_SPEED = 1e6
"""Speed [m/s or rad/s] from which on the physics is unstable; MuJoCo's own limit is 1e10."""


class SimulationUnstableError(TrundleError):
    """Unstable physics; the engine holds the last good state."""

    __module__ = "trundle"

    id = "unstable"

    def __init__(self, divergence: Divergence) -> None:
        super().__init__(
            f"the physics became unstable {divergence}; "
            f"a smaller <max_step_size> or more plausible masses and inertias may help"
        )
        self.divergence = divergence


class EngineState(Struct, frozen=True, eq=False):
    """Saved state of the engine, sufficient to continue from."""

    compiled: CompiledWorld
    data: mujoco.MjData
    """Copy of the data, as the state vector does not hold which trees sleep."""
    steps: int
    sleeps: bool
    has_state_only: bool
    was_teleported: bool
    motors: MotorCommands


class Engine:
    """Compiled world in motion."""

    def __init__(self, compiled: CompiledWorld) -> None:
        silence_log()
        self.compiled = compiled
        self._model = compiled.model
        self._data = mujoco.MjData(compiled.model)
        self._sleep_policy = SleepPolicy(compiled, self._data)
        self.reader = StateReader(compiled, self._data)
        self.writer = StateWriter(compiled, self._data, wake=self._sleep_policy.wake, changed=self._state_changed)
        self.motors = Motors(compiled, self._data)
        self._laws = ContactLaws(compiled, self._data)
        self.motors.enable(always=self._laws.is_active)
        self._scratch = ScratchEngine(compiled)
        self.dynamics = Dynamics(compiled, self._scratch)
        self._contact_query = ContactQuery(compiled, self._data, self._scratch)
        self.timer = StepTimer(self._data)
        self._warnings = [self._data.warning[kind] for kind in _BAD]
        self._last_state = np.empty(mujoco.mj_stateSize(self._model, STATE))
        self._steps = 0
        """Number of steps, which decides when sleeping is updated."""
        self.reset()

    def reset(self) -> None:
        """Return to the initial state, at rest, with every motor off."""
        self._sleep_policy.set_flags(False)
        mujoco.mj_resetData(self._model, self._data)
        if self.compiled.initial_qpos is not None:
            self._data.qpos[:] = self.compiled.initial_qpos
        self._steps = 0
        self.writer.was_teleported = True
        self.motors.switch_off()
        self._state_changed()

    def _state_changed(self) -> None:
        """Invalidate all that depends on the state, after it was written."""
        self._laws.expect_any_speed()
        self.reader.invalidate()

    @property
    def addresses(self) -> tuple[int, int]:
        """Addresses of MuJoCo's model and data, for laws in C++."""
        return self._model._address, self._data._address

    def state_written(self, *, moved: bool) -> None:
        """Continue after a law in C++ has written positions or velocities.

        Args:
            moved: True if links were moved, and may penetrate something.
        """
        self.writer.was_teleported |= moved
        self._state_changed()

    def step(self, count: int, hooks: StepHooks | None = None) -> int:
        """Advance `count` time steps, with the GIL released; return their number, smaller if an action needs Python.

        Args:
            count: number of steps.
            hooks: recorders of contacts, and actions.

        Raises:
            SimulationUnstableError: names the diverging link; the state is the one before this call.
        """
        mujoco.mj_getState(self._model, self._data, self._last_state, STATE)
        if self.writer.was_teleported:
            self._separate()
        if self._laws.is_active:
            self._laws.install()
        self._laws.resume()
        efforts, first = self._data.qfrc_actuator.copy(), self._steps
        motors = self.motors.save() if hooks is not None and hooks.actions else None
        stepper = None if hooks is None else self._stepper(hooks)
        self._advance(count, stepper)
        self._laws.look_ahead()
        self.reader.invalidate()
        if self._is_unstable():
            divergence = self._find_divergence(count, stepper, lambda: self._roll_back(efforts, first, motors))
            raise SimulationUnstableError(divergence)
        return self._steps - first

    def _stepper(self, hooks: StepHooks) -> Stepper:
        return Stepper(hooks, self.compiled, self._data, query=self._contact_query, state=self._state)

    def _advance(self, count: int, stepper: Stepper | None = None) -> None:
        """Step in C, up to each update of the sleep policy; a stepper may stop earlier."""
        goes_on = True
        while count > 0 and goes_on and not self._is_unstable():
            planned = stepped = min(count, DECISION_PERIOD - self._steps % DECISION_PERIOD)
            if stepper is not None:
                self._sleep_policy.has_state_only = False
                stepped = stepper.step(planned)
                goes_on = stepped == planned
            if stepper is not None or not self._sleep_policy.step(planned):
                self.motors.write_efforts()
                if self._sleep_policy.is_on:
                    self.motors.write_sleeping_efforts(lambda: self._scratch.efforts(self._state()))
            self._steps += stepped
            count -= stepped
            if self._steps % DECISION_PERIOD == 0 and not self._laws.prevents_sleep and not self._is_unstable():
                self._sleep_policy.update()
                if stepper is not None and self._sleep_policy.has_state_only:
                    stepper.replace_last(self.contacts)

    def _is_unstable(self) -> bool:
        for warning in self._warnings:
            if warning.number > 0:
                return True
        speeds = self._data.qvel
        # For nearly all worlds the sum of squares is enough, in a tenth of the time.
        if len(speeds) < _MANY_SPEEDS and speeds.dot(speeds) < MAX_SPEED**2:
            return False
        return not bool((np.abs(speeds) < MAX_SPEED).all())

    def _separate(self) -> None:
        self.writer.was_teleported = False
        separated = self._scratch.separated(self._state())
        if separated is not None:
            self._data.qpos[:] = separated

    def _update_laws(self) -> None:
        """Disable sleeping while a law forbids it."""
        self.motors.enable(always=self._laws.is_active)
        if self._laws.prevents_sleep:
            self._sleep_policy.disable()

    def _roll_back(self, efforts: NDArray[np.float64], first: int, motors: MotorCommands | None) -> None:
        self._sleep_policy.set_state(self._last_state, efforts)
        self._steps = first
        if motors is not None:
            self.motors.restore(motors)
        self._state_changed()

    def _find_divergence(self, count: int, stepper: Stepper | None, roll_back: Callable[[], None]) -> Divergence:
        """Roll back, and repeat the steps one by one up to the bad one; the state is restored afterwards."""

        def restart() -> None:
            if stepper is not None:
                stepper.roll_back()
            roll_back()

        restart()
        time_s, speeds = self._data.time, np.abs(self._data.qvel)
        for _ in range(count):
            time_s, speeds = self._data.time, np.abs(self._data.qvel)
            self._advance(1, stepper)
            if self._is_unstable():
                break
        divergence = find_divergence(self.compiled, self._data, speeds, time_s)
        restart()
        return divergence

    # -- writing

    def set_time(self, time_s: float) -> None:
        """Set the time; only messages depend on it."""
        self._data.time = time_s

    def set_wrench(self, link: int, wrench: Wrench) -> None:
        """Apply a force [N] at the link's centre of mass and a torque [N·m], world axes, until the next call."""
        self._data.xfrc_applied[self.compiled.link_bodies[link]] = [*wrench.force, *wrench.torque]

    def wrench(self, link: int) -> Wrench:
        """Return the wrench of `set_wrench`."""
        fx, fy, fz, tx, ty, tz = self._data.xfrc_applied[self.compiled.link_bodies[link]].tolist()
        return Wrench((fx, fy, fz), (tx, ty, tz))

    def set_surface_motions(self, motions: "Mapping[int, LinkGrip]") -> None:
        """Set the surface motion of links by index; all others are ordinary."""
        self._laws.set_surface_motions(
            {int(self.compiled.link_bodies[link]): motion for link, motion in motions.items()}
        )
        self._update_laws()

    def snapshot(self) -> EngineSnapshot:
        """Return an immutable snapshot of the state."""
        return EngineSnapshot(self._scratch, self.reader)

    @property
    def asleep(self) -> int:
        """Number of sleeping trees."""
        return self._sleep_policy.asleep

    @property
    def contact_count(self) -> int:
        """Number of contacts of the last step."""
        return self._data.ncon

    def contacts(self, among: frozenset[str] | None = None) -> Contacts:
        """Return the current contacts.

        Args:
            among: names of collisions, at least one of which is part of each contact; None: all.
        """
        if self._sleep_policy.has_state_only and self._steps:
            return self._contact_query.contacts_of_state(among, self._state())
        return self._contact_query.contacts(among, self._state if self.asleep else None)

    def overlaps(self, depth: float) -> frozenset[tuple[str, str]]:
        """Return the collisions, `model::link::collision`, of each two that penetrate each other by more than a depth
        [m] in the current state, without a step.
        """
        return self._scratch.overlaps(self._state(), depth)

    def reactions(self) -> NDArray[np.float64]:
        """Return (links, 6) force [N] and torque [N·m] on each link by its parent; see `ScratchEngine.reactions`."""
        return self._scratch.reactions(self._state())

    def _state(self) -> NDArray[np.float64]:
        state = np.empty_like(self._last_state)
        mujoco.mj_getState(self._model, self._data, state, STATE)
        return state

    # -- saving

    def transfer_from(self, old: "Engine", *, renamed: Mapping[str, str] | None = None) -> None:
        """Continue from another engine's state, for everything with the same name in both.

        Args:
            old: the other engine.
            renamed: renamed models, old name → new name.
        """
        actuators = transfer_state((old._model, old._data), (self._model, self._data), renamed or {})
        self._steps = old._steps
        self.writer.was_teleported = True
        self.motors.transfer_from(old.motors, actuators)
        self._state_changed()

    def save(self) -> EngineState:
        """Return the complete state."""
        return EngineState(
            self.compiled,
            copy.copy(self._data),
            self._steps,
            self._sleep_policy.is_on,
            self._sleep_policy.has_state_only,
            self.writer.was_teleported,
            self.motors.save(),
        )

    def checkpoint(self) -> Callable[[], None]:
        """Save the complete state and the model's changed fields; return a function that restores both exactly."""
        state, model = self.save(), self._model
        tables, flags = model.numeric_data.copy(), (model.opt.enableflags, model.opt.disableflags)
        surfaces, stages = model.flg_surfacevel, model.sensor_needstage.copy()

        def restore() -> None:
            model.numeric_data[:] = tables
            model.opt.enableflags, model.opt.disableflags = flags
            model.flg_surfacevel = surfaces
            model.sensor_needstage[:] = stages
            self.restore(state)

        return restore

    def batch(self, rows: int, *, threads: int, gpu: str | None = None) -> "Batch":
        """Return rows to step at once, each a state of this world.

        Args:
            rows: number of states.
            threads: number of threads.
            gpu: device that steps them, from `find_gpu`; None: the threads step them.

        Raises:
            UsageError: the GPU cannot step this world.
        """
        actuated = self._laws.is_active
        if gpu is not None:
            from .warp.gpu_batch import GpuBatch

            return GpuBatch(self.compiled, rows, threads, actuated=actuated, max_speed=MAX_SPEED, device=gpu)
        from .batch import Batch

        return Batch(self.compiled, rows, threads, actuated=actuated, max_speed=MAX_SPEED)

    def world_row(self) -> "WorldRow":
        """Return the current state as a row of a batch, without initial penetrations."""
        from .batch import WorldRow

        if self.writer.was_teleported:
            self._separate()
        return WorldRow(self._state(), self.motors.save())

    def set_row_state(self, state: NDArray[np.float64]) -> None:
        """Set the state of a row of a batch (mjSTATE_INTEGRATION); the motors stay."""
        mujoco.mj_setState(self._model, self._data, state, STATE)
        self._state_changed()

    @property
    def checkpoint_bytes(self) -> int:
        """Approximate size of a checkpoint."""
        return int(_DATA_BYTES + self._data.nbuffer + self._data.maxuse_arena)

    def restore(self, state: EngineState) -> None:
        """Restore a saved state exactly.

        Raises:
            UsageError: the state belongs to another set of models.
        """
        if state.compiled is not self.compiled:
            raise UsageError("models were spawned or deleted since this state was saved; it cannot be restored")
        self._sleep_policy.set_flags(state.sleeps)
        mujoco.mj_copyData(self._data, self._model, state.data)
        self._steps, self._sleep_policy.has_state_only = state.steps, state.has_state_only
        self.writer.was_teleported = state.was_teleported
        self.motors.enable(always=self._laws.is_active)
        self.motors.restore(state.motors)
        self._state_changed()
