"""Convex meshes of many faces are told from others as by every corner's height above every face."""

from typing import Literal

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from trundle.sim.physics.convex.convexity import is_convex

Mesh = tuple[NDArray[np.float64], NDArray[np.intp]]


def sphere(*, noise: float = 0.0, dent: float = 0.0) -> Mesh:
    """5,120 faces, with a dent at the top."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.5)
    points = np.array(ball.vertices) + np.random.default_rng(3).normal(scale=noise, size=ball.vertices.shape)
    away = np.linalg.norm(points - [0.0, 0.0, 0.5], axis=1)
    points[:, 2] -= np.maximum(0.5 - away, 0.0) ** 2 * dent
    return points, np.array(ball.faces, dtype=np.intp)


def turned_box() -> Mesh:
    """Faces of many triangles each, in a position that single precision rounds."""
    box = trimesh.creation.box()
    for _ in range(4):
        box = box.subdivide()
    box.apply_transform(trimesh.transformations.rotation_matrix(0.7, (1, 2, 3)))
    return np.float32(box.vertices).astype(float), np.array(box.faces, dtype=np.intp)


def star_prism(points: Literal[5, 7]) -> Mesh:
    """A prism whose outline turns twice around its middle: no edge is folded inwards."""
    turns = 4 * np.pi * np.arange(points) / points
    rim = np.column_stack([np.cos(turns), np.sin(turns)])
    corners = np.concatenate([np.column_stack([rim, np.full(points, z)]) for z in (-0.5, 0.5)])
    corners = np.concatenate([corners, [(0, 0, -0.5), (0, 0, 0.5)]])
    faces: list[tuple[int, int, int]] = []
    for i in range(points):
        j = (i + 1) % points
        faces += [(i, j, j + points), (i, j + points, i + points), (j, i, 2 * points)]
        faces.append((i + points, j + points, 2 * points + 1))
    return corners, np.array(faces, dtype=np.intp)


def flipped(mesh: Mesh, *, every: int) -> Mesh:
    points, faces = mesh
    faces = faces.copy()
    faces[::every] = faces[::every, ::-1]
    return points, faces


def opened(mesh: Mesh) -> Mesh:
    """Without its first face."""
    return mesh[0], mesh[1][1:]


CASES = {
    "a ball": (sphere(), True),
    "a ball, some faces flipped": (flipped(sphere(), every=7), True),
    "a room": (flipped(sphere(), every=1), False),
    "an open ball": (opened(sphere()), False),
    "a rough ball": (sphere(noise=3e-4), True),
    "a ball that is too rough": (sphere(noise=5e-4), False),
    "a ball with a dent of 1 mm": (sphere(dent=0.05), True),
    "a ball with a dent of 6 mm": (sphere(dent=0.1), False),
    "a box at an angle": (turned_box(), True),
    "a star that turns twice": (star_prism(5), False),
    "a longer star": (star_prism(7), False),
}


@pytest.mark.parametrize("case", CASES)
def test_a_mesh_is_convex_if_no_vertex_is_above_any_face(case: str) -> None:
    (points, faces), expected = CASES[case]
    assert is_convex(points, faces, points) is expected
    if case not in ("an open ball", "a room"):
        assert (heights(points, faces) <= 2e-3 * float(np.ptp(points, axis=0).max())) is expected


def heights(points: NDArray[np.float64], faces: NDArray[np.intp]) -> float:
    """The largest distance by which corners are on both sides of one face [m]."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    highest = 0.0
    for normal, offset in zip(normals, (normals * a).sum(axis=1), strict=True):
        above = points @ normal - offset
        highest = max(highest, min(float(above.max()), -float(above.min())))
    return highest
