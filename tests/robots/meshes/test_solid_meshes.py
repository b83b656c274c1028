"""Shapes made of triangles: closed, of the right volume, facing outwards."""

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from trundle.robots.meshes import Mesh, MeshError, cone_mesh, prism_mesh, read_heights, terrain_mesh


def solid(mesh: Mesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=True)


def test_a_cone_holds_a_third_of_its_cylinder() -> None:
    result = solid(cone_mesh(0.5, 1.2))
    assert result.is_watertight
    assert result.volume == pytest.approx(math.pi * 0.25 * 1.2 / 3, rel=0.005)
    assert result.bounds[:, 2] == pytest.approx([-0.6, 0.6])


def test_a_prism_has_walls_outside_and_around_its_holes() -> None:
    outer = ((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0))
    hole = ((1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0))
    result = solid(prism_mesh((outer, hole), 0.5))
    assert result.is_watertight
    assert result.volume == pytest.approx(15.0 * 0.5)
    assert result.area == pytest.approx(2 * 15.0 + 0.5 * (16.0 + 4.0))


def test_a_terrain_is_as_high_as_its_image_is_white(tmp_path: Path) -> None:
    slope = np.linspace(0, 255, 17).round().astype(np.uint8)
    Image.fromarray(np.tile(slope, (9, 1))).save(tmp_path / "slope.png")
    heights = read_heights(tmp_path / "slope.png")
    assert heights.shape == (9, 17)
    mesh = terrain_mesh(heights, (8.0, 4.0, 2.0))
    assert mesh.vertices[:, 2] == pytest.approx((mesh.vertices[:, 0] + 4.0) / 4.0, abs=0.01)
    assert solid(mesh).face_normals[:, 2].min() > 0.9
    assert mesh.uv is not None
    at = mesh.vertices[mesh.faces]
    assert mesh.uv[..., 0] == pytest.approx(at[..., 0] / 8.0 + 0.5, abs=1e-5)
    assert mesh.uv[..., 1] == pytest.approx(at[..., 1] / 4.0 + 0.5, abs=1e-5)


def test_the_upper_edge_of_an_image_is_north(tmp_path: Path) -> None:
    north = np.zeros((9, 9), dtype=np.uint16)
    north[0] = 65535
    Image.fromarray(north).save(tmp_path / "north.png")
    mesh = terrain_mesh(read_heights(tmp_path / "north.png", sampling=2, max_samples=17), (2.0, 2.0, 1.0))
    assert len(mesh.vertices) == 17 * 17
    assert mesh.vertices[mesh.vertices[:, 2] > 0.99][:, 1].min() == pytest.approx(1.0, abs=0.1)


def test_the_normals_of_a_terrain_and_a_cone_stand_on_their_surfaces() -> None:
    x, y = np.meshgrid(np.linspace(-2.0, 2.0, 5), np.linspace(3.0, -3.0, 7))
    terrain = terrain_mesh(((2.0 + 0.5 * x + 0.25 * y) / 4.0).astype(np.float32), (4.0, 6.0, 4.0))
    assert terrain.normals is not None
    assert terrain.normals == pytest.approx(np.broadcast_to([-0.5, -0.25, 1.0], terrain.normals.shape), abs=1e-5)
    cone = cone_mesh(0.5, 2.0)
    assert cone.normals is not None
    for corner in range(3):
        facing = np.einsum("ij,ij->i", cone.normals[:, corner], solid(cone).face_normals)
        assert facing / np.linalg.norm(cone.normals[:, corner], axis=1) == pytest.approx(1.0, abs=5e-3)


def test_an_image_that_is_not_a_heightmap_is_refused_with_the_reason(tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("no image")
    with pytest.raises(MeshError, match=r"^it is not an image$"):
        read_heights(tmp_path / "text.png")
    Image.new("L", (9, 1)).save(tmp_path / "line.png")
    with pytest.raises(MeshError, match="9 by 1 pixels; 2 to 4096 are possible"):
        read_heights(tmp_path / "line.png")
