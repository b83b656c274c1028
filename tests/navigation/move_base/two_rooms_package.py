"""Package of a robot in two rooms, with the map of their walls."""

import shutil
from pathlib import Path

import numpy as np

_PACKAGE = Path(__file__).parent / "two_rooms"
WALLS = ((-0.05, 0.05, -1.5, 0.35), (-0.05, 0.05, 1.25, 1.5), (-9.0, -3.0, -9.0, 9.0), (3.0, 9.0, -9.0, 9.0))
WALLS += ((-9.0, 9.0, -9.0, -1.5), (-9.0, 9.0, 1.5, 9.0))
"""Rectangles of walls: x from, to, y from, to [m]."""


def make_two_rooms(folder: Path) -> Path:
    """Copy the package into a folder and write its map, unless it is there; return its folder."""
    package = folder / "two_rooms"
    if not package.exists():
        shutil.copytree(_PACKAGE, package)
        _write_map(package)
    return package


def _write_map(folder: Path) -> None:
    """Write the map of the walls, 0.05 m a cell, without the box."""
    x, y = np.meshgrid((np.arange(140) + 0.5) * 0.05 - 3.5, (np.arange(80) + 0.5) * 0.05 - 2.0)
    is_wall = np.zeros(x.shape, dtype=bool)
    for x0, x1, y0, y1 in WALLS:
        is_wall |= (x > x0) & (x < x1) & (y > y0) & (y < y1)
    pixels = np.where(np.flipud(is_wall), 0, 254).astype(np.uint8)
    (folder / "map.pgm").write_bytes(b"P5\n140 80\n255\n" + pixels.tobytes())
    (folder / "map.yaml").write_text(
        "image: map.pgm\nresolution: 0.05\norigin: [-3.5, -2.0, 0.0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
