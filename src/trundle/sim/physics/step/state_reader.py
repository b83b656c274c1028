"""Poses, velocities and efforts of links and joints, read from MuJoCo's arrays."""

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Vector3

from ..compile.compiled_world import CompiledWorld
from .velocities import Velocities


class StateReader:
    """Reader of one `MjData`; call `invalidate` after each change of it."""

    def __init__(self, compiled: CompiledWorld, data: mujoco.MjData) -> None:
        self._compiled = compiled
        self._model = compiled.model
        self._data = data
        self._velocities = Velocities(compiled.model, data)
        self._roots = self._model.body_rootid[compiled.link_bodies]
        self._balls = [(range(b, b + 3), int(compiled.axis_qpos[b])) for b in compiled.ball_joints]
        self._ball_starts = frozenset(compiled.ball_joints)
        self._qpos_addresses: list[int] = compiled.axis_qpos.tolist()
        self._dofs: list[int] = compiled.axis_dof.tolist()
        self._signs: list[float] = compiled.axis_sign.tolist()
        self._poses: NDArray[np.float64] | None = None
        self._twists: NDArray[np.float64] | None = None
        """Cached results for the current state."""

    def set_state(self, qpos: NDArray[np.float64], qvel: NDArray[np.float64]) -> None:
        """Set positions and velocities of the same time; time and forces stay."""
        self._data.qpos[:] = qpos
        self._velocities.set_velocities(qvel)
        self.invalidate()

    def state(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return copies of positions and velocities of the same time, as `set_state` takes them."""
        return self._data.qpos.copy(), self._velocities.read()

    def invalidate(self) -> None:
        """Clear the cache after a change of the state."""
        self._poses = self._twists = None

    def show_link_poses(self, poses: NDArray[np.float64]) -> None:
        """Replace the link poses with (links, 7) poses until `invalidate`; the state stays."""
        self._poses = poses

    def link_poses(self) -> NDArray[np.float64]:
        """Return (links, 7) x y z qw qx qy qz of the link frames in the world [m]; the same array until the state
        changes.

        MuJoCo's kinematics belong to the start of a step, so they are updated to the state. Nothing that affects the
        next step is written: reading never changes the simulation.
        """
        if self._poses is None:
            mujoco.mj_kinematics(self._model, self._data)
            bodies = self._compiled.link_bodies
            self._poses = np.concatenate([self._data.xpos[bodies], self._data.xquat[bodies]], axis=1)
        return self._poses

    def link_twists(self) -> NDArray[np.float64]:
        """Return (links, 6) velocity of the link frame's origin [m/s] and angular velocity [rad/s], world axes; the
        same array until the state changes.
        """
        if self._twists is None:
            self.link_poses()
            mujoco.mj_comPos(self._model, self._data)
            with self._velocities.shown():
                mujoco.mj_comVel(self._model, self._data)
            self._twists = self._read_twists()
        return self._twists

    def _read_twists(self) -> NDArray[np.float64]:
        bodies = self._compiled.link_bodies
        cvel = self._data.cvel[bodies]
        wx, wy, wz = cvel[:, 0], cvel[:, 1], cvel[:, 2]
        # cvel refers to the tree's centre of mass. The cross product is written out: np.cross costs five times more.
        x, y, z = (self._data.xpos[bodies] - self._data.subtree_com[self._roots]).T
        twists = np.empty_like(cvel)
        twists[:, 0] = cvel[:, 3] + wy * z - wz * y
        twists[:, 1] = cvel[:, 4] + wz * x - wx * z
        twists[:, 2] = cvel[:, 5] + wx * y - wy * x
        twists[:, 3:] = cvel[:, :3]
        return twists

    def efforts(self) -> NDArray[np.float64]:
        """Return (nv,) efforts of motors and commands [N·m or N]."""
        return self._data.qfrc_applied + self._data.qfrc_actuator

    def axis_positions(self, qpos: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (axes,) positions [rad or m] of a state; a ball joint's three are its rotation vector."""
        positions = qpos[self._compiled.axis_qpos]
        for span, first in self._balls:
            positions[span.start : span.stop] = _rotation_vector(qpos, first)
        return positions * self._compiled.axis_sign

    def by_axis(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the (axes,) entries of an array (nv,) of velocities or efforts."""
        return values[self._compiled.axis_dof] * self._compiled.axis_sign

    def positions_of(self, axes: range) -> list[float]:
        """Return the positions of a joint's axes [rad or m]; takes a twentieth of the time of `positions`."""
        qpos, addresses, signs = self._data.qpos, self._qpos_addresses, self._signs
        if axes.start in self._ball_starts:
            return (_rotation_vector(qpos, addresses[axes.start]) * signs[axes.start]).tolist()
        return [qpos.item(addresses[axis]) * signs[axis] for axis in axes]

    def positions_of_all(self, axes: range) -> list[float]:
        """Return the positions of contiguous axes of several joints [rad or m]."""
        return self.axis_positions(self._data.qpos)[axes.start : axes.stop].tolist()

    def velocities_of(self, axes: range) -> list[float]:
        """Return the velocities of a joint's axes [rad/s or m/s]."""
        dofs, signs, read = self._dofs, self._signs, self._velocities.read_one
        return [read(dofs[axis]) * signs[axis] for axis in axes]

    def efforts_of(self, axes: range) -> list[float]:
        """Return the efforts of motors and commands on a joint's axes [N·m or N]."""
        applied, driven, dofs, signs = self._data.qfrc_applied, self._data.qfrc_actuator, self._dofs, self._signs
        return [(applied.item(dofs[axis]) + driven.item(dofs[axis])) * signs[axis] for axis in axes]

    def center_of_mass(self, link: int) -> Vector3:
        """Return a link's centre of mass in the world [m]."""
        self.link_poses()
        x, y, z = self._data.xipos[self._compiled.link_bodies[link]].tolist()
        return (x, y, z)


def _rotation_vector(qpos: NDArray[np.float64], first: int) -> NDArray[np.float64]:
    """Return the (3,) rotation vector of the quaternion at an address [rad]."""
    rotation = np.empty(3)
    mujoco.mju_quat2Vel(rotation, qpos[first : first + 4], 1.0)
    return rotation
