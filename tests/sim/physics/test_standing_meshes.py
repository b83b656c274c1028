"""Static surfaces: slabs behind their faces, few of them, and quickly compiled."""

from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.sim.physics import compile_mjcf
from trundle.sim.physics.convex import mesh_decomposition, splitting
from trundle.sim.physics.convex.hulls import hull_of
from trundle.sim.physics.convex.mesh_decomposition import WorldDecomposition, convex_pieces
from trundle.sim.physics.convex.patches import convex_patches
from trundle.sim.render import scene_from_world
from trundle.sim.simulation import Simulation
from trundle.spatial import Twist

Mesh = tuple[NDArray[np.float64], NDArray[np.intp]]


def strip(triangles: int, *, noise: float = 0.0005) -> Mesh:
    """A wavy track 2 m wide along x, from 0 on; the same each time."""
    columns = 25
    rows = triangles // (2 * (columns - 1)) + 1
    x, y = np.meshgrid(np.arange(rows) * 0.1, np.linspace(-1, 1, columns), indexing="ij")
    z = 0.2 * np.sin(0.7 * x) + 0.05 * np.sin(3 * y + x) + np.random.default_rng(3).normal(0, noise, x.shape)
    corner = np.arange(rows * columns, dtype=np.intp).reshape(rows, columns)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    faces = np.concatenate([np.stack(three, axis=-1).reshape(-1, 3) for three in ((a, b, c), (a, c, d))])
    return np.stack([x, y, z], axis=-1, dtype=np.float64).reshape(-1, 3), faces


def surface_height(mesh: Mesh, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N,) height of the surface [m] at points (N, 2), each above one triangle of it."""
    a, b, c = (mesh[0][mesh[1][:, i]] for i in range(3))
    heights = np.full(len(points), np.nan)
    base = np.stack([(b - a)[:, :2], (c - a)[:, :2]], axis=-1)
    for i, point in enumerate(points):
        u, v = np.linalg.solve(base, (point - a[:, :2])[..., None])[..., 0].T
        (inside,) = np.nonzero((u >= 0) & (v >= 0) & (u + v <= 1))
        t = inside[0]
        heights[i] = a[t, 2] + u[t] * (b - a)[t, 2] + v[t] * (c - a)[t, 2]
    return heights


@pytest.fixture(autouse=True)
def _empty_caches() -> Iterator[None]:
    mesh_decomposition.clear_cache()
    yield
    mesh_decomposition.clear_cache()


def test_patches_represent_the_surface_exactly() -> None:
    mesh = strip(480)
    points = np.random.default_rng(1).uniform((0.05, -0.95), (0.95, 0.95), (200, 2))
    expected = surface_height(mesh, points)
    solids = [hull for piece in convex_pieces(*mesh, fixed=True).corners if (hull := hull_of(piece)) is not None]
    heights = np.full(len(points), -np.inf)
    for solid in solids:
        # Where a line down at each place enters the solid.
        slopes = solid.normals[:, 2]
        distances = solid.offsets[:, None] - solid.normals[:, :2] @ points.T
        with np.errstate(divide="ignore", invalid="ignore"):
            entries = distances / slopes[:, None]
        top = np.where(slopes[:, None] > 1e-9, entries, np.inf).min(axis=0)
        bottom = np.where(slopes[:, None] < -1e-9, entries, -np.inf).max(axis=0)
        is_outside = (np.where(np.abs(slopes[:, None]) <= 1e-9, distances, 0.0) < 0).any(axis=0)
        heights = np.where((top >= bottom) & ~is_outside, np.maximum(heights, top), heights)
    assert heights == pytest.approx(expected, abs=2e-4)


def test_a_bulge_is_one_patch_and_a_hollow_many() -> None:
    points, faces = strip(480, noise=0.0)
    x, y = points[:, 0] - 0.5, points[:, 1]
    counts: list[int] = []
    for bend in (-0.002, 0.002):
        points[:, 2] = bend * (x * x + y * y)
        patches = convex_patches(points, faces, depth=0.0025)
        assert patches.counts.sum() == len(faces)
        counts.append(len(patches.sizes))
    bulge, hollow = counts
    assert bulge < len(faces) / 6
    assert hollow > bulge
    points[:, 2] = 0.5 * (x * x + y * y)  # 5 mm up over each edge of 10 cm
    assert convex_patches(points, faces, depth=0.0025).counts.max() == 2  # the two of each quadrangle, which is flat


def load(folder: Path, mesh: Mesh, *, radius: float = 0.1) -> Simulation:
    points, faces = mesh
    text = [f"v {x:.5f} {y:.5f} {z:.5f}" for x, y, z in points] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    (folder / "track.obj").write_text("\n".join(text))
    file = folder / "w.world"
    file.write_text(
        '<sdf version="1.6"><world name="w"><model name="track"><static>1</static><link name="l"><collision name="c">'
        "<geometry><mesh><uri>track.obj</uri></mesh></geometry></collision></link></model><model name='ball'><pose>"
        "1 0 0.6 0 0 0</pose><link name='l'><inertial><mass>1</mass><inertia><ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004"
        "</izz></inertia></inertial><collision name='c'><geometry><sphere>"
        f"<radius>{radius}</radius></sphere></geometry>"
        "</collision></link></model></world></sdf>"
    )
    return trundle.load(str(file))


def test_a_track_compiles_to_its_surface_for_any_number_of_hulls_per_spec(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = strip(2400)
    sim = load(tmp_path, mesh)
    count = sim.engine.compiled.geom_collisions.count("track::l::c")
    assert 1000 < count < 0.7 * len(mesh[1])
    names = {f"track::l::c#{i}" for i in range(count)}
    assert {sim.engine.compiled.model.geom(i).name for i in range(count + 1)} == {*names, "ball::l::c"}
    sim.run(0.6)
    before = sim["ball"].pose
    x, y, z = before.position
    assert z - surface_height(mesh, np.array([[x, y]]))[0] == pytest.approx(0.1, abs=0.01)
    monkeypatch.setattr("trundle.sim.physics.compile.convex_geoms._FEW", 10**6)  # one by one
    sim = load(tmp_path, mesh)
    sim.run(0.6)
    assert sim["ball"].pose == before


@pytest.mark.parametrize("speed", [3.0, 10.0, 14.0])
@pytest.mark.parametrize("radius", [0.004, 0.02, 0.03])
def test_a_fast_small_body_does_not_tunnel_through_a_slab(tmp_path: Path, radius: float, speed: float) -> None:
    mesh = strip(960, noise=0.0)
    sim = load(tmp_path, mesh, radius=radius)
    sim["ball"].set_twist(Twist((0.0, 0.0, -speed)))
    sim.run(0.3)
    assert sim["ball"].pose.position[2] > surface_height(mesh, np.array([sim["ball"].pose.position[:2]]))[0]


def test_a_track_is_as_large_in_mjcf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.sim.physics.compile.convex_geoms._MANY", 400)
    sim = load(tmp_path, strip(2400))
    text = compile_mjcf(sim.world, scene_from_world(sim.world, Diagnostics()), Diagnostics())
    assert mujoco.MjModel.from_xml_string(text).ngeom == sim.engine.compiled.model.ngeom


@pytest.mark.slow
def test_a_track_of_50_000_triangles_is_its_surface(tmp_path: Path) -> None:
    mesh = strip(50_000)
    sim = load(tmp_path, mesh)
    assert 1000 < sim.engine.compiled.geom_collisions.count("track::l::c") < 0.7 * len(mesh[1])
    sim.run(0.6)
    x, y, z = sim["ball"].pose.position
    assert z - surface_height(mesh, np.array([[x, y]]))[0] == pytest.approx(0.1, abs=0.01)


def test_static_meshes_share_the_limit_of_slabs(monkeypatch: pytest.MonkeyPatch) -> None:
    # Two tracks of some 1300 slabs, and slabs for one.
    monkeypatch.setattr(mesh_decomposition, "MAX_SLABS", 2000)
    first, second = strip(2400), strip(2448)
    world = WorldDecomposition()
    world.decompose_all([(*first, True), (*second, True)])
    counts = [len(world.pieces_of(*mesh, fixed=True).pieces.corners) for mesh in (first, second)]
    assert counts[0] > 1000
    assert counts[1] == 1
    assert [error.is_filled for error in world.pieces_of(*second, fixed=True).pieces.errors] == [True]


def test_a_fine_static_mesh_close_to_its_hull_becomes_the_hull(monkeypatch: pytest.MonkeyPatch) -> None:
    points, faces = strip(480, noise=0.0)
    points[:, 2] /= 100
    monkeypatch.setattr(splitting, "MAX_PIECES", 50)
    assert len(convex_pieces(points, faces, fixed=True).corners) == 1
