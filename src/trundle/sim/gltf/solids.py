"""Triangles of boxes, spheres, cylinders, capsules and planes, with the renderer's texture coordinates.

All but capsules are of unit size, so that shapes share them; their nodes have a scale.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.spatial import Pose, Vector3, rotation_from_z

from .packing import PackedTriangles, pack
from .triangles import Triangles

Solid = Box | Capsule | Cylinder | Ellipsoid | Plane | Sphere
_AROUND = 40
_THINNEST = 1e-4
"""Smallest thickness of a shape [m], as the renderer's."""
_HORIZON = 1000.0
"""Side of a plane without edges [m]."""
_Points = NDArray[np.float64]


def scaled_solid(solid: Solid) -> tuple[PackedTriangles, Pose, Vector3]:
    """Return the triangles of a solid, and their pose and scale in its frame."""
    match solid:
        case Box((x, y, z)):
            return _cube(), Pose(), (_thick(x), _thick(y), _thick(z))
        case Sphere(radius):
            return _ball(0.0), Pose(), (_thick(radius), _thick(radius), _thick(radius))
        case Ellipsoid((x, y, z)):
            return _ball(0.0), Pose(), (_thick(x), _thick(y), _thick(z))
        case Cylinder(radius, length):
            return _cylinder(), Pose(), (_thick(radius), _thick(radius), _thick(length))
        case Capsule(radius, length):
            radius = _thick(radius)
            return _ball(_thick(length) / radius), Pose(), (radius, radius, radius)
        case Plane(normal, (width, height)):
            pose = Pose(quaternion=rotation_from_z(normal))
            if width > 0.0 and height > 0.0:
                return _plane(1.0), pose, (width, height, 1.0)
            return _plane(_HORIZON), pose, (_HORIZON, _HORIZON, 1.0)


def _thick(length: float) -> float:
    return max(length, _THINNEST)


@lru_cache(maxsize=1)
def _cube() -> PackedTriangles:
    """A cube of side 1; each face shows the whole image upright."""
    sides = [((1, 0, 0), (0, 1, 0)), ((-1, 0, 0), (0, -1, 0)), ((0, 1, 0), (-1, 0, 0)), ((0, -1, 0), (1, 0, 0))]
    quads = [_quad(*side, (0, 0, 1)) for side in sides]
    quads += [_quad((0, 0, 1), (1, 0, 0), (0, 1, 0)), _quad((0, 0, -1), (1, 0, 0), (0, -1, 0))]
    positions, normals, uv = (np.concatenate(arrays) for arrays in zip(*quads, strict=True))
    indices = np.array([[0, 1, 2], [0, 2, 3]]) + 4 * np.arange(6)[:, None, None]
    return _packed(positions / 2, indices.reshape(-1, 3), normals, uv)


def _quad(normal: Vector3, right: Vector3, up: Vector3) -> tuple[_Points, _Points, _Points]:
    uv = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    corners = np.array(normal) + (2 * uv[:, :1] - 1) * right + (2 * uv[:, 1:] - 1) * up
    return corners, np.tile(np.array(normal, dtype=float), (4, 1)), uv


@lru_cache(maxsize=2)
def _plane(repeats: float) -> PackedTriangles:
    """A square of side 1 in the x-y plane, seen from +z."""
    corners, normals, uv = _quad((0, 0, 1), (1, 0, 0), (0, 1, 0))
    return _packed(corners * (0.5, 0.5, 0.0), np.array([[0, 1, 2], [0, 2, 3]]), normals, (uv - 0.5) * repeats + 0.5)


@lru_cache(maxsize=64)
def _ball(middle: float) -> PackedTriangles:
    """A unit sphere, or a capsule of radius 1 with a cylinder of the length `middle`."""
    latitudes = np.linspace(-np.pi / 2, np.pi / 2, _AROUND // 2 + 1)
    ends = np.where(latitudes < 0, -1.0, 1.0)
    if middle:  # the equator twice, once for each half
        half = len(latitudes) // 2
        latitudes, ends = np.insert(latitudes, half, 0.0), np.insert(ends, half, -1.0)
    else:
        ends = np.zeros_like(latitudes)
    turns = np.linspace(0.0, 1.0, _AROUND + 1)
    angle, latitude = np.meshgrid(2 * np.pi * turns, latitudes)
    normals = np.stack([np.cos(angle) * np.cos(latitude), np.sin(angle) * np.cos(latitude), np.sin(latitude)], axis=-1)
    positions = normals + ends[:, None, None] * (0.0, 0.0, middle / 2)
    up = positions[..., 2] / (2.0 + middle) + 0.5
    uv = np.stack([np.broadcast_to(turns, up.shape), up], axis=-1)
    indices = _strips(len(latitudes), _AROUND + 1)
    whole = indices[_has_area(positions.reshape(-1, 3)[indices])]
    return _packed(positions, whole, normals, uv)


@lru_cache(maxsize=1)
def _cylinder() -> PackedTriangles:
    """A cylinder of radius 1 and length 1 along z; the lids show the image from above."""
    turns = np.linspace(0.0, 1.0, _AROUND + 1)
    rim = np.stack([np.cos(2 * np.pi * turns), np.sin(2 * np.pi * turns), np.zeros_like(turns)], axis=-1)
    ends = (np.array([0.0, 0.0, -0.5]), np.array([0.0, 0.0, 0.5]))
    side = np.concatenate([rim + end for end in ends])
    side_uv = np.concatenate([np.stack([turns, np.full_like(turns, v)], axis=-1) for v in (0.0, 1.0)])
    middle = np.zeros((1, 3))
    lid = np.concatenate([middle, rim])
    around = np.arange(1, _AROUND + 1)
    fan = np.stack([np.zeros_like(around), around, around + 1], axis=-1)
    first = 2 * (_AROUND + 1)
    indices = [_strips(2, _AROUND + 1), fan[:, ::-1] + first, fan + first + len(lid)]
    positions = np.concatenate([side, lid + ends[0], lid + ends[1]])
    normals = np.concatenate(
        [rim, rim, np.tile([0.0, 0.0, -1.0], (len(lid), 1)), np.tile([0.0, 0.0, 1.0], (len(lid), 1))]
    )
    lid_uv = lid[:, :2] / 2 + 0.5
    return _packed(positions, np.concatenate(indices), normals, np.concatenate([side_uv, lid_uv, lid_uv]))


def _strips(rows: int, columns: int) -> NDArray[np.int64]:
    """Return the triangles of a grid of vertices, columns to the right, rows up."""
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    return np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=2).reshape(-1, 3)


def _has_area(corners: _Points) -> NDArray[np.bool_]:
    """Return (M,) if each triangle (M, 3, 3) has an area; triangles at a pole have none."""
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) > 1e-9


def _packed(positions: _Points, indices: NDArray[np.int64], normals: _Points, uv: _Points) -> PackedTriangles:
    down = uv.reshape(-1, 2) * (1.0, -1.0) + (0.0, 1.0)
    return pack(
        Triangles(
            positions=positions.reshape(-1, 3).astype(np.float32),
            indices=indices.astype(np.uint32),
            normals=normals.reshape(-1, 3).astype(np.float32),
            uv=down.astype(np.float32),
        )
    )
