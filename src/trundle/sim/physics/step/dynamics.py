"""Jacobians, mass matrices and inverse dynamics of some of a world's degrees of freedom.

They are evaluated on a scratch copy of the engine's data. Generalized velocities are ordered: for each free link the
velocity of its frame's origin [m/s] and its angular velocity [rad/s], world axes; then the axes [rad/s or m/s].
Terms as in Featherstone, Rigid Body Dynamics Algorithms (2008): τ = M(q) a + h(q, v).
"""

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.spatial import Vector3

from ..compile.compiled_world import CompiledWorld
from .engine_snapshot import ScratchEngine
from .state_writer import StateWriter
from .velocities import Velocities

_Array = NDArray[np.float64]


class Coordinates(Struct, frozen=True):
    """Selected degrees of freedom, n = 6 per free link and one per axis."""

    free_links: tuple[int, ...]
    axes: range


class JointState(Struct, frozen=True, eq=False):
    """State of the whole world, with optional replacements."""

    qpos: _Array
    qvel: _Array
    axis_positions: _Array | None = None
    """Positions (axes,) [rad or m] that replace those of `qpos`."""
    velocities: _Array | None = None
    """Velocities (n,) that replace those of `qvel`."""


class Dynamics:
    """Equations of motion of one compiled world; thread-safe."""

    def __init__(self, compiled: CompiledWorld, scratch: ScratchEngine) -> None:
        self._compiled = compiled
        self._scratch = scratch

    def jacobian(self, state: JointState, of: Coordinates, *, link: int, point: Vector3) -> _Array:
        """Return the (6, n) Jacobian: velocity of a point of a link [m/s] over its angular velocity [rad/s], world
        axes.

        Args:
            state: state of the world.
            of: generalized velocities.
            link: index of the link.
            point: point in the link's frame [m].
        """
        with self._scratch.evaluate() as (model, data):
            basis = self._set_state(model, data, state, of)
            body = int(self._compiled.link_bodies[link])
            position = data.xpos[body] + data.xmat[body].reshape(3, 3) @ np.asarray(point, dtype=np.float64)
            linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))
            mujoco.mj_jac(model, data, linear, angular, position, body)
            return np.concatenate([linear, angular]) @ basis

    def mass_matrix(self, state: JointState, of: Coordinates) -> _Array:
        """Return the (n, n) mass matrix M(q): generalized force per generalized acceleration."""
        with self._scratch.evaluate() as (model, data):
            basis = self._set_state(model, data, state, of)
            mujoco.mj_makeM(model, data)
            momenta, velocities = np.zeros(basis.T.shape), np.ascontiguousarray(basis.T)
            for momentum, velocity in zip(momenta, velocities, strict=True):
                mujoco.mj_mulM(model, data, momentum, velocity)
            return velocities @ momenta.T

    def inverse_dynamics(self, state: JointState, of: Coordinates, accelerations: _Array) -> _Array:
        """Return the (n,) generalized forces for accelerations (n,) against inertia and gravity alone [N·m or N]."""
        with self._scratch.evaluate() as (model, data):
            basis = self._set_state(model, data, state, of)
            mujoco.mj_comVel(model, data)
            data.qacc[:] = basis @ accelerations
            forces = np.zeros(model.nv)
            mujoco.mj_rne(model, data, 1, forces)
            return basis.T @ forces

    def _set_state(self, model: mujoco.MjModel, data: mujoco.MjData, state: JointState, of: Coordinates) -> _Array:
        """Load a state into the scratch data; return the (nv, n) matrix from generalized to MuJoCo's velocities."""
        data.qpos[:] = state.qpos
        Velocities(model, data).set_velocities(state.qvel)
        if state.axis_positions is not None:
            writer = StateWriter(self._compiled, data, wake=lambda _: None, changed=lambda: None)
            writer.set_axis_positions(of.axes, state.axis_positions)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        basis = self._basis(model, data, of)
        if state.velocities is not None:
            others = ~basis.any(axis=1)
            data.qvel[:] = others * state.qvel + basis @ state.velocities
        return basis

    def _basis(self, model: mujoco.MjModel, data: mujoco.MjData, of: Coordinates) -> _Array:
        """Return the (nv, n) velocity map; MuJoCo's angular velocity of a free body is in the body's own axes."""
        basis = np.zeros((model.nv, 6 * len(of.free_links) + len(of.axes)))
        for i, link in enumerate(of.free_links):
            body = int(self._compiled.link_bodies[link])
            dof, column = int(model.body_dofadr[body]), 6 * i
            basis[dof : dof + 3, column : column + 3] = np.eye(3)
            basis[dof + 3 : dof + 6, column + 3 : column + 6] = data.xmat[body].reshape(3, 3).T
        for column, axis in enumerate(of.axes, 6 * len(of.free_links)):
            basis[self._compiled.axis_dof[axis], column] = self._compiled.axis_sign[axis]
        return basis
