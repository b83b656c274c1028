"""Bounds of shapes."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.spatial import Vector3

from .scene import ShapeGeometry

_Points = NDArray[np.float64]
_AROUND = 64
"""Points per circle, a thousandth of its radius away from the polygon between them."""


def corners_of(geometry: ShapeGeometry) -> list[Vector3]:
    """Return the eight corners of a shape's bounding box in its frame [m]; none for an infinite plane."""
    match geometry:
        case Box((x, y, z)):
            half = (x / 2, y / 2, z / 2)
        case Cylinder(radius, length):
            half = (radius, radius, length / 2)
        case Capsule(radius, length):
            half = (radius, radius, length / 2 + radius)
        case Sphere(radius):
            half = (radius, radius, radius)
        case Ellipsoid(radii):
            half = radii
        case Plane():
            return []
        case Mesh(vertices):
            low, high = vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()
            return [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    return [(sx * half[0], sy * half[1], sz * half[2]) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]


def outline_of(geometry: ShapeGeometry) -> _Points:
    """Return (n, 3) points with the same extent as a shape in every direction [m]; none for an infinite plane."""
    match geometry:
        case Cylinder(radius, length):
            x, y = radius * np.cos(_TURNS), radius * np.sin(_TURNS)
            return np.concatenate([np.stack([x, y, np.full(_AROUND, z)], axis=-1) for z in (-length / 2, length / 2)])
        case Capsule(radius, length):
            ball = _BALL * radius
            return ball + np.sign(_BALL[:, 2:]) * (0.0, 0.0, length / 2)
        case Sphere(radius):
            return _BALL * radius
        case Ellipsoid(radii):
            return _BALL * radii
        case Mesh(vertices):
            return vertices.astype(np.float64)
        case _:
            return np.array(corners_of(geometry)).reshape(-1, 3)


_TURNS = np.arange(_AROUND) * (math.tau / _AROUND)
_HEIGHTS = np.linspace(-math.pi / 2, math.pi / 2, _AROUND // 2)
"""Latitudes of an even number of circles, none of them the equator, where a capsule's halves separate."""
_BALL: _Points = np.stack(
    [
        np.outer(np.cos(_HEIGHTS), np.cos(_TURNS)),
        np.outer(np.cos(_HEIGHTS), np.sin(_TURNS)),
        np.outer(np.sin(_HEIGHTS), np.ones(_AROUND)),
    ],
    axis=-1,
).reshape(-1, 3)
"""Points on the unit sphere."""
