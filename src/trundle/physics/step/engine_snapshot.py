"""The state of a world at one instant, worked out as far as somebody asks."""

import copy
from collections.abc import Generator
from contextlib import contextmanager
from functools import cached_property
from threading import Lock

import mujoco
import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from ..compile.compiled_world import CompiledWorld
from ..compile.law_tables import follow_friction
from .contact import Contact, contacts_of
from .motors import MotorCommands
from .separation import find_deep, separate
from .state_reader import StateReader

_Array = NDArray[np.float64]


class ScratchEngine:
    """Works things out beside the engine that goes on, with everybody awake; for any thread."""

    def __init__(self, compiled: CompiledWorld) -> None:
        self._compiled = compiled
        self._lock = Lock()

    @cached_property
    def _engine(self) -> tuple[mujoco.MjModel, mujoco.MjData, StateReader]:
        """Another engine, made when it is first needed."""
        model = copy.copy(self._compiled.model)
        model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_ISLAND)
        follow_friction(model, self._compiled.model)
        data = mujoco.MjData(model)
        return model, data, StateReader(replace(self._compiled, model=model), data)

    def poses(self, qpos: _Array, qvel: _Array) -> _Array:
        """`StateReader.link_poses` of a state."""
        with self._lock:
            _, _, reader = self._engine
            reader.set_state(qpos, qvel)
            return reader.link_poses()

    def twists(self, qpos: _Array, qvel: _Array) -> _Array:
        """`StateReader.link_twists` of a state."""
        with self._lock:
            _, _, reader = self._engine
            reader.set_state(qpos, qvel)
            return reader.link_twists()

    def contacts(self, state: _Array, apart: NDArray[np.bool_]) -> list[Contact]:
        """The contacts of a state, as mjSTATE_INTEGRATION has it, without those of geoms that are to be kept apart."""
        with self._lock:
            model, data = self._solve(state)
            chosen = np.flatnonzero(~apart[data.contact.geom].any(axis=1))
            return contacts_of(self._compiled, model, data, chosen)

    @contextmanager
    def evaluate(self) -> Generator[tuple[mujoco.MjModel, mujoco.MjData]]:
        """Have the other engine's model and data to oneself, to put a state there and work something out."""
        with self._lock:
            model, data, reader = self._engine
            try:
                yield model, data
            finally:
                reader.invalidate()

    def separated(self, state: _Array) -> _Array | None:
        """The positions in which nothing that began inside something else is so any more; None: nothing was.

        Args:
            state: as mjSTATE_INTEGRATION has it.
        """
        with self._lock:
            model, data = self._set_state(state)
            return separate(model, data) if find_deep(model, data).any() else None

    def _set_state(self, state: _Array) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """Put everything where a state has it, with the contacts there."""
        model, data, reader = self._engine
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_fwdPosition(model, data)
        reader.invalidate()
        return model, data

    def reactions(self, state: _Array) -> _Array:
        """(links, 6) force [N] and torque [N·m] on each link by what it hangs from, at its frame's origin, world axes.

        Args:
            state: as mjSTATE_INTEGRATION has it.
        """
        with self._lock:
            model, data = self._solve(state)
            mujoco.mj_rnePostConstraint(model, data)
            bodies = self._compiled.link_bodies
            torques, forces = data.cfrc_int[bodies, :3], data.cfrc_int[bodies, 3:]
            # MuJoCo takes it at the centre of mass of the whole tree.
            arms = data.subtree_com[model.body_rootid[bodies]] - data.xpos[bodies]
            return np.concatenate([forces, torques + np.cross(arms, forces)], axis=1)

    def _solve(self, state: _Array) -> tuple[mujoco.MjModel, mujoco.MjData]:
        model, data, reader = self._engine
        follow_friction(model, self._compiled.model)
        MotorCommands.from_model(self._compiled.model).apply(model)
        model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_forward(model, data)
        reader.invalidate()
        return model, data


class EngineSnapshot:
    """What the engine held; nothing in it changes any more. Poses cost most, so they wait until they are wanted."""

    def __init__(self, scratch: ScratchEngine, reader: StateReader) -> None:
        """Take what the reader has before it."""
        self._scratch = scratch
        self._reader = reader
        self._qpos, self._qvel = reader.state()
        self._efforts = reader.efforts()

    @cached_property
    def axis_positions(self) -> _Array:
        """(axes,) [rad or m]; a ball joint's three are its rotation vector."""
        return self._reader.axis_positions(self._qpos)

    @cached_property
    def axis_velocities(self) -> _Array:
        """(axes,) [rad/s or m/s]"""
        return self._reader.by_axis(self._qvel)

    @cached_property
    def axis_efforts(self) -> _Array:
        """(axes,) what drives them [N·m or N]"""
        return self._reader.by_axis(self._efforts)

    @cached_property
    def poses(self) -> _Array:
        """(links, 7) of the link frames; see `StateReader.link_poses`."""
        return self._scratch.poses(self._qpos, self._qvel)

    @cached_property
    def twists(self) -> _Array:
        """(links, 6) of the link frames; see `StateReader.link_twists`."""
        return self._scratch.twists(self._qpos, self._qvel)
