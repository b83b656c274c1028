"""The page's picture of a world has the colors, lights and shadows of the camera renderer's."""

import math
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray
from PIL import Image
from tests.skinned import bending_column
from tests.web.conftest import WorldPage

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.page.actor_bones import ActorBones
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cylinder, Fog, Plane, Sphere
from trundle.sim.gltf import glb_from_scene
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, SceneLight, Shape, scene_from_world, update_skins
from trundle.spatial import Pose

_SIZE = (480, 360)
_FOV = 1.0
_VERTICAL_FOV = 2 * math.atan(math.tan(_FOV / 2) * _SIZE[1] / _SIZE[0])
_EYE, _YAW, _PITCH = (-4.0, -1.0, 2.2), 0.2, 0.4
_SUN = SceneLight(
    direction=(0.4, 0.3, -0.866), diffuse=(0.7, 0.7, 0.6, 1), specular=(0.3, 0.3, 0.3, 1), casts_shadows=True
)
_LAMP = SceneLight(
    kind="point", position=(0.5, -1.5, 1.5), diffuse=(0.3, 0.1, 0.1, 1), attenuation=(0.5, 0.1, 0.05), range_m=8.0
)
_SPOT = SceneLight(
    kind="spot",
    position=(-0.5, 1.0, 3.0),
    direction=(0.196, 0.0, -0.98),
    diffuse=(0.1, 0.3, 0.4, 1),
    inner_angle_rad=0.4,
    outer_angle_rad=0.9,
    casts_shadows=True,
)


_BENDER = """<sdf version="1.6"><world name="w"><actor name="bender"><pose>0 0 0 0 0 0.4</pose>
<skin><filename>column.dae</filename></skin><animation name="bend"><filename>column.dae</filename></animation>
</actor></world></sdf>"""


def _scene(texture: Path) -> Scene:
    tent = np.array([[-0.4, -0.4, 0], [0.4, -0.4, 0], [0.4, 0.4, 0], [-0.4, 0.4, 0], [0, 0, 0.9]], dtype=np.float32)
    faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]], dtype=np.int32)
    shapes = (
        Shape(name="ground", body=0, geometry=Plane((0, 0, 1), (30, 30)), rgba=(0.6, 0.65, 0.6, 1)),
        Shape(name="box", body=1, geometry=Box((0.8, 0.8, 0.8)), rgba=(0.2, 0.3, 0.8, 1), ambient=(0.1, 0.3, 0.8, 1)),
        Shape(
            name="ball",
            body=2,
            geometry=Sphere(0.4),
            rgba=(0.8, 0.4, 0.1, 1),
            specular=(0.6, 0.6, 0.6, 1),
            shininess=30,
        ),
        Shape(name="can", body=3, geometry=Cylinder(0.3, 1.0), rgba=(1, 1, 1, 1), texture=texture),
        Shape(name="lamp", body=4, geometry=Box((0.3, 0.3, 0.3)), rgba=(0.1, 0.1, 0.1, 1), emissive=(0.2, 0.7, 0.1, 1)),
        Shape(name="tent", body=5, geometry=Mesh(vertices=tent, faces=faces), rgba=(0.7, 0.2, 0.5, 1)),
        Shape(name="glass", body=6, geometry=Box((0.1, 1.2, 1.0)), rgba=(0.2, 0.8, 0.8, 0.4)),
    )
    return Scene(bodies=tuple("abcdefg"), shapes=shapes, lights=(_SUN, _LAMP, _SPOT), ambient=(0.3, 0.3, 0.35, 1))


_POSES = np.array(
    [
        (0, 0, 0, 1, 0, 0, 0),
        (0.0, 0.2, 0.4, math.cos(0.3), 0, 0, math.sin(0.3)),
        (-0.8, -0.9, 0.4, 1, 0, 0, 0),
        (0.6, -1.6, 0.5, 1, 0, 0, 0),
        (-1.0, 0.9, 0.15, 1, 0, 0, 0),
        (1.5, 0.9, 0.0, 1, 0, 0, 0),
        (-1.6, -0.2, 0.5, 1, 0, 0, 0),
    ],
    dtype=np.float64,
)


def _camera_picture(renderer: NativeRenderer) -> tuple[NDArray[np.uint8], NDArray[np.int32]]:
    width, height = _SIZE
    intrinsics = Intrinsics(width_px=width, height_px=height, horizontal_fov_rad=_FOV, near_m=0.01, far_m=100)
    [picture] = renderer.render([(Pose.from_rpy(*_EYE, 0, _PITCH, _YAW), intrinsics)], segmentation=True)
    assert picture.segmentation is not None
    return picture.rgb, picture.segmentation


def _still(scene: Scene) -> NativeRenderer:
    renderer = NativeRenderer(scene)
    renderer.update(_POSES)
    return renderer


def _page_picture(page: WorldPage, folder: Path, scene: Scene, **manifest: object) -> NDArray[np.uint8]:
    (folder / "world.glb").write_bytes(glb_from_scene(scene, _POSES))
    page.show(ambient=scene.ambient[:3], background=scene.background[:3], sky=scene.sky is not None, **manifest)
    page.look(_EYE, yaw=_YAW, pitch=_PITCH, vertical_fov=_VERTICAL_FOV)
    return page.picture()


def _inner(segments: NDArray[np.int32], number: int) -> NDArray[np.bool_]:
    """Return the pixels of a shape that are more than 2 px inside its outline."""
    mask = segments == number
    for axis in (0, 1):
        for shift in (-2, -1, 1, 2):
            mask &= np.roll(segments, shift, axis) == number
    return mask


@pytest.fixture
def texture(tmp_path: Path) -> Path:
    """Return a smooth texture."""
    x, y = np.meshgrid(np.linspace(0, 1, 64), np.linspace(0, 1, 64))
    pixels = np.stack([255 * x, 255 * y, 128 + 0 * x], axis=-1).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / "texture.png")
    return tmp_path / "texture.png"


def _assert_same_look(
    scene: Scene, expected: NDArray[np.uint8], actual: NDArray[np.uint8], segments: NDArray[np.int32]
) -> None:
    """Compare the shapes' inner pixels; edges of faces and shadows are smoother on the page."""
    difference = np.abs(expected.astype(float) - actual.astype(float)).mean(axis=-1)
    for number in range(-1, len(scene.shapes)):
        inner = difference[_inner(segments, number)]
        name = "background" if number < 0 else scene.shapes[number].name
        if inner.size:
            assert inner.mean() <= 1.0, name
            assert (inner > 8).mean() <= 0.03, name


def test_a_world_looks_the_same_on_the_page_and_in_a_camera(
    world_page: WorldPage, tmp_path: Path, texture: Path
) -> None:
    """The world has primitives, a mesh, a texture, glass, and three kinds of lights with shadows."""
    scene = _scene(texture)
    expected, segments = _camera_picture(_still(scene))

    actual = _page_picture(world_page, tmp_path, scene)

    assert (segments == scene.shapes.index(next(shape for shape in scene.shapes if shape.name == "box"))).any()
    _assert_same_look(scene, expected, actual, segments)


@pytest.mark.parametrize("kind", ["linear", "exponential", "quadratic"])
def test_sky_and_fog_look_the_same_as_in_a_camera(
    world_page: WorldPage, tmp_path: Path, texture: Path, kind: Literal["linear", "exponential", "quadratic"]
) -> None:
    """The sky is behind the fog."""
    fog = Fog(type=kind, color=(0.5, 0.5, 0.6, 1), start_m=2.0, end_m=9.0, density=0.2)
    sky = ((0.86, 0.91, 0.96, 1.0), (0.30, 0.52, 0.82, 1.0))
    scene = replace(_scene(texture), fog=fog, sky=sky, lights=())
    expected, segments = _camera_picture(_still(scene))

    fields = {"type": kind, "color": [0.5, 0.5, 0.6], "start": 2.0, "end": 9.0, "density": 0.2}
    actual = _page_picture(world_page, tmp_path, scene, fog=fields)

    _assert_same_look(scene, expected, actual, segments)


def test_an_actors_skin_bends_on_the_page_as_in_a_camera(world_page: WorldPage, tmp_path: Path) -> None:
    """A column that bends in its middle is compared upright and bent."""
    (tmp_path / "column.dae").write_text(bending_column())
    (tmp_path / "w.sdf").write_text(_BENDER)
    sim = trundle.load(str(tmp_path / "w.sdf"))
    scene = replace(scene_from_world(sim.world, Diagnostics()), lights=(_SUN,), ambient=(0.3, 0.3, 0.35, 1))
    bones = ActorBones(sim.world)
    renderer = NativeRenderer(scene)
    (tmp_path / "world.glb").write_bytes(glb_from_scene(scene, sim.snapshot().poses))
    world_page.show(ambient=scene.ambient[:3], background=scene.background[:3], sky=False)
    world_page.look(_EYE, yaw=_YAW, pitch=_PITCH, vertical_fov=_VERTICAL_FOV)
    shapes: list[NDArray[np.bool_]] = []
    for seconds in (0.0, 0.9):
        sim.run(seconds)
        renderer.update(sim.snapshot().poses)
        update_skins(renderer, scene, sim.animation_state)
        expected, segments = _camera_picture(renderer)

        world_page.move(bones.with_bones(sim.snapshot().poses, sim.animation_state))
        actual = world_page.picture()

        _assert_same_look(scene, expected, actual, segments)
        shapes.append(segments == 0)
    assert (shapes[0] != shapes[1]).sum() > 0.2 * shapes[0].sum()


def test_a_plane_under_a_low_sun_has_no_dark_speckles(world_page: WorldPage, tmp_path: Path, texture: Path) -> None:
    """Shadow maps shade convex shapes evenly, even at grazing light."""
    sun = SceneLight(direction=(0.96, 0.0, -0.28), diffuse=(1, 1, 1, 1), casts_shadows=True)
    slab = Shape(name="slab", body=1, geometry=Box((4.0, 4.0, 0.2)), rgba=(0.9, 0.9, 0.9, 1))
    ball = Shape(name="ball", body=2, geometry=Sphere(0.4), rgba=(0.9, 0.9, 0.9, 1))
    scene = replace(_scene(texture), shapes=(slab, ball), lights=(sun,))
    _, segments = _camera_picture(_still(scene))

    actual = _page_picture(world_page, tmp_path, scene)

    top = actual[_inner(segments, 0)][:, 0].astype(int)
    lit = np.median(top)
    shadow = (top < lit - 40).mean()
    assert 0.0 < shadow < 0.3
    assert np.logical_and(top < lit - 3, top > lit - 30).mean() < 0.01
