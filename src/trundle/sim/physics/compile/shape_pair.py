"""A model of four geoms, by which MuJoCo measures the distances of any two convex shapes.

Planners change its shapes for each pair (`cpp/planning/narrow_phase.h`): two primitives, and two meshes whose corners
are replaced. So no shape of a planning scene is ever compiled.
"""

import copy
from functools import cache

import mujoco
import numpy as np

MAX_CORNERS = 1024
"""Maximum number of corners of a convex mesh."""
_MEMORY = 1 << 22
"""Bytes for GJK and EPA."""


class ShapePair:
    """Model and data of one thread."""

    def __init__(self) -> None:
        """Copy the model, which is compiled once."""
        self._model = copy.copy(_compiled())
        self._data = mujoco.MjData(self._model)

    @property
    def addresses(self) -> tuple[int, int]:
        """Addresses of mjModel and mjData, valid as long as this object."""
        return self._model._address, self._data._address


@cache
def _compiled() -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    spec.memory = _MEMORY
    turns = np.arange(MAX_CORNERS) * np.pi * (3 - np.sqrt(5))
    heights = 1 - (2 * np.arange(MAX_CORNERS) + 1) / MAX_CORNERS
    radii = np.sqrt(1 - heights**2)
    corners = np.column_stack([radii * np.cos(turns), radii * np.sin(turns), heights])
    for _ in range(2):
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[1, 1, 1])
    for name in ("a", "b"):
        spec.add_mesh(name=name, uservert=corners.ravel(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
        geom = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH)
        geom.meshname = name
    model = spec.compile()
    model.mesh_graphadr[:] = -1  # the graph is that of other corners; all are searched
    return model
