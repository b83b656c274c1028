"""Immutable snapshots of the engine's state, evaluated on demand."""

import copy
from collections.abc import Generator
from contextlib import contextmanager
from functools import cached_property
from threading import Lock

import mujoco
import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from .. import _contact_laws
from ..compile.compiled_world import CompiledWorld
from ..compile.law_tables import copy_friction_laws
from .contact import Contacts, contacts_of
from .motors import copy_commands
from .separation import find_deep, separate
from .state_reader import StateReader

_Array = NDArray[np.float64]


class ScratchEngine:
    """Evaluates a saved state on a second MjData with sleeping off; thread-safe."""

    def __init__(self, compiled: CompiledWorld) -> None:
        self._compiled = compiled
        self._lock = Lock()

    @cached_property
    def _engine(self) -> tuple[mujoco.MjModel, mujoco.MjData, StateReader]:
        """Second engine, created on first use."""
        model = copy.copy(self._compiled.model)
        model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_ISLAND)
        copy_friction_laws(model, self._compiled.model)
        data = mujoco.MjData(model)
        return model, data, StateReader(replace(self._compiled, model=model), data)

    def poses(self, qpos: _Array, qvel: _Array) -> _Array:
        """Return `StateReader.link_poses` of a state."""
        with self._lock:
            _, _, reader = self._engine
            reader.set_state(qpos, qvel)
            return reader.link_poses()

    def twists(self, qpos: _Array, qvel: _Array) -> _Array:
        """Return `StateReader.link_twists` of a state."""
        with self._lock:
            _, _, reader = self._engine
            reader.set_state(qpos, qvel)
            return reader.link_twists()

    def contacts(self, state: _Array, excluded: NDArray[np.bool_]) -> Contacts:
        """Return the contacts of a state (mjSTATE_INTEGRATION), without contacts of the geoms masked by `excluded`."""
        with self._lock:
            model, data = self._solve(state)
            chosen = np.flatnonzero(~excluded[data.contact.geom].any(axis=1))
            return contacts_of(self._compiled, model, data, chosen)

    def overlaps(self, state: _Array, depth: float) -> frozenset[tuple[str, str]]:
        """Return the names of the pairs of collisions that penetrate by more than a depth [m] in a state."""
        with self._lock:
            _, data = self._set_state(state)
            names, deep = self._compiled.geom_collisions, data.contact.geom[data.contact.dist < -depth]
            return frozenset((names[first], names[second]) for first, second in deep.tolist())

    @contextmanager
    def evaluate(self) -> Generator[tuple[mujoco.MjModel, mujoco.MjData]]:
        """Lock the second engine's model and data, for the evaluation of a state written to them."""
        with self._lock:
            model, data, reader = self._engine
            try:
                yield model, data
            finally:
                reader.invalidate()

    def separated(self, state: _Array) -> _Array | None:
        """Return qpos with initial penetrations resolved; None if there are none.

        Args:
            state: mjSTATE_INTEGRATION.
        """
        with self._lock:
            model, data = self._set_state(state)
            return separate(model, data) if find_deep(model, data).any() else None

    def _set_state(self, state: _Array) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """Load a state and compute its contacts."""
        model, data, reader = self._engine
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_fwdPosition(model, data)
        reader.invalidate()
        return model, data

    def reactions(self, state: _Array) -> _Array:
        """Return (links, 6) force [N] and torque [N·m] on each link by its parent, at its frame's origin, world axes.

        Args:
            state: mjSTATE_INTEGRATION.
        """
        with self._lock:
            model, data = self._solve(state)
            mujoco.mj_rnePostConstraint(model, data)
            bodies = self._compiled.link_bodies
            torques, forces = data.cfrc_int[bodies, :3], data.cfrc_int[bodies, 3:]
            # MuJoCo's reference point is the centre of mass of the whole tree.
            arms = data.subtree_com[model.body_rootid[bodies]] - data.xpos[bodies]
            return np.concatenate([forces, torques + np.cross(arms, forces)], axis=1)

    def efforts(self, state: _Array) -> _Array:
        """Return (nv,) efforts of motors in a state, sleeping ones too [N·m or N].

        Args:
            state: mjSTATE_INTEGRATION.
        """
        with self._lock:
            model, data = self._solve(state)
            _contact_laws.report_efforts(model._address, data._address)
            return data.qfrc_actuator.copy()

    def _solve(self, state: _Array) -> tuple[mujoco.MjModel, mujoco.MjData]:
        model, data, reader = self._engine
        copy_friction_laws(model, self._compiled.model)
        copy_commands(self._compiled.model, model)
        model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_forward(model, data)
        reader.invalidate()
        return model, data


class EngineSnapshot:
    """Immutable engine state; poses, the most expensive part, are computed on demand."""

    def __init__(self, scratch: ScratchEngine, reader: StateReader) -> None:
        """Copy the reader's current state."""
        self._scratch = scratch
        self._reader = reader
        self._qpos, self._qvel = reader.state()
        self._efforts = reader.efforts()

    @cached_property
    def axis_positions(self) -> _Array:
        """(axes,) positions [rad or m]; a ball joint's three are its rotation vector."""
        return self._reader.axis_positions(self._qpos)

    @cached_property
    def axis_velocities(self) -> _Array:
        """(axes,) velocities [rad/s or m/s]."""
        return self._reader.by_axis(self._qvel)

    @cached_property
    def axis_efforts(self) -> _Array:
        """(axes,) efforts [N·m or N]."""
        return self._reader.by_axis(self._efforts)

    @cached_property
    def poses(self) -> _Array:
        """(links, 7) poses of the link frames; see `StateReader.link_poses`."""
        return self._scratch.poses(self._qpos, self._qvel)

    @cached_property
    def twists(self) -> _Array:
        """(links, 6) twists of the link frames; see `StateReader.link_twists`."""
        return self._scratch.twists(self._qpos, self._qvel)
