"""Lenses, distortion and pixels that are not square, against geometry."""

import math

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.robots.model import CameraOptics, Distortion, Lens, PixelIntrinsics
from trundle.sim.render import Intrinsics, Picture
from trundle.sim.sensors.cameras.lens import fits
from trundle.sim.sensors.cameras.pixel_formats import FORMATS, pixels_in
from trundle.sim.sensors.cameras.projection import (
    CameraProjection,
    PinholeProjection,
    distorted,
    projection_of,
    undistorted,
)
from trundle.spatial import Pose

WIDTH, HEIGHT, FOV = 64, 48, 1.2


def optics(**rest: object) -> CameraOptics:
    return replace(CameraOptics(width_px=WIDTH, height_px=HEIGHT, horizontal_fov_rad=FOV), **rest)


def pinhole(camera: CameraOptics) -> Intrinsics:
    fov = min(camera.horizontal_fov_rad, 3.0)
    return Intrinsics(width_px=camera.width_px, height_px=camera.height_px, horizontal_fov_rad=fov)


def pixels_that_see(view: CameraProjection, mark: tuple[float, float, float]) -> NDArray[np.int_]:
    """(row, column) of the pixels that show a distant bright spot in a direction of the camera's frame."""
    return np.argwhere(view.compose([_spot(face, size, mark) for face, size in view.pinhole_views]).rgb[..., 0] > 60)


def _spot(camera_from_face: Pose, size: Intrinsics, mark: tuple[float, float, float]) -> Picture:
    """Renderer of black with a bright spot in one direction."""
    rgb = np.zeros((size.height_px, size.width_px, 3), dtype=np.uint8)
    x, y, z = camera_from_face.inverse().transform_vector(mark)
    if x > 0.0:
        column, row = size.width_px / 2 - size.focal_px * y / x, size.height_px / 2 - size.focal_px * z / x
        half = max(1, size.width_px // 80)
        if half <= column < size.width_px - half and half <= row < size.height_px - half:
            rgb[int(row) - half : int(row) + half + 1, int(column) - half : int(column) + half + 1] = 255
    return Picture(rgb)


def test_a_pinhole_camera_needs_no_remap() -> None:
    assert isinstance(projection_of(optics(), pinhole(optics())), PinholeProjection)


@pytest.mark.parametrize(
    ("fun", "c1", "c2", "radius"),
    [
        ("tan", 1.0, 1.0, lambda a: math.tan(a)),
        ("tan", 2.0, 2.0, lambda a: 2 * math.tan(a / 2)),
        ("id", 1.0, 1.0, lambda a: a),
        ("sin", 2.0, 2.0, lambda a: 2 * math.sin(a / 2)),
        ("sin", 1.0, 1.0, lambda a: math.sin(a)),
    ],
    ids=["gnomonical", "stereographic", "equidistant", "equisolid_angle", "orthographic"],
)
@pytest.mark.parametrize("turned", [0.0, 2.0])
def test_a_lens_maps_rays_by_its_function(fun: str, c1: float, c2: float, radius, turned: float) -> None:
    """Scaled so that the half width holds half the field of view; a ray off the axis, in any direction about it."""
    fov, angle = 2.4, 0.7
    camera = optics(horizontal_fov_rad=fov, lens=Lens(c1=c1, c2=c2, fun=fun, face_px=512), width_px=256, height_px=256)
    mark = (math.cos(angle), -math.sin(angle) * math.cos(turned), -math.sin(angle) * math.sin(turned))

    pixel = pixels_that_see(projection_of(camera, pinhole(camera)), mark).mean(axis=0)

    r = 128 * radius(angle) / radius(fov / 2)
    expected = (127.5 + r * math.sin(turned), 127.5 + r * math.cos(turned))
    assert pixel == pytest.approx(expected, abs=0.7)


def test_a_lens_with_a_focal_length_is_not_scaled() -> None:
    """r = f θ with f = 0.5: a ray at 1 rad is seen a quarter of the width from the middle."""
    lens = Lens(c1=1.0, c2=1.0, fun="id", f=0.5, scale_to_hfov=False, face_px=512)
    camera = optics(lens=lens, width_px=256, height_px=256)

    pixel = pixels_that_see(projection_of(camera, pinhole(camera)), (math.cos(1.0), -math.sin(1.0), 0.0)).mean(axis=0)

    assert pixel == pytest.approx((127.5, 127.5 + 64.0), abs=0.7)


def test_a_fisheye_lens_sees_backwards_up_to_its_cutoff() -> None:
    lens = Lens(c1=1.0, c2=1.0, fun="id", face_px=64)
    behind = (-0.5, 0.5, 0.7)
    for cutoff, sees in ((1.5707, False), (3.2, True)):
        camera = optics(horizontal_fov_rad=6.2, lens=replace(lens, cutoff_rad=cutoff), width_px=128, height_px=128)
        view = projection_of(camera, pinhole(camera))
        assert (len(pixels_that_see(view, behind)) > 0) == sees
        assert len(view.pinhole_views) == (6 if sees else 5)


def test_a_gnomonical_lens_does_not_see_beyond_90_degrees() -> None:
    assert not fits(Lens(c1=1.0, c2=1.0, fun="tan"), math.pi)
    assert fits(Lens(c1=2.0, c2=2.0, fun="tan"), math.pi)


BENT = Distortion(k1=-0.25, k2=0.12, k3=0.01, p1=-0.0028, p2=0.005)


def test_undistortion_is_exact() -> None:
    right, down = np.meshgrid(np.linspace(-0.6, 0.6, 13), np.linspace(-0.4, 0.4, 9))
    x, y, sound = undistorted(right, down, BENT)

    assert sound.all()
    back = distorted(x, y, BENT)
    assert np.abs(back[0] - right).max() < 1e-8
    assert np.abs(back[1] - down).max() < 1e-8


def test_pixels_beyond_the_fold_of_a_distortion_are_invalid() -> None:
    """r (1 − r²) is never more than 0.385."""
    _, _, sound = undistorted(np.array([0.38, 0.39]), np.zeros(2), Distortion(k1=-1.0))
    assert sound.tolist() == [True, False]


@pytest.mark.parametrize("center", [(0.5, 0.5), (0.4, 0.6)])
def test_a_distorted_square_camera_agrees_with_opencvs_model(center: tuple[float, float]) -> None:
    """Distortion is about its centre, which does not move."""
    camera = optics(distortion=replace(BENT, center=center), width_px=320, height_px=320)
    f = pinhole(camera).focal_px
    cx, cy = 320 * center[0], 320 * center[1]
    right, down = 0.45, -0.3
    right_of_centre, below = (cx - 160) / f, (cy - 160) / f
    x, y = distorted(np.array([right - right_of_centre]), np.array([down - below]), BENT)

    pixel = pixels_that_see(projection_of(camera, pinhole(camera), crop=False), (1.0, -right, -down)).mean(axis=0)

    assert pixel == pytest.approx((cy + f * float(y[0]) - 0.5, cx + f * float(x[0]) - 0.5), abs=0.7)


@pytest.mark.parametrize(("width", "height"), [(320, 240), (240, 320)])
def test_distortion_acts_in_a_square_of_the_longer_side_as_in_gazebo(width: int, height: int) -> None:
    """Stretched to the picture afterwards: 0.1 of a short side is seen where 0.1 of the long one would be."""
    camera = optics(distortion=BENT, width_px=width, height_px=height)
    f = pinhole(camera).focal_px
    right, down = 0.3 * width / 320, -0.2 * height / 320
    x, y = distorted(np.array([0.3]), np.array([-0.2]), BENT)

    pixel = pixels_that_see(projection_of(camera, pinhole(camera), crop=False), (1.0, -right, -down)).mean(axis=0)

    row, column = height / 2 + f * float(y[0]) * height / 320, width / 2 + f * float(x[0]) * width / 320
    assert pixel == pytest.approx((row - 0.5, column - 0.5), abs=0.8)


def test_a_cropped_barrel_image_ends_at_the_undistorted_corners() -> None:
    """Gazebo's border crop: each corner shows what the pinhole's shows, and nothing is black."""
    camera = optics(distortion=Distortion(k1=-0.3), width_px=320, height_px=240)
    right, down = 160 / pinhole(camera).focal_px, 120 / pinhole(camera).focal_px

    cropped, whole = projection_of(camera, pinhole(camera)), projection_of(camera, pinhole(camera), crop=False)

    across, along = cropped.slopes()
    assert (across[0, 0], along[0, 0]) == pytest.approx((-right, -down), rel=0.02)
    assert (across[-1, -1], along[-1, -1]) == pytest.approx((right, down), rel=0.02)
    assert np.abs(across).max() <= right
    assert np.abs(along).max() <= down
    assert np.abs(whole.slopes()[0]).max() > right * 1.05


def test_other_distortions_are_not_cropped() -> None:
    camera = optics(distortion=Distortion(k1=0.2))
    assert (
        projection_of(camera, pinhole(camera)).slopes()[0]
        == projection_of(camera, pinhole(camera), crop=False).slopes()[0]
    ).all()


def test_pixel_intrinsics_shift_stretch_and_skew_the_image() -> None:
    camera = optics(intrinsics=PixelIntrinsics(fx=200.0, fy=150.0, cx=140.0, cy=130.0, skew=20.0), width_px=320)
    camera = replace(camera, height_px=240)
    right, down = 0.3, -0.2

    pixel = pixels_that_see(projection_of(camera, pinhole(camera)), (1.0, -right, -down)).mean(axis=0)

    column, row = 200 * right + 20 * down + 140, 150 * down + 130
    assert pixel == pytest.approx((row - 0.5, column - 0.5), abs=0.9)


def test_depths_and_segmentation_are_not_interpolated() -> None:
    camera = optics(distortion=BENT)
    view = projection_of(camera, pinhole(camera))
    ((_, size),) = view.pinhole_views
    halves = np.zeros((size.height_px, size.width_px), dtype=np.int32)
    halves[:, size.width_px // 2 :] = 5
    rgb = np.zeros((*halves.shape, 3), dtype=np.uint8)

    picture = view.compose([Picture(rgb, halves.astype(np.float32), halves)])

    assert picture.segmentation is not None
    assert picture.depth is not None
    assert set(np.unique(picture.segmentation)) == {0, 5}
    assert (picture.depth == picture.segmentation).all()


@pytest.mark.parametrize(
    ("name", "encoding", "upper_left"),
    [
        ("L8", "mono8", [[(299 * 10 + 587 * 20 + 114 * 30 + 500) // 1000]]),
        ("L16", "mono16", [[257 * ((299 * 10 + 587 * 20 + 114 * 30 + 500) // 1000)]]),
        ("B8G8R8", "bgr8", [[[30, 20, 10]]]),
        ("R16G16B16", "rgb16", [[[2570, 5140, 7710]]]),
        ("BAYER_RGGB8", "bayer_rggb8", [[10, 20], [20, 30]]),
        ("BAYER_BGGR8", "bayer_bggr8", [[30, 20], [20, 10]]),
        ("BAYER_GBRG8", "bayer_gbrg8", [[20, 30], [10, 20]]),
        ("BAYER_GRBG8", "bayer_grbg8", [[20, 10], [30, 20]]),
    ],
)
def test_formats_convert_colors(name: str, encoding: str, upper_left: list) -> None:
    rgb = np.tile(np.array([10, 20, 30], dtype=np.uint8), (4, 6, 1))
    pixels, told = pixels_in(name, rgb)

    corner = np.array(upper_left)
    assert told == encoding
    assert pixels.shape[:2] == (4, 6)
    assert pixels[: corner.shape[0], : corner.shape[1]].tolist() == upper_left
    assert pixels.dtype == (np.uint16 if "16" in encoding else np.uint8)


def test_every_format_keeps_the_image_size() -> None:
    rgb = np.zeros((5, 7, 3), dtype=np.uint8)
    assert {pixels_in(name, rgb)[0].shape[:2] for name in FORMATS} == {(5, 7)}
