"""Images of cameras."""

import math
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray
from tests.pictures import drawn

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Rgba, Sphere
from trundle.sim.render import Intrinsics, NativeRenderer, Scene, SceneLight, Shape, ShapeGeometry
from trundle.spatial import Pose

RED: Rgba = (1.0, 0.0, 0.0, 1.0)
GREEN: Rgba = (0.0, 1.0, 0.0, 1.0)
WIDE = Intrinsics(width_px=320, height_px=240, horizontal_fov_rad=1.047)
HEADLIGHT = (SceneLight(direction=(1.0, 0.0, 0.0), diffuse=(0.6, 0.6, 0.6, 1.0)),)


def shape(geometry: ShapeGeometry, pose: Pose | None = None, rgba: Rgba = RED, body: int = 0) -> Shape:
    return Shape(name="s", body=body, geometry=geometry, body_from_shape=pose or Pose(), rgba=rgba)


def scene(*shapes: Shape, bodies: int = 1) -> Scene:
    names = tuple(f"b{i}" for i in range(bodies))
    return Scene(bodies=names, shapes=shapes, lights=HEADLIGHT, background=(0.2, 0.4, 0.6, 1.0))


def renderer(*shapes: Shape) -> NativeRenderer:
    """Renderer of shapes on one body at the origin."""
    native = NativeRenderer(scene(*shapes))
    native.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    return native


def is_red(rgb: NDArray[np.uint8]) -> NDArray[np.bool_]:
    return (rgb[..., 0] > 50) & (rgb[..., 1] == 0) & (rgb[..., 2] == 0)


def centroid(mask: NDArray[np.bool_]) -> tuple[float, float]:
    """Column, row."""
    rows, columns = np.nonzero(mask)
    return float(columns.mean()), float(rows.mean())


def test_a_sphere_ahead_is_a_disc_in_the_middle_of_the_right_size() -> None:
    picture = drawn(renderer(shape(Sphere(0.5), Pose((4.0, 0.0, 0.0)))), Pose(), WIDE)
    mask = is_red(picture.rgb)
    assert centroid(mask) == pytest.approx((159.5, 119.5), abs=0.01)
    # Its rim is seen where the line of sight touches it: tan = r / sqrt(d² - r²). Pixels cut the area to 1 %.
    radius = WIDE.focal_px * 0.5 / math.sqrt(16.0 - 0.25)
    assert mask.sum() == pytest.approx(math.pi * radius**2, rel=0.01)


def test_depth_is_along_the_view_axis_and_infinite_in_the_background() -> None:
    picture = drawn(renderer(shape(Sphere(0.5), Pose((4.0, 0.0, 0.0)))), Pose(), WIDE, depth=True)
    assert picture.depth is not None
    assert picture.depth.shape == (240, 320)
    assert picture.depth[119:121, 159:161] == pytest.approx(3.5, abs=1e-3)
    assert np.isinf(picture.depth[0, 0])
    assert (np.isfinite(picture.depth) == is_red(picture.rgb)).all()
    # A wall is equally deep everywhere, though its corners are farther away.
    wall = drawn(renderer(shape(Box((0.2, 20.0, 20.0)), Pose((3.0, 0.0, 0.0)))), Pose(), WIDE, depth=True)
    assert wall.depth is not None
    assert wall.depth == pytest.approx(2.9, abs=1e-5)


def test_depth_is_rendered_on_request_only() -> None:
    assert drawn(renderer(shape(Sphere(0.5))), Pose(), WIDE).depth is None


@pytest.mark.parametrize(
    ("position", "column_sign", "row_sign"),
    [((4.0, 1.0, 0.0), -1, 0), ((4.0, -1.0, 0.0), 1, 0), ((4.0, 0.0, 1.0), 0, -1), ((4.0, 0.0, -1.0), 0, 1)],
)
def test_y_is_left_of_the_image_and_z_is_up(
    position: tuple[float, float, float], column_sign: int, row_sign: int
) -> None:
    column, row = centroid(is_red(drawn(renderer(shape(Sphere(0.2), Pose(position))), Pose(), WIDE).rgb))
    # A sphere off the axis is seen a little farther out than its centre: 1 px.
    shift = WIDE.focal_px * 1.0 / 4.0
    assert (column - 159.5, row - 119.5) == pytest.approx((column_sign * shift, row_sign * shift), abs=1.0)


def test_the_camera_looks_along_its_own_x() -> None:
    native = renderer(shape(Sphere(0.5), Pose((1.0, 6.0, 2.0))))
    picture = drawn(native, Pose.from_rpy(1.0, 2.0, 2.0, 0.0, 0.0, math.pi / 2), WIDE)
    assert centroid(is_red(picture.rgb)) == pytest.approx((159.5, 119.5), abs=0.1)


def test_the_background_has_the_scenes_color() -> None:
    picture = drawn(renderer(shape(Sphere(0.5), Pose((-4.0, 0.0, 0.0)))), Pose(), WIDE)
    assert picture.rgb.dtype == np.uint8
    assert picture.rgb.shape == (240, 320, 3)
    assert (picture.rgb == (51, 102, 153)).all()


def test_an_empty_scene_is_background() -> None:
    native = NativeRenderer(scene(bodies=0))
    native.update(np.empty((0, 7)))
    assert (drawn(native, Pose(), WIDE).rgb == (51, 102, 153)).all()


def test_shapes_outside_the_clip_distances_are_not_drawn() -> None:
    native = renderer(shape(Sphere(0.5), Pose((4.0, 0.0, 0.0))))
    for near, far in ((3.9, 100.0), (0.1, 3.4)):
        clipped = Intrinsics(width_px=64, height_px=48, horizontal_fov_rad=0.2, near_m=near, far_m=far)
        centre = drawn(native, Pose(), clipped).rgb[20:28, 28:36]
        assert (centre == (51, 102, 153)).all()
    clear = Intrinsics(width_px=64, height_px=48, horizontal_fov_rad=0.2, near_m=3.4, far_m=3.6)
    assert is_red(drawn(native, Pose(), clear).rgb[20:28, 28:36]).all()


def test_near_shapes_hide_far_ones() -> None:
    front = shape(Sphere(0.3), Pose((3.0, 0.0, 0.0)))
    behind = shape(Sphere(0.9), Pose((6.0, 0.0, 0.0)), GREEN)
    for order in ((front, behind), (behind, front)):
        rgb = drawn(renderer(*order), Pose(), WIDE).rgb
        assert is_red(rgb)[120, 160]
        assert rgb[120, 160 + 38, 1] > 50


def test_a_shape_is_drawn_in_front_of_the_ground() -> None:
    ground = shape(Plane((0.0, 0.0, 1.0), (100.0, 100.0)), rgba=GREEN)
    post = shape(Box((0.2, 0.2, 1.0)), Pose((5.0, 0.0, 0.5)))
    picture = drawn(renderer(ground, post), Pose((0.0, 0.0, 1.0)), WIDE, depth=True)
    rgb = picture.rgb
    assert picture.depth is not None
    assert is_red(rgb)[120 + 20, 160]
    assert rgb[-1, 0, 1] > 50
    assert (rgb[10, 160] == (51, 102, 153)).all()
    # The bottom row looks 119.5 px down: the ground is f / 119.5 ahead for each metre of height.
    assert picture.depth[-1, 0] == pytest.approx(WIDE.focal_px / 119.5, rel=1e-4)


def test_a_plane_seen_edge_on_or_from_below_is_not_drawn() -> None:
    ground = shape(Plane((0.0, 0.0, 1.0), (100.0, 100.0)), rgba=GREEN)
    level = drawn(renderer(ground), Pose((0.0, 0.0, 1.0)), WIDE)
    assert (level.rgb[:110] == (51, 102, 153)).all()
    assert (level.rgb[130:, :, 1] > 50).all()


def tetrahedron() -> Mesh:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float32) - 0.25
    return Mesh(vertices, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int32))


def cube(size: float) -> Mesh:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32) * np.float32(
        size / 2
    )
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]
    return Mesh(corners, np.array(faces, dtype=np.int32))


def test_a_single_triangle_is_drawn_and_one_without_area_is_not() -> None:
    corners = np.array([[4, -1, -1], [4, 1, -1], [4, 0, 1]], dtype=np.float32)
    face = np.array([[0, 2, 1]], dtype=np.int32)
    mask = is_red(drawn(renderer(shape(Mesh(corners, face))), Pose(), WIDE).rgb)
    # 2 m² at 4 m.
    assert mask.sum() == pytest.approx(2.0 * (WIDE.focal_px / 4.0) ** 2, rel=0.02)
    nothing = Mesh(np.zeros((3, 3), dtype=np.float32), face)
    assert (drawn(renderer(shape(nothing)), Pose(), WIDE).rgb == (51, 102, 153)).all()


def test_a_mesh_is_drawn_at_its_triangles() -> None:
    # Off centre and turned.
    offset = Mesh(cube(0.5).vertices + np.array([0.0, 0.7, 0.3], dtype=np.float32), cube(0.5).faces)
    pose = Pose.from_rpy(4.0, -0.2, 0.1, 0.3, 0.0, 0.0)
    as_mesh = drawn(renderer(shape(offset, pose)), Pose(), WIDE, depth=True)
    as_box = drawn(renderer(shape(Box((0.5, 0.5, 0.5)), pose @ Pose((0.0, 0.7, 0.3)))), Pose(), WIDE, depth=True)
    assert as_mesh.depth is not None
    assert as_box.depth is not None
    differ = is_red(as_mesh.rgb) ^ is_red(as_box.rgb)
    assert is_red(as_box.rgb).sum() > 500
    assert differ.sum() <= 8
    both = np.isfinite(as_mesh.depth) & np.isfinite(as_box.depth)
    assert as_mesh.depth[both] == pytest.approx(as_box.depth[both], abs=1e-4)


@pytest.mark.parametrize(
    "geometry",
    [
        Box((1.0, 1.0, 1.0)),
        Capsule(0.3, 0.6),
        Cylinder(0.4, 1.0),
        Ellipsoid((0.3, 0.4, 0.5)),
        Sphere(0.5),
        tetrahedron(),
    ],
    ids=lambda geometry: type(geometry).__name__,
)
def test_every_shape_is_drawn_from_every_side_at_its_position(geometry: ShapeGeometry) -> None:
    native = renderer(shape(geometry))
    for yaw in np.arange(0.0, 2 * math.pi, math.pi / 3):
        away = Pose.from_rpy(-3.0 * math.cos(yaw), -3.0 * math.sin(yaw), 0.0, 0.0, 0.0, float(yaw))
        picture = drawn(native, away, WIDE, depth=True)
        assert picture.depth is not None
        mask = np.isfinite(picture.depth)
        assert mask[120, 160]
        # All fit in a ball of 0.87 m.
        assert not mask[:, :60].any()
        assert picture.depth[mask].min() > 3.0 - 0.87
        assert picture.depth[mask].max() < 3.0 + 0.87


def test_a_shape_around_the_camera_fills_the_image() -> None:
    room = renderer(shape(cube(4.0)))
    picture = drawn(room, Pose(), WIDE, depth=True)
    assert picture.depth is not None
    assert (np.isinf(picture.depth) | (picture.depth <= 2.0 + 1e-5)).all()
    inside_box = drawn(renderer(shape(Box((0.2, 9.0, 9.0)), Pose((0.5, 0.0, 0.0)))), Pose(), WIDE, depth=True)
    assert inside_box.depth is not None
    assert inside_box.depth == pytest.approx(0.4, abs=1e-5)


def test_shapes_move_with_their_bodies() -> None:
    native = NativeRenderer(scene(shape(Sphere(0.3)), shape(Sphere(0.3), rgba=GREEN, body=1), bodies=2))
    poses = np.array([[4.0, 1.0, 0.0, 1, 0, 0, 0], [4.0, -1.0, 0.0, 1, 0, 0, 0]])
    native.update(poses)
    before = drawn(native, Pose(), WIDE).rgb
    native.update(poses[::-1])
    after = drawn(native, Pose(), WIDE).rgb
    assert centroid(is_red(before))[0] < 159
    assert centroid(is_red(after))[0] > 160


@pytest.mark.parametrize("geometry", [Sphere(0.5), cube(1.0), Plane((0.0, 0.0, 1.0), (0.0, 0.0))])
def test_a_body_without_a_pose_is_not_drawn(geometry: ShapeGeometry) -> None:
    """The pose of such a body is NaN."""
    native = NativeRenderer(scene(shape(geometry)))
    native.update(np.full((1, 7), np.nan))
    picture = drawn(native, Pose((0.0, 0.0, 1.0)), WIDE, depth=True)
    assert picture.depth is not None
    assert np.isinf(picture.depth).all()


def test_light_has_its_direction() -> None:
    lit_from_left = Scene(
        bodies=("b",),
        shapes=(shape(Sphere(0.5), Pose((4.0, 0.0, 0.0))),),
        lights=(SceneLight(direction=(0.0, -1.0, 0.0)),),
    )
    native = NativeRenderer(lit_from_left)
    native.update(np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]))
    red = drawn(native, Pose(), WIDE).rgb[120, :, 0].astype(int)
    assert red[160 - 25] > red[160 + 25] + 50


def test_glass_tints_the_background() -> None:
    pane = shape(Box((0.1, 9.0, 9.0)), Pose((2.0, 0.0, 0.0)), (0.0, 0.0, 1.0, 0.25))
    red = shape(Sphere(0.5), Pose((4.0, 0.0, 0.0)))
    without = drawn(renderer(red), Pose(), WIDE).rgb.astype(float)
    for order in ((pane, red), (red, pane)):
        picture = drawn(renderer(*order), Pose(), WIDE, depth=True, segmentation=True)
        glass = np.array([0.0, 0.0, 255.0])  # ambient and headlight together
        assert picture.rgb[120, 160] == pytest.approx(0.75 * without[120, 160] + 0.25 * glass, abs=1.0)
        assert picture.depth is not None
        assert picture.segmentation is not None
        assert picture.depth[120, 160] == pytest.approx(3.5, abs=1e-3)
        assert picture.segmentation[120, 160] == order.index(red)


def test_panes_are_blended_from_far_to_near() -> None:
    near = shape(Box((0.1, 9.0, 9.0)), Pose((2.0, 0.0, 0.0)), (1.0, 0.0, 0.0, 0.5))
    far = shape(Box((0.1, 9.0, 9.0)), Pose((3.0, 0.0, 0.0)), (0.0, 1.0, 0.0, 0.5))
    for order in ((near, far), (far, near)):
        rgb = drawn(renderer(*order), Pose(), WIDE).rgb[120, 160]
        assert rgb == pytest.approx([0.5 * 255 + 0.25 * 51, 0.25 * 255 + 0.25 * 102, 0.25 * 153], abs=1.5)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"width_px": 0, "height_px": 0}, "a picture is 1 to 16384 pixels wide and high, not 0 x 0"),
        ({"width_px": 100_000, "height_px": 100_000}, "not 100000 x 100000"),
        ({"horizontal_fov_rad": 0.0}, "a field of view is between 0 and 2 pi, not 0 rad"),
        ({"horizontal_fov_rad": 7.0}, "not 7 rad"),
        ({"horizontal_fov_rad": math.nan}, "not nan rad"),
        ({"near_m": 5.0, "far_m": 1.0}, "a camera needs 0 < near < far, not 5 m and 1 m"),
        ({"near_m": 1.0, "far_m": 1.0}, "not 1 m and 1 m"),
        ({"near_m": math.nan}, "not nan m and 100 m"),
    ],
)
def test_invalid_intrinsics_are_refused_with_a_reason(wrong: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        replace(WIDE, **wrong)


def test_poses_that_are_not_finite_are_refused() -> None:
    native = renderer(shape(Sphere(0.5)))
    nowhere = Pose((math.nan, 0.0, 0.0))
    with pytest.raises(ValueError, match="the pose of a camera is not finite"):
        drawn(native, nowhere, WIDE)
    with pytest.raises(ValueError, match="the origin of rays is not finite"):
        native.cast(nowhere, np.array([[1.0, 0.0, 0.0]]), max_range_m=1.0)


def test_a_million_triangles_without_area_are_not_drawn() -> None:
    faces = np.repeat(np.arange(1000, dtype=np.int32), 3000).reshape(-1, 3)
    assert len(faces) == 1_000_000
    vertices = np.random.default_rng(0).random((1000, 3)).astype(np.float32)
    native = renderer(shape(Mesh(vertices, faces)))
    assert (drawn(native, Pose((-3.0, 0.0, 0.0)), WIDE).rgb == (51, 102, 153)).all()
    assert np.isinf(native.cast(Pose((-3.0, 0.0, 0.0)), np.eye(3), max_range_m=9.0)[0]).all()


def test_equal_scenes_give_equal_bytes() -> None:
    parts = (
        shape(Sphere(0.5), Pose((4.0, 0.3, 0.1))),
        shape(cube(0.6), Pose.from_rpy(3.0, -0.5, 0.0, 0.1, 0.2, 0.3), GREEN),
    )
    first = drawn(renderer(*parts), Pose(), WIDE, depth=True)
    native = renderer(*parts)
    drawn(native, Pose((0.0, 1.0, 0.0)), WIDE)
    second = drawn(native, Pose(), WIDE, depth=True)
    assert first.rgb.tobytes() == second.rgb.tobytes()
    assert first.depth is not None
    assert second.depth is not None
    assert first.depth.tobytes() == second.depth.tobytes()


def test_a_deformed_mesh_is_drawn_and_hit_in_its_new_shape() -> None:
    """Faces without area may gain some, and the next shape keeps its indices."""
    square = np.array([[0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]], dtype=np.float32)
    faces = np.array([[0, 2, 1], [0, 3, 2]], dtype=np.int32)
    flat = Mesh(square * np.array([1, 1, 0], dtype=np.float32), faces)
    native = renderer(shape(flat, Pose((4.0, 0.0, 0.0))), shape(Sphere(0.3), Pose((3.0, 0.0, 0.0)), GREEN))
    ahead = np.array([[1.0, 0.0, 0.2]])
    ahead /= np.linalg.norm(ahead)

    assert not is_red(drawn(native, Pose(), WIDE).rgb).any()
    assert native.cast(Pose(), ahead, max_range_m=50)[1].tolist() == [-1]
    native.set_vertices(0, square)
    picture = drawn(native, Pose(), WIDE, segmentation=True)

    assert picture.segmentation is not None
    side = 2 * WIDE.focal_px / 4
    assert (picture.segmentation == 0).sum() + (picture.segmentation == 1).sum() == pytest.approx(side**2, rel=0.03)
    assert (picture.rgb[picture.segmentation == 1][:, 1] > 0).all()
    assert native.cast(Pose(), ahead, max_range_m=50)[1].tolist() == [0]
    native.set_vertices(0, square * np.array([1, 0.5, 0.5], dtype=np.float32))
    assert is_red(drawn(native, Pose(), WIDE).rgb).sum() < side**2 / 3


def test_only_meshes_can_be_deformed() -> None:
    native = renderer(shape(Sphere(0.3)))
    with pytest.raises(KeyError):
        native.set_vertices(0, np.zeros((3, 3), dtype=np.float32))


_AWAY = np.linspace(2.0, 5.0, 500)


@pytest.mark.parametrize(
    "away",
    [_AWAY, _AWAY[::-1], np.random.default_rng(1).permutation(_AWAY)],
    ids=["near first", "far first", "mixed"],
)
def test_the_nearest_of_many_triangles_is_drawn(away: NDArray[np.float64]) -> None:
    """Most of them are never drawn, whichever comes first."""
    triangle = np.array([[0.004, 0, 12], [0, 9, -9], [0, -9, -9]])
    vertices = (triangle + away[:, None, None] * np.array([1.0, 0.0, 0.0])).astype(np.float32)
    faces = np.arange(3 * len(away), dtype=np.int32).reshape(-1, 3)

    every = drawn(renderer(shape(Mesh(vertices.reshape(-1, 3), faces))), Pose(), WIDE, depth=True)
    alone = drawn(renderer(shape(Mesh(vertices[away.argmin()], faces[:1]))), Pose(), WIDE, depth=True)

    assert every.depth is not None
    assert alone.depth is not None
    assert np.isfinite(alone.depth).all()
    assert every.depth.tobytes() == alone.depth.tobytes()


def test_the_first_of_two_coincident_shapes_is_drawn() -> None:
    corners = np.array([[3, 1, -1], [3, -1, -1], [3, -1, 1], [3, 1, 1], [2, 1.2, 0], [2, 1.1, 0], [2, 1.1, 0.1]])
    wall = shape(Mesh(corners.astype(np.float32), np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6]], dtype=np.int32)))
    box = shape(Box((1.0, 1.0, 1.0)), Pose((3.5, 0.0, 0.0)), GREEN)
    middle = (slice(110, 130), slice(150, 170))

    assert is_red(drawn(renderer(wall, box), Pose(), WIDE).rgb[middle]).all()
    assert not is_red(drawn(renderer(box, wall), Pose(), WIDE).rgb[middle]).any()


def test_no_views_and_views_of_two_sizes_are_refused() -> None:
    native = renderer(shape(Sphere(0.5)))
    wider = replace(WIDE, width_px=WIDE.width_px + 1)
    for views in ([], [(Pose(), WIDE), (Pose(), wider)]):
        with pytest.raises(ValueError, match="a call draws one picture or more, all of one size"):
            native.render(views)
