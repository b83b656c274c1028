"""Textures of Gazebo's named materials, generated: Gazebo's images are not ours."""

from functools import lru_cache
from io import BytesIO

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import TEXTURE_COLORS

from .patterns import (
    PAINT,
    Pattern,
    asphalt,
    bricks,
    clouds,
    concrete,
    floor,
    grass,
    lanes,
    pallet,
    plaster,
    steps,
    tiles,
    wood,
)

_PATTERNS: dict[str, tuple[Pattern, int]] = {
    "Gazebo/Wood": (wood, 110),
    "Gazebo/WoodFloor": (floor, 120),
    "Gazebo/WoodPallet": (pallet, 150),
    "Gazebo/Bricks": (bricks, 200),
    "Gazebo/CeilingTiled": (tiles, 90),
    "Gazebo/PaintedWall": (plaster, 60),
    "Gazebo/CloudySky": (clouds, 120),
    "Gazebo/Road": (lanes(2), 140),
    "Gazebo/Residential": (lanes(2, edges=False), 140),
    "Gazebo/Tertiary": (lanes(2), 140),
    "Gazebo/Pedestrian": (concrete, 60),
    "Gazebo/Footway": (concrete, 60),
    "Gazebo/Motorway": (lanes(6), 140),
    "Gazebo/Lanes_6": (lanes(6), 140),
    "Gazebo/Trunk": (lanes(4), 140),
    "Gazebo/Lanes_4": (lanes(4), 140),
    "Gazebo/Primary": (lanes(2), 140),
    "Gazebo/Lanes_2": (lanes(2), 140),
    "Gazebo/Secondary": (lanes(2), 140),
    "Gazebo/Lane_1": (lanes(1), 140),
    "Gazebo/Steps": (steps, 120),
    "Gazebo/Runway": (asphalt, 70),
    "Gazebo/Grass": (grass, 150),
}
"""Name → pattern and its contrast: difference between its darkest and brightest value."""


NAMED_TEXTURES = (
    "Gazebo/Wood", "Gazebo/WoodFloor", "Gazebo/WoodPallet", "Gazebo/Bricks", "Gazebo/CeilingTiled",
    "Gazebo/PaintedWall", "Gazebo/CloudySky", "Gazebo/Pedestrian", "Gazebo/Grass", "Gazebo/Runway", "Gazebo/Steps",
)  # fmt: skip
"""Names of textures that look different from each other and suit any surface."""


@lru_cache(maxsize=32)
def named_texture(name: str) -> bytes:
    """Return the texture of a material in `TEXTURE_COLORS`, as PNG; its mean is the material's color."""
    from PIL import Image  # slow to load, and most worlds have no such material

    png = BytesIO()
    Image.fromarray(texture_pixels(name)).save(png, "PNG")
    return png.getvalue()


def texture_pixels(name: str) -> NDArray[np.uint8]:
    """Return the texture of a material in `TEXTURE_COLORS`, (256, 256, 3), upper row first."""
    pattern, contrast = _PATTERNS[name]
    field = pattern(sum(name.encode()))
    color = np.array([round(255 * value) for value in TEXTURE_COLORS[name]], dtype=np.int64)
    is_paint = field >= PAINT
    paint, rest = field[is_paint] - PAINT, field[~is_paint]
    ground = (color * field.size - paint.sum()) // rest.size
    # A pattern's values are brightness: each channel changes in proportion to the color.
    relative = (rest - rest.sum() // rest.size) * contrast // 256
    pixels = np.empty((*field.shape, 3), dtype=np.int64)
    pixels[is_paint] = paint[:, None]
    pixels[~is_paint] = ground + relative[:, None] * (64 + ground) // 256
    return np.clip(pixels, 0, 255).astype(np.uint8)
