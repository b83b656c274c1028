"""Writer of the state of a world into MuJoCo's arrays: positions and velocities, at once."""

from collections.abc import Callable, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.spatial import Pose, Twist

from ..compile.compiled_world import CompiledWorld
from .velocities import Velocities

_SIZES = {int(mujoco.mjtJoint.mjJNT_FREE): (7, 6), int(mujoco.mjtJoint.mjJNT_BALL): (4, 3)}
"""Numbers of a joint's position and velocity, by its type; all others have one each."""


class StateWriter:
    """Writer of one `MjData`; motors do not hold the written values."""

    def __init__(
        self, compiled: CompiledWorld, data: mujoco.MjData, *, wake: Callable[[int], None], changed: Callable[[], None]
    ) -> None:
        """Bind the engine's arrays.

        Args:
            compiled: the world.
            data: its state.
            wake: called with each degree of freedom moved.
            changed: called after each change.
        """
        self._compiled = compiled
        self._model = compiled.model
        self._data = data
        self._wake = wake
        self._changed = changed
        self._velocities = Velocities(compiled.model, data)
        self._balls = frozenset(compiled.ball_joints)
        self._followers = _find_followers(compiled.model)
        self.was_teleported = True
        """True if anything was teleported, and may penetrate something."""
        self._tree_has_shapes: list[bool] = np.isin(
            np.arange(self._model.ntree), self._model.body_treeid[self._model.geom_bodyid]
        ).tolist()

    def set_axis_positions(self, axes: range, positions: Sequence[float] | NDArray[np.float64]) -> None:
        """Set the positions of axes [rad or m], and of axes that follow them; velocities stay.

        Args:
            axes: axes of whole joints; a ball joint's three take a rotation vector.
            positions: (axes,)
        """
        for axis, position in zip(axes, positions, strict=True):
            address, dof = int(self._compiled.axis_qpos[axis]), int(self._compiled.axis_dof[axis])
            self._velocities.synchronize(dof)
            if axis in self._balls:
                first = axis - axes.start
                self._set_ball(address, positions[first : first + 3], sign=float(self._compiled.axis_sign[axis]))
            elif self._compiled.axis_actuator[axis] >= 0:
                self._data.qpos[address] = position
                self._move_followers(int(self._model.dof_jntid[dof]))
            self._wake(dof)
        self._changed()

    def _set_ball(self, address: int, rotation: Sequence[float] | NDArray[np.float64], *, sign: float) -> None:
        vector = sign * np.asarray(rotation, dtype=np.float64)
        angle = float(np.linalg.norm(vector))
        axis = vector / angle if angle else np.array([1.0, 0.0, 0.0])
        mujoco.mju_axisAngle2Quat(self._data.qpos[address : address + 4], axis, angle)

    def set_axis_velocities(self, axes: range, velocities: Sequence[float] | NDArray[np.float64]) -> None:
        """Set the velocities of axes [rad/s or m/s], and of axes that follow them, once.

        Args:
            axes: axes of one joint or several.
            velocities: (axes,)
        """
        for axis, velocity in zip(axes, velocities, strict=True):
            dof = int(self._compiled.axis_dof[axis])
            self._velocities.synchronize(dof)
            self._data.qvel[dof] = velocity * self._compiled.axis_sign[axis]
            self._speed_up_followers(int(self._model.dof_jntid[dof]))
        self._changed()

    def _move_followers(self, joint: int) -> None:
        """Set the positions of the joints whose constraints make them follow a joint."""
        model, qpos = self._model, self._data.qpos
        for leader, follower, offset, ratio in self._followers.get(joint, ()):
            source, target = model.jnt_qposadr[[leader, follower]]
            self._velocities.synchronize(int(model.jnt_dofadr[follower]))
            qpos[target] = model.qpos0[target] + offset + ratio * (qpos[source] - model.qpos0[source])

    def _speed_up_followers(self, joint: int) -> None:
        """Set the velocities of the joints that follow a joint."""
        for leader, follower, _, ratio in self._followers.get(joint, ()):
            dof = int(self._model.jnt_dofadr[follower])
            self._velocities.synchronize(dof)
            self._data.qvel[dof] = ratio * self._data.qvel[self._model.jnt_dofadr[leader]]

    def set_tree_pose(self, link: int, pose: Pose) -> None:
        """Teleport a free link with its tree; velocities stay in world axes.

        Raises:
            UsageError: the link has a parent joint or is fixed.
        """
        joint = self._free_joint(link)
        first = int(self._model.jnt_qposadr[joint])
        dof = int(self._model.jnt_dofadr[joint])
        self._velocities.synchronize(dof)
        turned = pose.quaternion
        spin = np.empty(3)
        mujoco.mju_rotVecQuat(spin, self._data.qvel[dof + 3 : dof + 6], self._data.qpos[first + 3 : first + 7])
        self._data.qpos[first : first + 7] = (*pose.position, *turned)
        wx, wy, wz = spin.tolist()
        self._data.qvel[dof + 3 : dof + 6] = Pose(quaternion=turned).inverse().transform_vector((wx, wy, wz))
        self.was_teleported |= self._tree_has_shapes[self._model.dof_treeid[dof]]
        self._wake(dof)
        self._changed()

    def set_tree_twist(self, link: int, twist: Twist) -> None:
        """Set the velocity of a free link's origin and its angular velocity, world axes.

        Raises:
            UsageError: the link has a parent joint or is fixed.
        """
        joint = self._free_joint(link)
        first, dof = int(self._model.jnt_qposadr[joint]), int(self._model.jnt_dofadr[joint])
        w, x, y, z = self._data.qpos[first + 3 : first + 7].tolist()
        self._velocities.synchronize(dof)
        self._data.qvel[dof : dof + 3] = twist.linear
        self._data.qvel[dof + 3 : dof + 6] = Pose(quaternion=(w, x, y, z)).inverse().transform_vector(twist.angular)
        self._wake(dof)
        self._changed()

    def reset_links(self, links: Sequence[int]) -> None:
        """Reset the joints of links, and free links, to their initial positions, at rest."""
        initial = self._model.qpos0 if self._compiled.initial_qpos is None else self._compiled.initial_qpos
        bodies = self._compiled.link_bodies[list(links)]
        for joint in np.flatnonzero(np.isin(self._model.jnt_bodyid, bodies)):
            address, dof = int(self._model.jnt_qposadr[joint]), int(self._model.jnt_dofadr[joint])
            positions, velocities = _SIZES.get(int(self._model.jnt_type[joint]), (1, 1))
            self._velocities.synchronize(dof)
            self._data.qpos[address : address + positions] = initial[address : address + positions]
            self._data.qvel[dof : dof + velocities] = 0.0
            self.was_teleported |= self._tree_has_shapes[self._model.dof_treeid[dof]]
            self._wake(dof)
        self._changed()

    def is_free(self, link: int) -> bool:
        """True if a link has no parent joint and is not fixed."""
        first = int(self._model.body_jntadr[self._compiled.link_bodies[link]])
        return first >= 0 and self._model.jnt_type[first] == mujoco.mjtJoint.mjJNT_FREE

    def _free_joint(self, link: int) -> int:
        if not self.is_free(link):
            name = self._compiled.link_names[link]
            raise UsageError(f"link {name!r} cannot be moved: it has a parent joint or is fixed to the world")
        return int(self._model.body_jntadr[self._compiled.link_bodies[link]])


def _find_followers(model: mujoco.MjModel) -> dict[int, list[tuple[int, int, float, float]]]:
    """Return joint → leader, follower, offset and ratio of each screw, mimic or gearbox below it, in order."""
    ties: dict[int, list[tuple[int, int, float, float]]] = {}
    for tie in np.flatnonzero((model.eq_type == mujoco.mjtEq.mjEQ_JOINT) & model.eq_active0.astype(np.bool_)):
        follower, leader = int(model.eq_obj1id[tie]), int(model.eq_obj2id[tie])
        offset, ratio = model.eq_data[tie, :2].tolist()
        ties.setdefault(leader, []).append((leader, follower, offset, ratio))
    followers: dict[int, list[tuple[int, int, float, float]]] = {}
    for first in ties:
        reached, chain = {first}, list(ties[first])
        for tie in chain:  # the list grows as followers of followers are found
            if tie[1] not in reached:
                reached.add(tie[1])
                chain += ties.get(tie[1], [])
        followers[first] = [tie for tie in chain if tie[1] != first]
    return followers
