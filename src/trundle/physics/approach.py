"""How two bodies move against each other where they touch, as a function of all speeds."""

import mujoco
import numpy as np
from numpy.typing import NDArray


class Approach:
    """Jacobians of contacts of one world."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model = model
        self._data = data
        self._jacobian = np.zeros((2, 3, model.nv))

    def of(self, contact: mujoco.MjContact) -> NDArray[np.float64]:
        """(3, nv) velocity of the second body against the first, along the normal out of the first and two tangents."""
        bodies = self._model.geom_bodyid
        for jacobian, geom in zip(self._jacobian, contact.geom, strict=True):
            mujoco.mj_jac(self._model, self._data, jacobian, None, contact.pos, int(bodies[geom]))
        return contact.frame.reshape(3, 3) @ (self._jacobian[1] - self._jacobian[0])
