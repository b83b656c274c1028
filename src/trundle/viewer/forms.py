"""The few triangle meshes that all shapes are instances of: unit box, cylinder, ball and plane; capsules; files."""

from collections.abc import Hashable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.render import Shape
from trundle.spatial import Pose, Vector3, rotation_from_z

_SEGMENTS = 48
_RINGS = 24
_THINNEST_M = 1e-4
"""A zero-thickness box has no normals; this one looks the same."""


@dataclass(frozen=True, slots=True, eq=False)
class Form:
    """Triangles, flat-shaded or smooth."""

    vertices: NDArray[np.float32]
    """(N, 3)"""
    faces: NDArray[np.int32]
    """(M, 3), counter-clockwise from outside."""
    flat: bool = False
    double_sided: bool = False


@dataclass(frozen=True, slots=True)
class Instance:
    """How a shape is made from a form."""

    key: Hashable
    """Shapes with equal keys share a form."""
    scale: Vector3 = (1.0, 1.0, 1.0)
    shape_from_form: Pose = Pose()


def instance_of(shape: Shape) -> Instance:
    """Name the form a shape is drawn with, and how it is stretched."""
    match shape.geometry:
        case Box(size=(x, y, z)):
            return Instance("box", (max(x, _THINNEST_M), max(y, _THINNEST_M), max(z, _THINNEST_M)))
        case Cylinder(radius=r, length=length):
            return Instance("cylinder", (r, r, max(length, _THINNEST_M)))
        case Sphere(radius=r):
            return Instance("ball", (r, r, r))
        case Ellipsoid(radii=radii):
            return Instance("ball", radii)
        case Capsule(radius=r, length=length):
            return Instance(("capsule", r, length))
        case Plane(normal=normal, size=(x, y)):
            return Instance("plane", (x, y, 1.0), Pose(quaternion=rotation_from_z(normal)))
        case Mesh() as mesh:
            return Instance(("mesh", id(mesh)))


def form_of(shape: Shape) -> Form:
    """Return the triangles an instance of this shape stretches."""
    match shape.geometry:
        case Box():
            return _box()
        case Cylinder():
            return _turned(np.array([[0, -0.5], [1, -0.5], [1, -0.5], [1, 0.5], [1, 0.5], [0, 0.5]]))
        case Sphere() | Ellipsoid():
            angle = np.linspace(-np.pi / 2, np.pi / 2, _RINGS + 1)
            return _turned(np.stack([np.cos(angle), np.sin(angle)], axis=1))
        case Capsule(radius=r, length=length):
            angle = np.linspace(0, np.pi / 2, _RINGS // 2 + 1)
            top = np.stack([r * np.cos(angle), length / 2 + r * np.sin(angle)], axis=1)
            return _turned(np.concatenate([top[::-1] * [1, -1], top]))
        case Plane():
            corners = np.array([[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]], dtype=np.float32)
            return Form(corners, np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32), flat=True, double_sided=True)
        case Mesh(vertices=vertices, faces=faces):
            # Files of the wild mix windings, and vertices shared across edges would be shaded as if they were round.
            return Form(vertices, faces, flat=True, double_sided=True)


def _box() -> Form:
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], dtype=np.float32)
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]
    return Form(corners, np.array(faces, dtype=np.int32), flat=True)


def _turned(profile: NDArray[np.float64]) -> Form:
    """Turn a profile of (radius, z) rows, bottom to top, about z; a row written twice makes a sharp edge."""
    around = np.linspace(0, 2 * np.pi, _SEGMENTS, endpoint=False)
    radius, z = profile[:, 0:1], profile[:, 1:2]
    rings = np.stack(
        [radius * np.cos(around), radius * np.sin(around), np.broadcast_to(z, (len(z), _SEGMENTS))], axis=2
    )
    i = np.arange(_SEGMENTS)
    j = (i + 1) % _SEGMENTS
    faces: list[NDArray[np.int64]] = []
    for ring in range(len(profile) - 1):
        if np.array_equal(profile[ring], profile[ring + 1]):
            continue
        low, high = ring * _SEGMENTS, (ring + 1) * _SEGMENTS
        if profile[ring + 1, 0] > 1e-12:
            faces.append(np.stack([low + i, high + j, high + i], axis=1))
        if profile[ring, 0] > 1e-12:
            faces.append(np.stack([low + i, low + j, high + j], axis=1))
    return Form(rings.reshape(-1, 3).astype(np.float32), np.concatenate(faces).astype(np.int32))
