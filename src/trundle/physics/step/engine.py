"""Steps a compiled world in C, and reads and writes its state.

Nothing here runs in Python at every step: `step(n)` is one call, and the state is read when somebody asks.
"""

import copy
from collections.abc import Mapping
from typing import TYPE_CHECKING

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.diagnostics import TrundleError, UsageError
from trundle.spatial import Pose, Twist, Wrench

from ..compile.compiled_world import CompiledWorld
from ..compile.solver_settings import silence_log
from .contact import Contact
from .contact_laws import ContactLaws
from .contact_query import ContactQuery
from .engine_snapshot import EngineSnapshot, ScratchEngine
from .instability import Divergence, find_divergence
from .motors import MotorOrders, Motors
from .sleeping import EVERY, STATE, SleepPolicy
from .state_reader import StateReader
from .state_transfer import carry_over

if TYPE_CHECKING:  # a world without belts starts without them
    from .surface_motion import LinkGrip

_BAD = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
FASTEST = 1e6
"""[m/s or rad/s] Nothing that a file means moves faster; MuJoCo itself takes offence at 1e10."""


class SimulationUnstableError(TrundleError):
    """The physics blew up; the engine holds the last good state."""

    def __init__(self, runaway: Divergence) -> None:
        super().__init__(
            f"the physics became unstable {runaway}; "
            f"a smaller <max_step_size> or more plausible masses and inertias may help"
        )
        self.runaway = runaway


class EngineState(Struct, frozen=True, eq=False):
    """Everything that decides how the world goes on."""

    compiled: CompiledWorld
    data: mujoco.MjData
    """A copy: who sleeps is in no vector of numbers."""
    taken: int
    sleeps: bool
    is_blank: bool
    leapt: bool
    motors: MotorOrders


class Engine:
    """A compiled world in motion."""

    def __init__(self, compiled: CompiledWorld) -> None:
        silence_log()
        self.compiled = compiled
        self._model = compiled.model
        self._data = mujoco.MjData(compiled.model)
        self._rest = SleepPolicy(compiled, self._data)
        self.reader = StateReader(compiled, self._data)
        self.motors = Motors(compiled, self._data, self._rest.wake)
        self._laws = ContactLaws(compiled, self._data)
        self.motors.keep_on = self._laws.acts
        self._looker = ScratchEngine(compiled)
        self._feeling = ContactQuery(compiled, self._data, self._looker)
        self._warnings = [self._data.warning[kind] for kind in _BAD]
        self._good = np.empty(mujoco.mj_stateSize(self._model, STATE))
        self._taken = 0
        """Steps, from which follows when to decide who may sleep."""
        self._leapt = True
        """Whether anything was put somewhere, and may be inside something else now."""
        self._touches = np.isin(np.arange(self._model.ntree), self._model.body_treeid[self._model.geom_bodyid]).tolist()
        """Of each tree, whether it has shapes at all."""
        self.reset()

    def reset(self) -> None:
        """Go back to where the world starts, at rest, with every motor off."""
        self._rest.allow(False)
        mujoco.mj_resetData(self._model, self._data)
        if self.compiled.start is not None:
            self._data.qpos[:] = self.compiled.start
        self._taken = 0
        self._leapt = True
        self.motors.switch_off()
        self.reader.changed()

    def step(self, count: int) -> None:
        """Advance so many time steps; other threads run meanwhile.

        Raises:
            SimulationUnstableError: naming the link that ran away; the state is the one before this call.
        """
        mujoco.mj_getState(self._model, self._data, self._good, STATE)
        if self._leapt:
            self._look_for_depth()
        if self._laws.acts:
            self._laws.install()
        efforts, taken = self._data.qfrc_actuator.copy(), self._taken
        self._advance(count)
        self._laws.look_ahead()
        self.reader.changed()
        if self._is_unstable():
            self._go_back(efforts, taken)
            runaway = self._find_runaway(count)
            self._go_back(efforts, taken)
            raise SimulationUnstableError(runaway)

    def _advance(self, count: int) -> None:
        """In C, up to each step at which it is decided who may sleep."""
        while count > 0 and not self._is_unstable():
            some = min(count, EVERY - self._taken % EVERY)
            self._rest.step(some)
            self.motors.report()
            self._taken += some
            count -= some
            if self._taken % EVERY == 0 and not self._laws.is_watched and not self._is_unstable():
                self._rest.decide()

    def _is_unstable(self) -> bool:
        for warning in self._warnings:
            if warning.number > 0:
                return True
        speeds = self._data.qvel
        # One sum says of most worlds that no speed is too large, in a tenth of the time.
        return not speeds.dot(speeds) < FASTEST**2 and not bool((np.abs(speeds) < FASTEST).all())

    def _look_for_depth(self) -> None:
        self._leapt = False
        apart = self._looker.separated(self._state())
        if apart is not None:
            self._data.qpos[:] = apart

    def _watch(self) -> None:
        """Wake everybody while a law acts on what might sleep."""
        self.motors.keep_on = self._laws.acts
        if self._laws.is_watched:
            self._rest.forbid()

    def _go_back(self, efforts: NDArray[np.float64], taken: int) -> None:
        self._rest.put(self._good, efforts)
        self._taken = taken
        self.reader.changed()

    def _find_runaway(self, count: int) -> Divergence:
        """Take the same steps again, one by one, up to the bad one; afterwards nothing is to be seen."""
        time_s, speeds = self._data.time, np.abs(self._data.qvel)
        for _ in range(count):
            time_s, speeds = self._data.time, np.abs(self._data.qvel)
            self._advance(1)
            if self._is_unstable():
                break
        return find_divergence(self.compiled, self._data, speeds, time_s)

    # -- writing

    def set_time(self, time_s: float) -> None:
        """Say what time it is; nothing but messages depends on it."""
        self._data.time = time_s

    def set_wrench(self, link: int, wrench: Wrench) -> None:
        """Hold a force [N] at the link's centre of mass and a torque [N·m], world axes, until set anew."""
        self._data.xfrc_applied[self.compiled.link_bodies[link]] = [*wrench.force, *wrench.torque]

    def wrench(self, link: int) -> Wrench:
        """What `set_wrench` holds."""
        fx, fy, fz, tx, ty, tz = self._data.xfrc_applied[self.compiled.link_bodies[link]].tolist()
        return Wrench((fx, fy, fz), (tx, ty, tz))

    def set_grips(self, grips: "Mapping[int, LinkGrip]") -> None:
        """Have the surfaces of these links, by index, move and slip from now on; all others are ordinary."""
        self._laws.set_grips({int(self.compiled.link_bodies[link]): grip for link, grip in grips.items()})
        self._watch()

    def set_axis_position(self, axis: int, position: float) -> None:
        """Put an axis to a position [rad or m], at rest."""
        self._data.qpos[self.compiled.axis_qpos[axis]] = position
        self._data.qvel[self.compiled.axis_dof[axis]] = 0.0
        self._rest.wake(int(self.compiled.axis_dof[axis]))
        self.reader.changed()

    def set_axis_velocity(self, axis: int, velocity: float) -> None:
        """Set the speed of an axis [rad/s or m/s] at once; nothing keeps it."""
        self._data.qvel[self.compiled.axis_dof[axis]] = velocity
        self.reader.changed()

    def set_tree_pose(self, link: int, pose: Pose) -> None:
        """Put a link that hangs from nothing somewhere else, with all that hangs from it; speeds stay in the world.

        Raises:
            UsageError: it hangs from a joint or the world.
        """
        joint = self._free_joint(link)
        first = int(self._model.jnt_qposadr[joint])
        dof = int(self._model.jnt_dofadr[joint])
        turned = pose.quaternion
        spin = np.empty(3)
        mujoco.mju_rotVecQuat(spin, self._data.qvel[dof + 3 : dof + 6], self._data.qpos[first + 3 : first + 7])
        self._data.qpos[first : first + 7] = (*pose.position, *turned)
        wx, wy, wz = spin.tolist()
        self._data.qvel[dof + 3 : dof + 6] = Pose(quaternion=turned).inverse().direction((wx, wy, wz))
        self._leapt |= self._touches[self._model.dof_treeid[dof]]
        self._rest.wake(dof)
        self.reader.changed()

    def set_tree_twist(self, link: int, twist: Twist) -> None:
        """Give a link that hangs from nothing a velocity of its frame's origin and a spin, world axes.

        Raises:
            UsageError: it hangs from a joint or the world.
        """
        joint = self._free_joint(link)
        first, dof = int(self._model.jnt_qposadr[joint]), int(self._model.jnt_dofadr[joint])
        w, x, y, z = self._data.qpos[first + 3 : first + 7].tolist()
        self._data.qvel[dof : dof + 3] = twist.linear
        self._data.qvel[dof + 3 : dof + 6] = Pose(quaternion=(w, x, y, z)).inverse().direction(twist.angular)
        self._rest.wake(dof)
        self.reader.changed()

    def is_free(self, link: int) -> bool:
        """Whether a link hangs from nothing."""
        first = int(self._model.body_jntadr[self.compiled.link_bodies[link]])
        return first >= 0 and self._model.jnt_type[first] == mujoco.mjtJoint.mjJNT_FREE

    def _free_joint(self, link: int) -> int:
        if not self.is_free(link):
            name = self.compiled.link_names[link]
            raise UsageError(f"link {name!r} cannot be put elsewhere: it hangs from a joint or from the world")
        return int(self._model.body_jntadr[self.compiled.link_bodies[link]])

    def instant(self) -> EngineSnapshot:
        """The state as it is now, for good."""
        return EngineSnapshot(self._looker, self.reader)

    @property
    def asleep(self) -> int:
        """How many groups of links that hang together are at rest and left out of the steps."""
        return self._rest.asleep

    def contacts(self, among: frozenset[str] | None = None) -> list[Contact]:
        """What touches what.

        Args:
            among: names of collisions that something touches; None: of all.
        """
        if self._rest.is_blank and self._taken:
            return self._feeling.contacts_beside(among, self._state())
        return self._feeling.contacts(among, self._state if self.asleep else None)

    def reactions(self) -> NDArray[np.float64]:
        """(links, 6) force [N] and torque [N·m] on each link by what it hangs from; see `ScratchEngine.reactions`."""
        return self._looker.reactions(self._state())

    def _state(self) -> NDArray[np.float64]:
        state = np.empty_like(self._good)
        mujoco.mj_getState(self._model, self._data, state, STATE)
        return state

    # -- keeping

    def take_over(self, old: "Engine", *, renamed: Mapping[str, str] | None = None) -> None:
        """Go on from where another engine is, with what is in both by the same name.

        Args:
            old: the other.
            renamed: models that were called otherwise there, old name to new one.
        """
        carry_over((old._model, old._data), (self._model, self._data), renamed or {})
        self._taken = old._taken
        self._leapt = True
        self.motors.forget()
        self.reader.changed()

    def save(self) -> EngineState:
        """Everything that decides how the world goes on."""
        return EngineState(
            self.compiled,
            copy.copy(self._data),
            self._taken,
            self._rest.is_on,
            self._rest.is_blank,
            self._leapt,
            MotorOrders.of(self._model),
        )

    def restore(self, state: EngineState) -> None:
        """Go back to a saved state, exactly.

        Raises:
            UsageError: the state is of another set of models.
        """
        if state.compiled is not self.compiled:
            raise UsageError("models came or went since this state was saved; it cannot be restored")
        self._rest.allow(state.sleeps)
        mujoco.mj_copyData(self._data, self._model, state.data)
        self._taken, self._rest.is_blank = state.taken, state.is_blank
        self._leapt = state.leapt
        self.motors.keep_on = self._laws.acts
        state.motors.put(self._model)
        self.motors.forget()
        self.reader.changed()
