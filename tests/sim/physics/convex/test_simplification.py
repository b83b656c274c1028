"""Convex meshes of very many corners are simulated with fewer, within a tolerance."""

import re
from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.sim.physics import compile_world
from trundle.sim.physics.convex.simplification import MAX_CORNERS, simplify
from trundle.sim.physics.convex.splitting import split_mesh


def stretched(mesh: trimesh.Trimesh, *scale: float) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Vertices and faces, in a position that single precision rounds."""
    mesh.apply_scale(scale)
    mesh.apply_transform(trimesh.transformations.rotation_matrix(0.7, (1, 2, 3), (0.1, 0.2, 0.3)))
    return np.float32(mesh.vertices).astype(float), np.array(mesh.faces, dtype=np.intp)


def above(points: NDArray[np.float64], corners: NDArray[np.float64]) -> float:
    """The largest distance of points from the hull of corners [m]."""
    hull = trimesh.convex.convex_hull(corners)
    offsets = np.einsum("ij,ij->i", hull.face_normals, hull.triangles[:, 0])
    return max(float((part @ hull.face_normals.T - offsets).max()) for part in np.array_split(points, 40))


@pytest.mark.slow
@pytest.mark.parametrize("scale", [(1, 1, 1), (1, 0.1, 0.001)], ids=["a ball", "a thin disk"])
def test_the_surface_moves_less_than_the_tolerance_of_each_extent(scale: tuple[float, ...]) -> None:
    points, faces = stretched(trimesh.creation.icosphere(subdivisions=6), *scale)

    simplified = simplify(points, faces)

    assert simplified is not None
    assert len(simplified.corners) < len(points) / 2
    assert above(points[::5], simplified.corners) == pytest.approx(simplified.distance, rel=0.2)
    assert simplified.distance <= 2 * 2.5e-4 * max(scale)
    axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    lost = 1 - np.ptp(simplified.corners @ axes.T, axis=0) / np.ptp(points @ axes.T, axis=0)
    assert lost.max() < 5e-4  # of the thickness, too


def test_a_box_of_many_triangles_keeps_its_corners() -> None:
    box = trimesh.creation.box()
    for _ in range(6):
        box = box.subdivide()
    points, faces = stretched(box, 1, 2, 3)
    assert len(points) > MAX_CORNERS

    (corners,) = split_mesh(points, faces, fixed=False).corners

    assert len(corners) < 100
    assert above(points, corners) < 1e-6


def test_a_very_fine_mesh_is_reported(tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=6, radius=0.5).export(tmp_path / "ball.stl")
    (tmp_path / "ball.sdf").write_text("""<sdf version="1.6"><model name="m"><link name="l"><collision name="c">
<geometry><mesh><uri>ball.stl</uri></mesh></geometry></collision></link></model></sdf>""")

    sim = trundle.load(str(tmp_path / "ball.sdf"))

    (note,) = (finding.what for finding in sim.report.findings if "very fine" in finding.what)
    match = re.search(
        r"collision 'c': a very fine mesh; physics uses ([\d,]+) corners of 40,962, a surface up to 0.0002\d? m away$",
        note,
    )
    assert match is not None
    count = int(match[1].replace(",", ""))
    assert sim.engine.compiled.model.mesh_vertnum.tolist() == [count]
    assert compile_world(sim.world, Diagnostics(), cut_meshes=False).model.mesh_vertnum.tolist() == [count]
