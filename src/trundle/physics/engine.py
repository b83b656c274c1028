"""Steps a compiled world in C, and reads and writes its state.

Nothing here runs in Python at every step: `step(n)` is one call, and the state is read when somebody asks.
"""

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import TrundleError, UsageError
from trundle.spatial import Pose, Twist, Wrench

from .between import Between
from .index import CompiledWorld
from .instant import Instant, Looker
from .motors import Motors
from .postmortem import Runaway, find_runaway
from .reader import StateReader
from .settings import silence_log
from .touching import Contact, contacts_of

_BAD = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
FASTEST = 1e6
"""[m/s or rad/s] Nothing that a file means moves faster; MuJoCo itself takes offence at 1e10."""


class SimulationUnstableError(TrundleError):
    """The physics blew up; the engine holds the last good state."""

    def __init__(self, runaway: Runaway) -> None:
        super().__init__(
            f"the physics became unstable {runaway}; "
            f"a smaller <max_step_size> or more plausible masses and inertias may help"
        )
        self.runaway = runaway


@dataclass(frozen=True, slots=True, eq=False)
class EngineState:
    """Everything that decides how the world goes on, and nothing else."""

    numbers: NDArray[np.float64]
    efforts: NDArray[np.float64]
    """What the motors exerted in the last step, for who reads them next."""
    gains: NDArray[np.float64]
    biases: NDArray[np.float64]
    ranges: NDArray[np.float64]


class Engine:
    """A compiled world in motion."""

    def __init__(self, compiled: CompiledWorld) -> None:
        silence_log()
        self.compiled = compiled
        self._model = compiled.model
        self._data = mujoco.MjData(compiled.model)
        self.reader = StateReader(compiled, self._data)
        self.motors = Motors(compiled, self._data)
        self._between = Between(compiled, self._data)
        self._looker = Looker(compiled)
        self._spec = mujoco.mjtState.mjSTATE_INTEGRATION
        self._good = np.empty(mujoco.mj_stateSize(self._model, self._spec))
        self.reset()

    def reset(self) -> None:
        """Go back to the world as compiled, at rest, with every motor off."""
        mujoco.mj_resetData(self._model, self._data)
        self.motors.switch_off()
        self.reader.changed()

    def step(self, count: int) -> None:
        """Advance so many time steps; other threads run meanwhile.

        Raises:
            SimulationUnstableError: naming the link that ran away; the state is the one before this call.
        """
        mujoco.mj_getState(self._model, self._data, self._good, self._spec)
        efforts = self._data.qfrc_actuator.copy()
        self._advance(count)
        self.reader.changed()
        if self._is_unstable():
            runaway = self._find_runaway(count)
            self._go_back(efforts)
            raise SimulationUnstableError(runaway)

    def _advance(self, count: int) -> None:
        """In C, unless the world needs something that MuJoCo does not have."""
        if self._between:
            for _ in range(count):
                self._between.step()
        else:
            mujoco.mj_step(self._model, self._data, nstep=count)

    def _is_unstable(self) -> bool:
        warnings = self._data.warning
        if any(warnings[kind].number > 0 for kind in _BAD):
            return True
        speeds = self._data.qvel
        return bool(speeds.size) and not max(float(speeds.max()), -float(speeds.min())) < FASTEST

    def _go_back(self, efforts: NDArray[np.float64]) -> None:
        for warning in self._data.warning:
            warning.number = 0
        mujoco.mj_setState(self._model, self._data, self._good, self._spec)
        self._data.qfrc_actuator[:] = efforts
        self.reader.changed()

    def _find_runaway(self, count: int) -> Runaway:
        """Take the same steps again, one by one, up to the bad one; afterwards nothing is to be seen."""
        self._go_back(self._data.qfrc_actuator)
        time_s, speeds = self._data.time, np.abs(self._data.qvel)
        for _ in range(count):
            time_s, speeds = self._data.time, np.abs(self._data.qvel)
            self._advance(1)
            if self._is_unstable():
                break
        return find_runaway(self.compiled, self._data, speeds, time_s)

    # -- writing

    def set_wrench(self, link: int, wrench: Wrench) -> None:
        """Hold a force [N] at the link's centre of mass and a torque [N·m], world axes, until set anew."""
        self._data.xfrc_applied[self.compiled.link_bodies[link]] = [*wrench.force, *wrench.torque]

    def set_axis_position(self, axis: int, position: float) -> None:
        """Put an axis to a position [rad or m], at rest."""
        self._data.qpos[self.compiled.axis_qpos[axis]] = position
        self._data.qvel[self.compiled.axis_dof[axis]] = 0.0
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

    def instant(self) -> Instant:
        """The state as it is now, for good."""
        return Instant(self._looker, self.reader)

    def contacts(self) -> list[Contact]:
        """What touched what in the last step."""
        return contacts_of(self.compiled, self._data)

    # -- keeping

    def save(self) -> EngineState:
        """Everything that decides how the world goes on."""
        numbers = np.empty_like(self._good)
        mujoco.mj_getState(self._model, self._data, numbers, self._spec)
        model = self._model
        return EngineState(
            numbers,
            self._data.qfrc_actuator.copy(),
            model.actuator_gainprm.copy(),
            model.actuator_biasprm.copy(),
            model.actuator_forcerange.copy(),
        )

    def restore(self, state: EngineState) -> None:
        """Go back to a saved state, exactly."""
        mujoco.mj_setState(self._model, self._data, state.numbers, self._spec)
        self._data.qfrc_actuator[:] = state.efforts
        self._model.actuator_gainprm[:] = state.gains
        self._model.actuator_biasprm[:] = state.biases
        self._model.actuator_forcerange[:] = state.ranges
        self.reader.changed()
