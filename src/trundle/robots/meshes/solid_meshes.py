"""Triangle meshes of shapes without an analytic primitive."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .mesh import Mesh
from .triangulation import Point, triangulate

_SIDES = 48


def cone_mesh(radius: float, length: float) -> Mesh:
    """Return a cone along z, tip up, centred at half its height."""
    turns = np.linspace(0.0, 2 * np.pi, _SIDES, endpoint=False)
    rim = np.column_stack([radius * np.cos(turns), radius * np.sin(turns), np.full(_SIDES, -length / 2)])
    vertices = np.vstack([rim, [[0.0, 0.0, length / 2], [0.0, 0.0, -length / 2]]])
    here = np.arange(_SIDES)
    after = np.roll(here, -1)
    tip, middle = np.full(_SIDES, _SIDES), np.full(_SIDES, _SIDES + 1)
    faces = np.vstack([np.column_stack([here, after, tip]), np.column_stack([after, here, middle])])
    turned = np.stack([turns, turns + 2 * np.pi / _SIDES, turns + np.pi / _SIDES], axis=1)
    side = np.stack([length * np.cos(turned), length * np.sin(turned), np.full_like(turned, radius)], axis=-1)
    normals = np.vstack([side, np.broadcast_to([0.0, 0.0, -1.0], side.shape)])
    return Mesh(vertices.astype(np.float32), faces.astype(np.int32), normals=normals.astype(np.float32))


def prism_mesh(outlines: Sequence[Sequence[Point]], height: float) -> Mesh:
    """Return outlines in the x-y plane extruded to a height [m]; no faces without an enclosed area."""
    corners: list[tuple[float, float, float]] = []
    plan = triangulate(outlines)
    for a, b, c in plan:
        corners += [(*a, height), (*b, height), (*c, height), (*c, 0.0), (*b, 0.0), (*a, 0.0)]
    # Walls are at the edges of only one triangle: those whose reverse does not occur.
    edges = {(p, q) for a, b, c in plan for p, q in ((a, b), (b, c), (c, a))}
    for p, q in sorted(edges):
        if (q, p) not in edges:
            corners += [(*p, 0.0), (*q, 0.0), (*q, height), (*p, 0.0), (*q, height), (*p, height)]
    vertices = np.array(corners, dtype=np.float32).reshape(-1, 3)
    return Mesh(vertices, np.arange(len(vertices), dtype=np.int32).reshape(-1, 3))


def terrain_mesh(heights: NDArray[np.float32], size: tuple[float, float, float]) -> Mesh:
    """Return the mesh of heights (rows, columns) from 0 to 1, upper edge (+y) first; `size` [m] about the centre, z
    from 0.
    """
    rows, columns = heights.shape
    x = np.linspace(-size[0] / 2, size[0] / 2, columns, dtype=np.float32)
    y = np.linspace(size[1] / 2, -size[1] / 2, rows, dtype=np.float32)
    vertices = np.stack([*np.meshgrid(x, y), heights * np.float32(size[2])], axis=-1).reshape(-1, 3)
    corner = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    nw, ne, sw, se = corner[:-1, :-1], corner[:-1, 1:], corner[1:, :-1], corner[1:, 1:]
    faces = np.stack([np.stack([sw, se, ne], axis=-1), np.stack([sw, ne, nw], axis=-1)], axis=2).reshape(-1, 3)
    uv_points = np.stack(np.meshgrid(np.linspace(0, 1, columns), np.linspace(1, 0, rows)), axis=-1).reshape(-1, 2)
    down, right = np.gradient(heights * np.float32(size[2]), size[1] / (rows - 1), size[0] / (columns - 1))
    normals = np.stack([-right, down, np.ones_like(right)], axis=-1).reshape(-1, 3)
    return Mesh(vertices, faces, uv=uv_points.astype(np.float32)[faces], normals=normals.astype(np.float32)[faces])
