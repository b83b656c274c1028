"""Images on shapes."""

import math
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray
from PIL import Image
from tests.pictures import drawn

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cylinder, Plane, Sphere
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, SceneLight, Shape, ShapeGeometry
from trundle.spatial import Pose

WHITE = (1.0, 1.0, 1.0, 1.0)
RED, GREEN, BLUE, YELLOW = [255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]
LENS = Intrinsics(width_px=200, height_px=200, horizontal_fov_rad=2.0 * math.atan(0.5))


@pytest.fixture
def quarters(tmp_path: Path) -> Path:
    """Red and green above, blue and yellow below."""
    corners = np.array([[RED, GREEN], [BLUE, YELLOW]], dtype=np.uint8)
    Image.fromarray(corners.repeat(32, axis=0).repeat(32, axis=1)).save(tmp_path / "quarters.png")
    return tmp_path / "quarters.png"


def rendered(geometry: ShapeGeometry, texture: Path | bytes, view: Pose, **change: object) -> NDArray[np.uint8]:
    """A shape in ambient light alone."""
    shape = replace(Shape(name="s", body=0, geometry=geometry, rgba=WHITE, texture=texture), **change)
    dark = SceneLight(diffuse=(0.0, 0.0, 0.0, 1.0))
    native = NativeRenderer(Scene(bodies=("b",), shapes=(shape,), lights=(dark,), ambient=WHITE))
    native.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    return drawn(native, view, LENS).rgb


def corners(rgb: NDArray[np.uint8], away: int = 30) -> list[list[int]]:
    """Colors to the upper left, upper right, lower left and lower right of the middle."""
    low, high = 100 - away, 100 + away
    return [rgb[row, column].tolist() for row in (low, high) for column in (low, high)]


FROM_PLUS_X = Pose.from_rpy(10.0, 0.0, 0.0, 0.0, 0.0, math.pi)
FROM_ABOVE = Pose.from_rpy(0.0, 0.0, 10.0, 0.0, math.pi / 2, math.pi / 2)
"""The world's +y up in the picture, its +x to the right."""


def square(uv: tuple[tuple[float, float], ...]) -> Mesh:
    """4 m by 4 m in the plane x = 0, seen from +x."""
    vertices = np.array([[0, -2, -2], [0, 2, -2], [0, 2, 2], [0, -2, 2]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    return Mesh(vertices, faces, uv=np.array(uv, dtype=np.float32)[faces])


def test_a_mesh_is_textured_by_its_uv_coordinates(quarters: Path) -> None:
    mesh = square(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    assert corners(rendered(mesh, quarters, FROM_PLUS_X)) == [RED, GREEN, BLUE, YELLOW]
    turned = square(((1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)))
    assert corners(rendered(turned, quarters, FROM_PLUS_X)) == [BLUE, RED, YELLOW, GREEN]


def test_a_texture_repeats_also_at_negative_coordinates(quarters: Path) -> None:
    twice = square(((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)))
    rgb = rendered(twice, quarters, FROM_PLUS_X)
    assert corners(rgb, 10) == [YELLOW, BLUE, GREEN, RED]
    assert corners(rgb, 33) == [RED, GREEN, BLUE, YELLOW]


def test_a_mesh_without_uv_coordinates_is_plain(quarters: Path) -> None:
    bare = replace(square(((0.0, 0.0),) * 4), uv=None)
    assert corners(rendered(bare, quarters, FROM_PLUS_X)) == [[255, 255, 255]] * 4


@pytest.mark.parametrize("view", [FROM_PLUS_X, FROM_ABOVE, Pose.from_rpy(0.0, -10.0, 0.0, 0.0, 0.0, math.pi / 2)])
def test_every_face_of_a_box_shows_the_image_upright(quarters: Path, view: Pose) -> None:
    assert corners(rendered(Box((4.0, 4.0, 4.0)), quarters, view)) == [RED, GREEN, BLUE, YELLOW]


def test_planes_spheres_and_cylinders_are_textured(quarters: Path) -> None:
    assert corners(rendered(Plane((0.0, 0.0, 1.0), (4.0, 4.0)), quarters, FROM_ABOVE)) == [RED, GREEN, BLUE, YELLOW]
    behind = Pose.from_rpy(0.0, 10.0, 0.0, 0.0, 0.0, -math.pi / 2)  # the image's first half goes around by +y
    assert corners(rendered(Sphere(2.0), quarters, behind), 15) == [RED, RED, BLUE, BLUE]
    assert corners(rendered(Sphere(2.0), quarters, FROM_PLUS_X), 15) == [GREEN, RED, YELLOW, BLUE]
    assert corners(rendered(Cylinder(2.0, 4.0), quarters, FROM_ABOVE), 15) == [RED, GREEN, BLUE, YELLOW]


def test_far_surfaces_show_the_mean_of_a_texture(tmp_path: Path) -> None:
    board = np.indices((256, 256)).sum(axis=0) % 2 * 255
    Image.fromarray(board.astype(np.uint8)).convert("RGB").save(tmp_path / "board.png")
    mesh = square(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    grey = rendered(mesh, tmp_path / "board.png", FROM_PLUS_X)[70:130, 70:130]
    assert np.abs(grey.astype(int) - 128).max() <= 2


def test_a_color_tints_the_texture(quarters: Path) -> None:
    mesh = square(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    tinted = rendered(mesh, quarters, FROM_PLUS_X, ambient=(0.5, 0.5, 0.5, 1.0))
    assert corners(tinted)[3] == [128, 128, 0]


def test_light_beyond_white_shows_the_unlit_texture(quarters: Path) -> None:
    mesh = square(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    grey = quarters.with_name("grey.png")
    Image.new("RGB", (8, 8), (100, 150, 200)).save(grey)
    for bright in ({"ambient": (5.0, 5.0, 5.0, 1.0)}, {"emissive": WHITE}):
        assert corners(rendered(mesh, grey, FROM_PLUS_X, **bright))[0] == [100, 150, 200]


def test_a_scale_enlarges_the_texture_about_its_middle(quarters: Path) -> None:
    mesh = square(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    halved = rendered(mesh, quarters, FROM_PLUS_X, texture_scale=(0.5, 1.0))
    assert corners(halved, 10) == [RED, GREEN, BLUE, YELLOW]
    assert corners(halved, 30) == [GREEN, RED, YELLOW, BLUE]


def test_an_image_inside_a_mesh_file_is_drawn(quarters: Path) -> None:
    mesh = square(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    assert corners(rendered(mesh, quarters.read_bytes(), FROM_PLUS_X)) == [RED, GREEN, BLUE, YELLOW]


def test_an_unreadable_texture_leaves_the_shape_plain(tmp_path: Path) -> None:
    (tmp_path / "broken.png").write_bytes(b"no image")
    assert corners(rendered(Box((4.0, 4.0, 4.0)), tmp_path / "broken.png", FROM_PLUS_X)) == [[255, 255, 255]] * 4
