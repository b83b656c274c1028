"""How two bodies move against each other where they touch, as a function of all speeds."""

import mujoco
import numpy as np
from numpy.typing import NDArray

_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])
_SHORTEST = 1e-6
"""Part of a direction that lies in the surface: where less does, it has none."""


class Approach:
    """Jacobians of contacts of one world."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model = model
        self._data = data
        self._jacobian = np.zeros((2, 3, model.nv))

    def speeds(self) -> NDArray[np.float64]:
        """(contacts,) how fast the two bodies of each contact come closer along its normal [m/s]."""
        data, model = self._data, self._model
        contacts = data.contact
        bodies = model.geom_bodyid[contacts.geom]
        spins, speeds = data.cvel[bodies, :3], data.cvel[bodies, 3:]
        # cvel is taken at the tree's centre of mass. The cross product is written out: np.cross costs five times more.
        x, y, z = np.moveaxis(contacts.pos[:, None, :] - data.subtree_com[model.body_rootid[bodies]], -1, 0)
        wx, wy, wz = np.moveaxis(spins, -1, 0)
        speeds = speeds + np.stack([wy * z - wz * y, wz * x - wx * z, wx * y - wy * x], axis=-1)
        return np.einsum("ij,ij->i", contacts.frame[:, :3], speeds[:, 0] - speeds[:, 1])

    def of(self, contact: mujoco.MjContact) -> NDArray[np.float64]:
        """(3, nv) velocity of the second body against the first, along the normal out of the first and two tangents."""
        bodies = self._model.geom_bodyid
        for jacobian, geom in zip(self._jacobian, contact.geom, strict=True):
            mujoco.mj_jac(self._model, self._data, jacobian, None, contact.pos, int(bodies[geom]))
        return contact.frame.reshape(3, 3) @ (self._jacobian[1] - self._jacobian[0])

    def differences(self, contacts: NDArray[np.intp]) -> NDArray[np.float64]:
        """(contacts, 3, nv) velocity of the second body against the first where they touch, world axes."""
        model, data = self._model, self._data
        found = np.zeros((len(contacts), 3, model.nv))
        bodies, points = model.geom_bodyid[data.contact.geom[contacts]].tolist(), data.contact.pos[contacts]
        first, second = self._jacobian
        for i, (a, b) in enumerate(bodies):
            mujoco.mj_jac(model, data, first, None, points[i], a)
            mujoco.mj_jac(model, data, second, None, points[i], b)
            np.subtract(second, first, out=found[i])
        return found


def crossed(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N, 3) cross products of rows; np.cross takes five times as long."""
    return a.take(_NEXT, 1) * b.take(_LAST, 1) - a.take(_LAST, 1) * b.take(_NEXT, 1)


def lay(data: mujoco.MjData, contacts: NDArray[np.intp], along: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Lay the first tangent of contacts along directions (N, 3), less what is normal; return which have any left."""
    frames = data.contact.frame
    normals = frames[contacts, :3]
    within = along - (along * normals).sum(axis=1, keepdims=True) * normals
    lengths = np.sqrt((within * within).sum(axis=1))
    laid = lengths > _SHORTEST * np.sqrt((along * along).sum(axis=1))
    first = within[laid] / lengths[laid, None]
    frames[contacts[laid], 3:6] = first
    frames[contacts[laid], 6:9] = crossed(normals[laid], first)
    return laid
