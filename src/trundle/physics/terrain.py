"""Heightmaps as MuJoCo height fields."""

import mujoco
import numpy as np
from PIL import Image

from trundle.diagnostics import Diagnostics
from trundle.model import Collision, Heightmap
from trundle.spatial import Pose

_MOST_PIXELS = 4096
"""Of each side of an image."""
_MOST_SAMPLES = 1025
"""Of each side of the terrain; more is thinned out."""
_GROUND = 1.0
"""[m] Of earth below the lowest place, for what comes fast."""


def add_terrain(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    terrain: Heightmap,
    name: str,
    report: Diagnostics,
) -> list[mujoco.MjsGeom]:
    """Add a heightmap to a body; none after a warning where it has no image or no size.

    Black is the bottom, at the heightmap's position; white is as high as its size says. The image's upper edge is +y.
    """
    if terrain.path is None:
        return []
    try:
        with Image.open(terrain.path) as image:
            if max(image.size) > _MOST_PIXELS or min(image.size) < 2:
                raise ValueError(f"{image.size[0]} by {image.size[1]} pixels; 2 to {_MOST_PIXELS} can be used")
            grey = image if image.mode in ("I", "I;16", "F") else image.convert("L")
            side = [min((n - 1) * max(terrain.sampling, 1) + 1, _MOST_SAMPLES) for n in image.size]
            heights = np.asarray(grey.convert("F").resize((side[0], side[1]), Image.Resampling.BILINEAR))
            white = 65535.0 if image.mode in ("I", "I;16") else 255.0
    except (OSError, ValueError, Image.DecompressionBombError) as error:
        what = " ".join(str(error).split())
        report.warn(collision.at, f"collision {collision.name!r}: heightmap {terrain.uri!r}: {what}; it is left out")
        return []
    x, y, z = terrain.size
    if not (x > 0 and y > 0 and z > 0):
        what = f"heightmap of size {x:g} {y:g} {z:g}"
        report.warn(collision.at, f"collision {collision.name!r}: {what} is nothing; it is left out")
        return []
    top = float(heights.max())
    field = spec.add_hfield(name=name, nrow=heights.shape[0], ncol=heights.shape[1])
    # MuJoCo stretches what it is given to 0 … 1, its rows from −y on.
    bottom = float(heights.min())
    field.userdata = np.ascontiguousarray(heights[::-1]).astype(np.float32).reshape(-1)
    field.size = [x / 2, y / 2, max(z * (top - bottom) / white, 1e-6), _GROUND]
    pose = collision.link_from_collision @ Pose(terrain.position) @ Pose((0.0, 0.0, z * bottom / white))
    geom = body.add_geom(name=name, pos=pose.position, quat=pose.quaternion, group=3)
    geom.type, geom.hfieldname = mujoco.mjtGeom.mjGEOM_HFIELD, name
    return [geom]
