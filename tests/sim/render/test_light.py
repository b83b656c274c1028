"""Lighting: shadows, lamps, highlights, haze."""

import math

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray
from tests.pictures import drawn

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Fog, Plane, Sphere
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, SceneLight, Shape, ShapeGeometry
from trundle.spatial import Pose

BLACK = (0.0, 0.0, 0.0, 1.0)
WHITE = (1.0, 1.0, 1.0, 1.0)
DOWN = Pose.from_rpy(0.0, 0.0, 10.0, 0.0, math.pi / 2, 0.0)
"""From 10 m above, the world's +x up in the picture, its +y left."""
LENS = Intrinsics(width_px=200, height_px=200, horizontal_fov_rad=2.0 * math.atan(0.5))
"""20 px a metre at 10 m."""
GROUND = Shape(name="ground", body=0, geometry=Plane((0.0, 0.0, 1.0), (0.0, 0.0)), rgba=WHITE)
SUN = SceneLight(direction=(0.0, 0.0, -1.0), diffuse=(0.5, 0.5, 0.5, 1.0), casts_shadows=True)


def picture(*shapes: Shape, lights: tuple[SceneLight, ...] = (SUN,), **scene: object) -> NDArray[np.uint8]:
    """Image from above."""
    native = NativeRenderer(replace(Scene(bodies=("b",), shapes=shapes, lights=lights, ambient=BLACK), **scene))
    native.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    return drawn(native, DOWN, LENS).rgb


def at(rgb: NDArray[np.uint8], x: float, y: float) -> list[int]:
    """Color of the ground at a point."""
    return rgb[int(100 - 20 * x), int(100 - 20 * y)].tolist()


def leaning(degrees: float) -> SceneLight:
    """A sun that leans, its light going towards +x."""
    lean = math.radians(degrees)
    return replace(SUN, direction=(math.sin(lean), 0.0, -math.cos(lean)))


def block(x: float = 0.0, z: float = 1.0, side: float = 1.0) -> Shape:
    return Shape(name="block", body=0, geometry=Box((side, side, side)), body_from_shape=Pose((x, 0.0, z)), rgba=WHITE)


def test_diffuse_light_follows_lamberts_law() -> None:
    assert at(picture(GROUND), 1.0, 1.0) == [128, 128, 128]
    assert at(picture(GROUND, lights=(leaning(60.0),)), 1.0, 1.0) == pytest.approx([64, 64, 64], abs=1)


def test_a_mesh_with_normals_is_lit_as_a_smooth_surface() -> None:
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=3, radius=3.0)
    flat = Mesh(ball.vertices.astype(np.float32), ball.faces.astype(np.int32))
    smooth = replace(flat, normals=flat.vertices[flat.faces] * 7.0)
    lamp = (replace(leaning(30.0), specular=WHITE, casts_shadows=False),)

    def lit(geometry: ShapeGeometry) -> NDArray[np.float64]:
        probe = Shape(name="s", body=0, geometry=geometry, rgba=WHITE, specular=(0.5, 0.5, 0.5, 1.0))
        return picture(probe, lights=lamp, background=BLACK)[60:140, 60:140].astype(float)

    round_one = lit(Sphere(3.0))
    assert np.abs(lit(smooth) - round_one).mean() < 0.5
    assert np.abs(lit(flat) - round_one).mean() > 2.0
    assert (lit(replace(flat, normals=np.zeros((1280, 3, 3), dtype=np.float32))) == lit(flat)).all()


def test_shadows_are_where_the_sun_is_hidden() -> None:
    # The block spans x ±0.5, z 0.5 to 1.5; at 45° its shadow lies from x = 0 to 2, half of it below the block.
    rgb = picture(GROUND, block(), lights=(leaning(45.0),))
    lit = at(rgb, -2.0, 0.0)
    assert at(rgb, 1.0, 0.0) == [0, 0, 0]
    assert at(rgb, 1.9, 0.3) == [0, 0, 0]
    assert at(rgb, 2.1, 0.0) == at(rgb, 1.0, 0.6) == lit == pytest.approx([90, 90, 90], abs=1)


def test_the_edge_of_a_shadow_is_exact_to_a_centimetre() -> None:
    close = replace(LENS, horizontal_fov_rad=2.0 * math.atan(0.05))  # 200 px a metre
    native = NativeRenderer(Scene(bodies=("b",), shapes=(GROUND, block()), lights=(leaning(45.0),), ambient=BLACK))
    native.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    rgb = drawn(native, Pose.from_rpy(2.0, 0.0, 10.0, 0.0, math.pi / 2, 0.0), close).rgb[:, 100, 0].astype(float)
    dark = float((90.0 - rgb).sum() / 90.0)  # rows in the shade, from the lowest, x = 1.5, up
    assert 1.5 + dark / 200.0 == pytest.approx(2.0, abs=0.01)


def test_lit_surfaces_do_not_shadow_themselves() -> None:
    ball = Shape(name="ball", body=0, geometry=Sphere(2.0), body_from_shape=Pose((0.0, 0.0, 2.0)), rgba=WHITE)
    native = picture(ball, lights=(leaning(30.0),)).astype(int)
    plain = picture(ball, lights=(replace(leaning(30.0), casts_shadows=False),)).astype(int)
    assert (np.abs(native - plain).max(axis=2) > 8).mean() < 0.001


@pytest.mark.parametrize("change", [{"casts_shadow": False}, {"rgba": (1.0, 1.0, 1.0, 0.5)}])
def test_glass_and_shapes_without_casts_shadow_cast_no_shadow(change: dict[str, object]) -> None:
    rgb = picture(GROUND, replace(block(), **change), lights=(leaning(45.0),))
    assert at(rgb, 1.9, 0.0) == at(rgb, -2.0, 0.0)


def test_shadows_follow_moving_bodies() -> None:
    native = NativeRenderer(
        Scene(bodies=("still", "moving"), shapes=(GROUND, replace(block(), body=1)), lights=(leaning(45.0),))
    )
    here = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
    images = []
    for x in (0.0, 2.0, 0.0):
        native.update(np.array([here, [x, *here[1:]]]))
        images.append(drawn(native, DOWN, LENS).rgb)
    assert at(images[0], 1.9, 0.0) != at(images[0], 3.9, 0.0)
    assert at(images[0], 1.9, 0.0) == at(images[1], 3.9, 0.0)
    assert (images[0] == images[2]).all()


def test_a_point_light_dims_with_distance_and_ends_at_its_range() -> None:
    lamp = SceneLight(kind="point", position=(0.0, 0.0, 1.0), diffuse=WHITE, attenuation=(0.5, 0.5, 0.5), range_m=2.5)
    rgb = picture(GROUND, lights=(lamp,))
    # Pixel centres lie half a pixel off the axis.
    distance, straight = math.sqrt(1.0 + 2.0 * 0.025**2), 1.0
    below = 255.0 * (straight / distance) / (0.5 + 0.5 * distance + 0.5 * distance**2)
    assert at(rgb, 0.01, 0.01)[0] == pytest.approx(below, abs=1)
    distance = math.sqrt(1.0 + 2.025**2 + 0.025**2)
    assert at(rgb, 2.01, 0.01)[0] == pytest.approx(255.0 / distance / (0.5 + 0.5 * distance + 0.5 * distance**2), abs=1)
    assert at(rgb, 2.4, 0.0) == [0, 0, 0]


def test_a_spot_light_lights_its_cone_with_shadows() -> None:
    spot = SceneLight(
        kind="spot",
        position=(0.0, 0.0, 4.0),
        diffuse=WHITE,
        inner_angle_rad=2.0 * math.atan(0.25),
        outer_angle_rad=2.0 * math.atan(0.5),
        casts_shadows=True,
    )
    rgb = picture(GROUND, lights=(spot,))
    assert at(rgb, 0.0, 0.0)[0] == pytest.approx(255, abs=1)
    assert 10 < at(rgb, 1.5, 0.0)[0] < at(rgb, 1.2, 0.0)[0] < 250
    assert at(rgb, 2.1, 0.0) == [0, 0, 0]
    # A block of 0.2 m, 2 m below the lamp, is twice as large in its shadow 4 m below.
    shaded = picture(GROUND, block(x=0.5, z=2.0, side=0.2), lights=(spot,))
    assert at(shaded, 1.1, 0.0) == [0, 0, 0]
    assert at(shaded, 1.1, 0.4)[0] > 100
    assert at(shaded, 0.6, 0.4) == at(rgb, 0.6, 0.4)


def test_a_light_moves_with_its_body() -> None:
    lamp = SceneLight(kind="point", body=1, position=(0.0, 0.0, 1.0), diffuse=WHITE, range_m=1.5)
    native = NativeRenderer(Scene(bodies=("b", "car"), shapes=(GROUND,), lights=(lamp,), ambient=BLACK))
    native.update(np.array([[0.0, 0, 0, 1, 0, 0, 0], [2.0, 0, 0, 1, 0, 0, 0]]))
    rgb = drawn(native, DOWN, LENS).rgb
    assert at(rgb, 2.0, 0.0)[0] > 200
    assert at(rgb, 0.0, 0.0) == [0, 0, 0]


def test_ambient_specular_and_emitted_light_add_up() -> None:
    plain = replace(GROUND, rgba=BLACK, ambient=(0.5, 0.25, 0.0, 1.0), emissive=(0.0, 0.0, 0.25, 1.0))
    assert at(picture(plain, ambient=(0.4, 0.4, 0.4, 1.0)), 1.0, 1.0) == pytest.approx([51, 26, 64], abs=1)
    glossy = replace(plain, specular=WHITE, shininess=20.0)
    shine = replace(SUN, specular=WHITE)
    rgb = picture(glossy, lights=(shine,))
    # Seen from right above, a mirror of the sun; at 3 m the half vector leans half of atan(0.3).
    assert at(rgb, 0.0, 0.0)[0] == pytest.approx(255, abs=1)
    lean = math.atan(math.hypot(3.0, 0.025) / 10.0) / 2.0
    assert at(rgb, 3.025, 0.0)[0] == pytest.approx(255 * math.cos(lean) ** 20, abs=3)


@pytest.mark.parametrize(
    ("fog", "clear"),
    [
        (Fog(type="linear", start_m=5.0, end_m=25.0), 0.75),
        (Fog(type="exponential", density=0.1), math.exp(-1.0)),
        (Fog(type="quadratic", density=0.1), math.exp(-1.0)),
        (Fog(), 1.0),
    ],
)
def test_fog_hides_distant_shapes(fog: Fog, clear: float) -> None:
    rgb = picture(GROUND, fog=replace(fog, color=(0.0, 0.0, 1.0, 1.0)))
    assert at(rgb, 1.0, 1.0) == pytest.approx([127.5 * clear, 127.5 * clear, 127.5 * clear + 255 * (1 - clear)], abs=1)


def test_the_sky_is_a_gradient_from_the_horizon_up() -> None:
    native = NativeRenderer(Scene(bodies=(), shapes=(), sky=((1.0, 1.0, 1.0, 1.0), (0.0, 0.0, 1.0, 1.0))))
    native.update(np.empty((0, 7)))
    red = drawn(native, Pose(), LENS).rgb[:, 100, 0].astype(int)
    assert (red[100:] == 255).all()
    assert (np.diff(red[:99]) >= 0).all()
    assert red[0] < 200
    assert drawn(native, Pose.from_rpy(0.0, 0.0, 0.0, 0.0, -math.pi / 2, 0.0), LENS).rgb[100, 100].tolist() == [
        0,
        0,
        255,
    ]
