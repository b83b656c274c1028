"""Steps a compiled world in C, and reads and writes its state.

Nothing here runs in Python at every step: `step(n)` is one call, and the state is read when somebody asks.
"""

import math
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import TrundleError
from trundle.spatial import Vector3, Wrench

from .compile import CompiledWorld
from .settings import silence_log

HOLD_RATE = 3.0
"""[1/s] How fast a held joint closes in: a first-order lag of a third of a second, as its motor's torque allows."""


MOTOR_STIFFNESS = 10.0
"""1 would stop a joint by itself in one step, and droops under the robot's weight: a turn of 2.44 rad came out as 2.13.
10 gives 2.41; 100 gives 2.44 and chatters where the effort limit is met (measured on the RP2W at 1 ms)."""
_BAD = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
_HUGE = 1e10
"""MuJoCo's mjMAXVAL: what is larger, it calls unstable."""


class SimulationUnstableError(TrundleError):
    """The physics blew up; the engine holds the last good state."""


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
        self._roots = self._model.body_rootid[compiled.link_bodies]
        self._moves = compiled.joint_qpos >= 0
        self._spec = mujoco.mjtState.mjSTATE_INTEGRATION
        self._fresh = False
        self._good = np.empty(mujoco.mj_stateSize(self._model, self._spec))
        self.reset()

    def reset(self) -> None:
        """Go back to the world as compiled, at rest, with every motor off."""
        mujoco.mj_resetData(self._model, self._data)
        self._model.actuator_gainprm[:] = 0
        self._model.actuator_biasprm[:] = 0
        self._fresh = False

    def step(self, count: int) -> None:
        """Advance so many time steps; other threads run meanwhile.

        Raises:
            SimulationUnstableError: naming the link that ran away; the state is the one before this call.
        """
        mujoco.mj_getState(self._model, self._data, self._good, self._spec)
        efforts = self._data.qfrc_actuator.copy()
        mujoco.mj_step(self._model, self._data, nstep=count)
        self._fresh = False
        if self._is_unstable():
            name, time_s = self._find_runaway(count)
            self._go_back(efforts)
            raise SimulationUnstableError(
                f"the physics became unstable after {time_s:.3f} s: {name!r} ran away; "
                f"a smaller <max_step_size> or more plausible masses and inertias may help"
            )

    def _is_unstable(self) -> bool:
        warnings = self._data.warning
        return any(warnings[kind].number > 0 for kind in _BAD)

    def _go_back(self, efforts: NDArray[np.float64]) -> None:
        for warning in self._data.warning:
            warning.number = 0
        mujoco.mj_setState(self._model, self._data, self._good, self._spec)
        self._data.qfrc_actuator[:] = efforts
        self._fresh = False

    def _find_runaway(self, count: int) -> tuple[str, float]:
        """Take the same steps again, one by one, up to the bad one: which link began it, and when [s].

        Afterwards nothing is to be seen: the solver spreads one link's NaN over the world. So it is the link that is
        pushed by no number, or whose accelerations are huge before the solver sees them, or that is the fastest.
        """
        self._go_back(self._data.qfrc_actuator)
        time_s, speeds = self._data.time, np.abs(self._data.qvel)
        for _ in range(count):
            time_s, speeds = self._data.time, np.abs(self._data.qvel)
            mujoco.mj_step(self._model, self._data)
            if self._is_unstable():
                break
        pushed = np.flatnonzero(~np.isfinite(self._data.xfrc_applied).all(axis=1))
        if pushed.size:
            return self._model.body(int(pushed[0])).name, time_s
        accelerations = np.nan_to_num(np.abs(self._data.qacc_smooth), nan=np.inf)
        worst = int(np.argmax(accelerations if accelerations.max() > _HUGE else speeds))
        return self._model.body(int(self._model.dof_bodyid[worst])).name, time_s

    # -- reading

    def _refresh(self) -> None:
        """Bring poses and velocities up to the state; what a step computes belongs to where it started.

        Nothing that decides the next step is touched, so looking never changes the outcome.
        """
        if not self._fresh:
            mujoco.mj_kinematics(self._model, self._data)
            mujoco.mj_comPos(self._model, self._data)
            mujoco.mj_comVel(self._model, self._data)
            self._fresh = True

    def link_poses(self) -> NDArray[np.float64]:
        """(links, 7) x y z qw qx qy qz of the link frames in the world [m]."""
        self._refresh()
        bodies = self.compiled.link_bodies
        return np.concatenate([self._data.xpos[bodies], self._data.xquat[bodies]], axis=1)

    def link_twists(self) -> NDArray[np.float64]:
        """(links, 6) velocity of the link frame's origin [m/s] and angular velocity [rad/s], world axes."""
        self._refresh()
        bodies = self.compiled.link_bodies
        cvel = self._data.cvel[bodies]
        wx, wy, wz = cvel[:, 0], cvel[:, 1], cvel[:, 2]
        # cvel is taken at the tree's centre of mass. The cross product is written out: np.cross costs five times more.
        x, y, z = (self._data.xpos[bodies] - self._data.subtree_com[self._roots]).T
        twists = np.empty_like(cvel)
        twists[:, 0] = cvel[:, 3] + wy * z - wz * y
        twists[:, 1] = cvel[:, 4] + wz * x - wx * z
        twists[:, 2] = cvel[:, 5] + wx * y - wy * x
        twists[:, 3:] = cvel[:, :3]
        return twists

    def joint_positions(self) -> NDArray[np.float64]:
        """(joints,) [rad or m]; joints without one axis of freedom read 0."""
        return self._of_joints(self._data.qpos, self.compiled.joint_qpos)

    def joint_velocities(self) -> NDArray[np.float64]:
        """(joints,) [rad/s or m/s]"""
        return self._of_joints(self._data.qvel, self.compiled.joint_dof)

    def joint_efforts(self) -> NDArray[np.float64]:
        """(joints,) what motors and applied efforts exert [N·m or N]."""
        return self._of_joints(self._data.qfrc_applied + self._data.qfrc_actuator, self.compiled.joint_dof)

    def _of_joints(self, values: NDArray[np.float64], places: NDArray[np.intp]) -> NDArray[np.float64]:
        """Each joint's number out of the engine's; the world may have none at all."""
        found = np.zeros(len(places))
        found[self._moves] = values[places[self._moves]]
        return found

    # -- writing

    def set_wrench(self, link: int, wrench: Wrench) -> None:
        """Hold a force [N] at the link's centre of mass and a torque [N·m], world axes, until set anew."""
        self._data.xfrc_applied[self.compiled.link_bodies[link]] = [*wrench.force, *wrench.torque]

    def set_effort(self, joint: int, effort: float) -> None:
        """Hold an effort [N·m or N] on a joint and switch its motor off."""
        self._motor(joint, gain=0.0, position=0.0, velocity=0.0, limit=1.0)
        self._data.qfrc_applied[self.compiled.joint_dof[joint]] = effort

    def set_velocity(self, joint: int, velocity: float, max_effort: float) -> None:
        """Have a joint's motor keep a speed [rad/s or m/s] with at most so much effort."""
        gain = self._motor_gain(joint)
        self._motor(joint, gain=gain, position=0.0, velocity=gain, limit=max_effort)
        self._data.ctrl[self.compiled.joint_actuators[joint]] = velocity

    def hold(self, joint: int, position: float, max_effort: float) -> None:
        """Have a joint's motor go to a position [rad or m] and stay there."""
        damping = self._motor_gain(joint)
        gain = HOLD_RATE * damping
        self._motor(joint, gain=gain, position=gain, velocity=damping, limit=max_effort)
        self._data.ctrl[self.compiled.joint_actuators[joint]] = position

    def _motor_gain(self, joint: int) -> float:
        """Effort per error of speed, by what the motor has to move with every joint at zero."""
        inertia = float(self._model.dof_M0[self.compiled.joint_dof[joint]])
        return MOTOR_STIFFNESS * inertia / self._model.opt.timestep

    def _motor(self, joint: int, *, gain: float, position: float, velocity: float, limit: float) -> None:
        """force = gain · command − position · q − velocity · q̇, within ±limit."""
        self._data.qfrc_applied[self.compiled.joint_dof[joint]] = 0.0
        actuator = self.compiled.joint_actuators[joint]
        self._model.actuator_gainprm[actuator, 0] = gain
        self._model.actuator_biasprm[actuator, 1:3] = (-position, -velocity)
        limit = min(limit, 1e10) if math.isfinite(limit) else 1e10
        self._model.actuator_forcerange[actuator] = (-limit, limit)

    def set_joint_position(self, joint: int, position: float) -> None:
        """Put a joint to a position [rad or m], at rest."""
        self._data.qpos[self.compiled.joint_qpos[joint]] = position
        self._data.qvel[self.compiled.joint_dof[joint]] = 0.0
        self._fresh = False

    def center_of_mass(self, link: int) -> Vector3:
        """Where a link's centre of mass is in the world [m]."""
        self._refresh()
        x, y, z = self._data.xipos[self.compiled.link_bodies[link]].tolist()
        return (x, y, z)

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
        self._fresh = False
