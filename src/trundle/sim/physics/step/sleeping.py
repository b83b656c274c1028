"""Sleeping of resting trees, if it saves time.

MuJoCo skips trees that have not moved for ten steps and wakes them on contact or force. For that it computes contact
islands, which costs an awake world a tenth to a third of its speed. So sleeping is enabled or disabled periodically, at
steps that depend on their count only. A world that sleeps as a whole is not stepped.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld

DECISION_PERIOD = 512
"""Steps between two decisions."""
TOLERANCE = 1e-6
"""Speed [m/s or rad/s] below which a tree is at rest; MuJoCo's default 1e-3 would freeze a body that begins
to slide.
"""
_WAKING_SPEED = 1e-200
"""Speed [m/s or rad/s] that wakes a tree without moving it."""
STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_NEVER = int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER)
_SLEEP = int(mujoco.mjtEnableBit.mjENBL_SLEEP)
_NO_ISLANDS = int(mujoco.mjtDisableBit.mjDSBL_ISLAND)


class SleepPolicy:
    """Enables sleeping and wakes trees."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._model = compiled.model
        self._data = data
        model = compiled.model
        self._trees = model.dof_treeid.copy()
        self.has_state_only = True
        """True if the data holds only a state, without results of a step such as contacts."""
        model.opt.sleep_tolerance = TOLERANCE
        # MuJoCo scales angular speeds by the size of the moved shapes, which is zero for a link without shapes.
        model.dof_length[:] = 1.0
        model.tree_sleep_policy[:] = int(mujoco.mjtSleepPolicy.mjSLEEP_ALLOWED)
        # One link that must not sleep keeps its whole tree awake.
        allows = [model.allow_auto_disable for model in compiled.world.models for _ in model.links]
        for body, allow in zip(compiled.link_bodies, allows, strict=True):
            tree = int(model.body_treeid[body])
            if tree >= 0 and not allow:
                model.tree_sleep_policy[tree] = _NEVER

    @property
    def is_on(self) -> bool:
        """True if sleeping is enabled."""
        return bool(self._model.opt.enableflags & _SLEEP)

    @property
    def asleep(self) -> int:
        """Number of sleeping trees."""
        return int(np.count_nonzero(self._data.tree_asleep >= 0)) if self.is_on else 0

    def step(self, count: int) -> bool:
        """Step `count` times; while all trees sleep only the clock advances.

        Returns:
            True if all trees kept sleeping; their motors' efforts stay.
        """
        model, data = self._model, self._data
        self.has_state_only = False
        if count > 1 and self._all_sleep():
            efforts = data.qfrc_actuator.copy()
            mujoco.mj_step(model, data)  # trees with new commands wake
            count -= 1
            if self._all_sleep():
                times = np.empty(count + 1)
                times[0], times[1:] = data.time, model.opt.timestep
                data.time = np.add.accumulate(times)[-1]  # one by one, as in MuJoCo: equal to the bit
                data.qfrc_actuator[:] = efforts
                return True
        mujoco.mj_step(model, data, nstep=count)
        return False

    def _all_sleep(self) -> bool:
        return self.is_on and int(self._data.tree_asleep.min()) >= 0

    def update(self) -> None:
        """Enable sleeping if resting trees that may sleep have at least half of the degrees of freedom."""
        if self._all_sleep():
            return
        moving = self._model.tree_sleep_policy == _NEVER
        moving[self._trees[np.abs(self._data.qvel) >= TOLERANCE]] = True
        still = np.count_nonzero(~moving[self._trees])
        enables = self._model.nv > 0 and 2 * still >= self._model.nv
        if enables != self.is_on:
            self._switch(enables)

    def disable(self) -> None:
        """Wake all trees and disable sleeping."""
        if self.is_on:
            self._switch(False)

    def _switch(self, sleep: bool) -> None:
        state = np.empty(mujoco.mj_stateSize(self._model, STATE))
        mujoco.mj_getState(self._model, self._data, state, STATE)
        self.set_flags(sleep)
        self.set_state(state, self._data.qfrc_actuator.copy())

    def set_state(self, state: NDArray[np.float64], efforts: NDArray[np.float64]) -> None:
        """Set the engine's state with all trees awake; only a reset clears the sleeping ones."""
        mujoco.mj_resetData(self._model, self._data)
        mujoco.mj_setState(self._model, self._data, state, STATE)
        self._data.qfrc_actuator[:] = efforts
        self.has_state_only = True

    def set_flags(self, sleep: bool) -> None:
        """Set the engine's flags; the data must be reset or replaced with them."""
        option = self._model.opt
        option.enableflags = option.enableflags | _SLEEP if sleep else option.enableflags & ~_SLEEP
        option.disableflags = option.disableflags & ~_NO_ISLANDS if sleep else option.disableflags | _NO_ISLANDS

    def wake(self, dof: int) -> None:
        """Wake the tree of a degree of freedom after a command."""
        _contact_laws.wake_tree(self._model._address, self._data._address, dof)
