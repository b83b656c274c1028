"""Heightmaps as MuJoCo height fields."""

import mujoco
import numpy as np

from trundle.base.diagnostics import Diagnostics
from trundle.robots.meshes import MeshError, read_heights
from trundle.robots.model import Collision, Heightmap
from trundle.spatial import Pose

_GROUND = 1.0
"""Thickness of ground below the lowest point [m], which stops fast bodies."""


def add_terrain(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    terrain: Heightmap,
    name: str,
    report: Diagnostics,
) -> list[mujoco.MjsGeom]:
    """Add a heightmap to a body; one without image or size is dropped with a warning.

    Black is the bottom, at the heightmap's position; white is at the height of its size. The image's upper edge is +y.
    """
    if terrain.path is None:
        return []
    try:
        heights = read_heights(terrain.path, sampling=terrain.sampling)
    except MeshError as error:
        report.warn(
            collision.at, f"collision {collision.name!r}: heightmap {terrain.uri!r}: {error}; it is left out", error.id
        )
        return []
    x, y, z = terrain.size
    if not (x > 0 and y > 0 and z > 0):
        problem = f"heightmap of size {x:g} {y:g} {z:g}"
        report.warn(
            collision.at, f"collision {collision.name!r}: {problem} is empty; it is left out", "degenerate-shape"
        )
        return []
    top = float(heights.max())
    field = spec.add_hfield(name=name, nrow=heights.shape[0], ncol=heights.shape[1])
    # MuJoCo scales the data to 0 … 1; its rows begin at −y.
    bottom = float(heights.min())
    field.userdata = np.ascontiguousarray(heights[::-1]).reshape(-1)
    field.size = [x / 2, y / 2, max(z * (top - bottom), 1e-6), _GROUND]
    pose = collision.link_from_collision @ Pose(terrain.position) @ Pose((0.0, 0.0, z * bottom))
    geom = body.add_geom(name=name, pos=pose.position, quat=pose.quaternion, group=3)
    geom.type, geom.hfieldname = mujoco.mjtGeom.mjGEOM_HFIELD, name
    return [geom]
