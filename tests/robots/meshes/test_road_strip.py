"""Road strips: of constant width, facing up, with a repeated image."""

import numpy as np
import pytest

from trundle.robots.meshes import Mesh, strip_mesh


def area(mesh: Mesh) -> tuple[float, bool]:
    """Area [m²], and True if every face looks up."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]].astype(float) for i in range(3))
    normals = np.cross(b - a, c - a)
    return float(np.linalg.norm(normals, axis=1).sum() / 2), bool((normals[:, 2] > 0).all())


def test_a_straight_strip_is_a_rectangle_with_its_image_repeated() -> None:
    mesh = strip_mesh([(0, 0, 0.1), (3, 0, 0.1), (8, 0, 0.1)], 2.0)

    assert area(mesh) == (pytest.approx(16.0), True)
    assert mesh.vertices.min(axis=0) == pytest.approx([0, -1, 0.1])
    assert mesh.vertices.max(axis=0) == pytest.approx([8, 1, 0.1])
    assert mesh.uv is not None
    corners = mesh.vertices[mesh.faces]
    assert mesh.uv[..., 0] == pytest.approx((1 - corners[..., 1]) / 2)  # 0 on the left
    assert mesh.uv[..., 1] == pytest.approx(corners[..., 0] / 2)


def test_a_strip_is_as_wide_after_a_corner() -> None:
    """Two arms of 10 m length and 2 m width, mitred, cover 2 · 10 · 2 m²."""
    mesh = strip_mesh([(0, 0, 0), (10, 0, 0), (10, 10, 0)], 2.0)

    assert area(mesh) == (pytest.approx(40.0, rel=1e-5), True)
    assert mesh.vertices.max(axis=0) == pytest.approx([11, 10, 0])


def test_coinciding_points_do_no_harm() -> None:
    mesh = strip_mesh([(0, 0, 0), (0, 0, 0), (1, 0, 0), (0, 0, 0)], 1.0)

    assert np.isfinite(mesh.vertices).all()
    assert np.abs(mesh.vertices).max() < 40
