"""Heavy meshes, far away."""

import numpy as np
import pytest
import trimesh
from tests import pictures

from trundle.robots.meshes import Mesh
from trundle.robots.model import Plane
from trundle.sim.render import Intrinsics, NativeRenderer, Picture, Scene, SceneLight, Shape
from trundle.spatial import Pose

LENS = Intrinsics(width_px=160, height_px=120, horizontal_fov_rad=1.0)
SUN = SceneLight(direction=(0.5, -0.4, -0.8), casts_shadows=True)


def bumpy(level: int) -> Mesh:
    """A ball of half a metre with hills."""
    ball = trimesh.creation.icosphere(subdivisions=level)
    unit = ball.vertices / np.linalg.norm(ball.vertices, axis=1, keepdims=True)
    radius = 0.25 + 0.02 * np.sin(9 * unit[:, :1]) * np.cos(7 * unit[:, 1:2])
    return Mesh(
        (unit * radius).astype(np.float32), ball.faces.astype(np.int32), normals=unit.astype(np.float32)[ball.faces]
    )


def drawn(mesh: Mesh, away: float, *, every: bool = False) -> Picture:
    """Depths use every triangle, and so does an image with depths."""
    ground = Shape(name="g", body=0, geometry=Plane((0.0, 0.0, 1.0), (0.0, 0.0)), rgba=(0.6, 0.6, 0.5, 1.0))
    ball = Shape(name="m", body=1, geometry=mesh, rgba=(0.8, 0.5, 0.3, 1.0))
    native = NativeRenderer(
        Scene(bodies=("a", "b"), shapes=(ground, ball), lights=(SUN,), ambient=(0.3, 0.3, 0.3, 1.0))
    )
    native.update(np.array([[0.0, 0, 0, 1, 0, 0, 0], [away, 0.1, 0.3, 1, 0, 0, 0]]))
    eye = Pose.from_rpy(0.0, 0.0, 1.0, 0.0, float(np.arctan2(0.7, away)), 0.0)
    return pictures.drawn(native, eye, LENS, depth=every, segmentation=every)


@pytest.fixture(scope="module")
def heavy() -> Mesh:
    """81,920 triangles."""
    return bumpy(6)


@pytest.mark.parametrize("away", [4.0, 8.0, 20.0])
def test_a_coarser_mesh_looks_equal_from_far_away(heavy: Mesh, away: float) -> None:
    few, all_of_it = drawn(heavy, away).rgb.astype(int), drawn(heavy, away, every=True)
    off = np.abs(few - all_of_it.rgb.astype(int)).max(axis=2)
    assert all_of_it.segmentation is not None
    covered = (all_of_it.segmentation == 1).sum()
    assert covered >= 3
    assert off.max() > 0  # it is another mesh
    assert (off > 48).sum() <= max(2, 0.03 * covered)
    assert off.sum() / covered < 6.0


def test_a_near_mesh_is_drawn_in_full_detail(heavy: Mesh) -> None:
    assert (drawn(heavy, 0.8).rgb == drawn(heavy, 0.8, every=True).rgb).all()


def test_a_small_mesh_is_never_simplified() -> None:
    mesh = bumpy(4)
    assert (drawn(mesh, 20.0).rgb == drawn(mesh, 20.0, every=True).rgb).all()


def test_a_deformed_mesh_is_drawn_in_full_detail(heavy: Mesh) -> None:
    ball = Shape(name="m", body=0, geometry=heavy)
    native = NativeRenderer(Scene(bodies=("a",), shapes=(ball,)))
    native.update(np.array([[8.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    small = pictures.drawn(native, Pose(), LENS).rgb
    native.set_vertices(0, 2.0 * heavy.vertices)
    large = pictures.drawn(native, Pose(), LENS).rgb
    assert (large == pictures.drawn(native, Pose(), LENS, segmentation=True).rgb).all()
    assert (large != large[0, 0]).sum() > 3 * (small != small[0, 0]).sum()


def test_rays_hit_the_full_mesh(heavy: Mesh) -> None:
    ball = Shape(name="m", body=0, geometry=heavy)
    native = NativeRenderer(Scene(bodies=("a",), shapes=(ball,)))
    native.update(np.array([[20.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    directions = np.stack([np.ones(50), np.linspace(-0.01, 0.01, 50), np.zeros(50)], axis=-1)
    directions = (directions / np.linalg.norm(directions, axis=1, keepdims=True)).astype(np.float32)
    before, _ = native.cast(Pose(), directions, max_range_m=50.0)
    pictures.drawn(native, Pose(), LENS)
    after, _ = native.cast(Pose(), directions, max_range_m=50.0)
    assert before.tobytes() == after.tobytes()
