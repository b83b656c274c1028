"""Lets what is at rest sleep, where that is faster.

MuJoCo leaves trees of bodies out that have not moved for ten steps, and wakes them when something touches or pushes
them. It has to find the islands of what touches what for that, which costs an awake world a tenth to a third of its
speed. So whether trees may sleep is decided anew every now and then, at steps that depend on nothing but their number.
A world that sleeps as a whole is not stepped at all.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from ..compile.compiled_world import CompiledWorld

DECISION_PERIOD = 512
"""Steps from one decision to the next."""
TOLERANCE = 1e-6
"""[m/s or rad/s] What moves slower is at rest. With MuJoCo's own 1e-3 what just begins to slide would freeze."""
_WAKING_SPEED = 1e-200
"""[m/s or rad/s] A speed that wakes a tree and moves nothing."""
STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_SLEEP = int(mujoco.mjtEnableBit.mjENBL_SLEEP)
_NO_ISLANDS = int(mujoco.mjtDisableBit.mjDSBL_ISLAND)


class SleepPolicy:
    """Decides whether trees may sleep, and wakes them."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._model = compiled.model
        self._data = data
        model = compiled.model
        self._trees = model.dof_treeid.copy()
        self.has_state_only = True
        """Whether the data holds a state alone, and nothing that a step worked out, such as contacts."""
        model.opt.sleep_tolerance = TOLERANCE
        # MuJoCo multiplies an angular speed by the size of the shapes it moves, which of a bare link is nothing at all.
        model.dof_length[:] = 1.0
        allowed, never = int(mujoco.mjtSleepPolicy.mjSLEEP_ALLOWED), int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER)
        model.tree_sleep_policy[:] = allowed
        # Of several links in one tree, the one that must not sleep decides.
        allows = [each.allow_auto_disable for each in compiled.world.models for _ in each.links]
        for body, allow in zip(compiled.link_bodies, allows, strict=True):
            tree = int(model.body_treeid[body])
            if tree >= 0 and not allow:
                model.tree_sleep_policy[tree] = never

    @property
    def is_on(self) -> bool:
        """Whether trees may sleep now."""
        return bool(self._model.opt.enableflags & _SLEEP)

    @property
    def asleep(self) -> int:
        """How many trees sleep at the moment."""
        return int(np.count_nonzero(self._data.tree_asleep >= 0)) if self.is_on else 0

    def step(self, count: int) -> None:
        """Take so many steps; as long as everybody sleeps, one is like the other, and only the clock goes on."""
        model, data = self._model, self._data
        self.has_state_only = False
        if count > 1 and self._all_sleep():
            mujoco.mj_step(model, data)  # who was told something since the last one wakes
            count -= 1
            if self._all_sleep():
                time_s, h = data.time, model.opt.timestep
                for _ in range(count):  # one by one, as MuJoCo adds them: to the same bits
                    time_s += h
                data.time = time_s
                return
        mujoco.mj_step(model, data, nstep=count)

    def _all_sleep(self) -> bool:
        return self.is_on and int(self._data.tree_asleep.min()) >= 0

    def update(self) -> None:
        """Let trees sleep if at least half of what can move hangs from what is wholly at rest."""
        moving = np.zeros(self._model.ntree, dtype=bool)
        moving[self._trees[np.abs(self._data.qvel) >= TOLERANCE]] = True
        still = np.count_nonzero(~moving[self._trees])
        wanted = self._model.nv > 0 and 2 * still >= self._model.nv
        if wanted != self.is_on:
            self._switch(wanted)

    def disable(self) -> None:
        """Wake everybody: from now on every step is watched."""
        if self.is_on:
            self._switch(False)

    def _switch(self, sleep: bool) -> None:
        state = np.empty(mujoco.mj_stateSize(self._model, STATE))
        mujoco.mj_getState(self._model, self._data, state, STATE)
        self.set_flags(sleep)
        self.set_state(state, self._data.qfrc_actuator.copy())

    def set_state(self, state: NDArray[np.float64], efforts: NDArray[np.float64]) -> None:
        """Set the engine's state, everybody awake: who sleeps is forgotten by a reset alone."""
        mujoco.mj_resetData(self._model, self._data)
        mujoco.mj_setState(self._model, self._data, state, STATE)
        self._data.qfrc_actuator[:] = efforts
        self.has_state_only = True

    def set_flags(self, sleep: bool) -> None:
        """Set the engine's flags; the data has to be reset or replaced with them."""
        option = self._model.opt
        option.enableflags = option.enableflags | _SLEEP if sleep else option.enableflags & ~_SLEEP
        option.disableflags = option.disableflags & ~_NO_ISLANDS if sleep else option.disableflags | _NO_ISLANDS

    def wake(self, dof: int) -> None:
        """Wake the tree of a degree of freedom, which has been told something."""
        if self.is_on and self._data.tree_asleep[self._model.dof_treeid[dof]] >= 0 and self._data.qvel[dof] == 0.0:
            self._data.qvel[dof] = _WAKING_SPEED
