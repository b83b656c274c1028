"""Camera projections: the pinhole images to render, and their composition into the camera's image."""

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import CameraOptics, Distortion
from trundle.sim.render import Intrinsics, Picture
from trundle.spatial import Pose

from .lens import CUBE, directions_through
from .remap import Remap

_Array = NDArray[np.float64]
_ROUNDS = 60
_STILL = 1e-9
_CLOSE = 1e-5
"""Accepted residual of the inverse [m at 1 m depth]: a hundredth of a pixel for most cameras."""
_STEEPEST = math.tan(math.radians(85.0))
"""Largest slope of a ray from the axis in a rendered pinhole image."""
_MAX_PX = 1 << 25
_MAX_ALONG = 8190
"""Largest distance from the image centre to its border [px]."""
_MIN_SCALE = 1e-7


class CameraProjection(Protocol):
    """Projection of a camera."""

    @property
    def pinhole_views(self) -> list[tuple[Pose, Intrinsics]]:
        """Pinhole views to render, all of one size: camera_from_face and intrinsics."""
        ...

    def compose(self, pictures: list[Picture]) -> Picture:
        """Compose the camera's image from the rendered views."""
        ...

    def slopes(self) -> tuple[_Array, _Array]:
        """Return the slopes of each pixel's ray, to the right and down: (height, width) each, [m] at 1 m depth."""
        ...


class PinholeProjection:
    """Pinhole projection: the image as rendered."""

    def __init__(self, intrinsics: Intrinsics) -> None:
        self.pinhole_views = [(Pose(), intrinsics)]

    def compose(self, pictures: list[Picture]) -> Picture:
        """See `CameraProjection.compose`."""
        return pictures[0]

    def slopes(self) -> tuple[_Array, _Array]:
        """See `CameraProjection.slopes`."""
        ((_, lens),) = self.pinhole_views
        columns, rows = _pixels(lens.width_px, lens.height_px)
        f = lens.focal_px
        return (columns - lens.width_px / 2) / f, (rows - lens.height_px / 2) / f


class DistortedProjection:
    """Pinhole with distortion, a shifted principal point, skew or non-square pixels."""

    def __init__(self, optics: CameraOptics, intrinsics: Intrinsics, *, crop: bool) -> None:
        """Compute each pixel's ray, and the pinhole view that covers them all."""
        columns, rows = _pixels(optics.width_px, optics.height_px)
        f, pinhole, distortion = intrinsics.focal_px, optics.intrinsics, optics.distortion
        if pinhole is None:
            right, down, is_valid = _gazebo_slopes(columns, rows, f, distortion, crop=crop)
        else:
            f = max(pinhole.fx, pinhole.fy)
            down = (rows - pinhole.cy) / pinhole.fy
            right = (columns - pinhole.cx - pinhole.skew * down) / pinhole.fx
            right, down, is_valid = undistorted(right, down, distortion)
        self._right, self._down = right, down
        is_valid &= (np.abs(self._right) < _STEEPEST) & (np.abs(self._down) < _STEEPEST)
        face = _covering_intrinsics(self._right[is_valid], self._down[is_valid], f, intrinsics)
        self.pinhole_views = [(Pose(), face)]
        ahead = np.ones_like(self._right)
        directions = np.stack([ahead, -self._right, -self._down], axis=-1)
        self._remap = Remap(self.pinhole_views, directions, is_valid)

    def compose(self, pictures: list[Picture]) -> Picture:
        """See `CameraProjection.compose`."""
        return self._remap.compose(pictures)

    def slopes(self) -> tuple[_Array, _Array]:
        """See `CameraProjection.slopes`."""
        return self._right, self._down


class WideAngleProjection:
    """Wide-angle lens, sampled from the faces of a cube map in its view."""

    def __init__(self, optics: CameraOptics, intrinsics: Intrinsics) -> None:
        lens = optics.lens
        assert lens is not None, "not a wide-angle camera"
        width, height = optics.width_px, optics.height_px
        columns, rows = _pixels(width, height)
        half = width / 2
        x, y = (columns - half) / half, (rows - height / 2) / half
        directions, is_valid = directions_through(lens, optics.horizontal_fov_rad, x, y)
        # Two extra pixels beyond 90°: interpolation stays within one face.
        size = lens.face_px + 2
        fov = 2.0 * math.atan(size / lens.face_px)
        face = Intrinsics(
            width_px=size,
            height_px=size,
            horizontal_fov_rad=fov,
            near_m=intrinsics.near_m,
            far_m=intrinsics.far_m,
        )
        self._remap = Remap([(side, face) for side in CUBE], directions, is_valid)
        self.pinhole_views = self._remap.pinhole_views

    def compose(self, pictures: list[Picture]) -> Picture:
        """See `CameraProjection.compose`."""
        return self._remap.compose(pictures)

    def slopes(self) -> tuple[_Array, _Array]:
        """Raise: a wide-angle ray may have no slope."""
        raise AssertionError("depths are seen through pinholes only")


def projection_of(optics: CameraOptics, intrinsics: Intrinsics, *, crop: bool = True) -> CameraProjection:
    """Return the projection of a camera.

    Args:
        optics: camera's optics.
        intrinsics: pinhole with the same field of view.
        crop: True: for negative `k1`, enlarge the image until no border is black, as in Gazebo.
    """
    if optics.lens is not None:
        return WideAngleProjection(optics, intrinsics)
    if optics.intrinsics is not None or optics.distortion != Distortion():
        return DistortedProjection(optics, intrinsics, crop=crop)
    return PinholeProjection(intrinsics)


def _gazebo_slopes(
    columns: _Array, rows: _Array, focal: float, distortion: Distortion, *, crop: bool
) -> tuple[_Array, _Array, NDArray[np.bool_]]:
    """Return the slopes to the right and down of each pixel's ray, and a mask of the valid ones.

    Gazebo 11's distortion map is square for any aspect ratio: the image is stretched to a square of its longer side,
    distorted and stretched back. The crop scale is the distorted length of that square's diagonal.
    """
    height, width = columns.shape
    side = max(width, height) / focal
    middle = distortion.center
    scale = (1.0, 1.0)
    if crop and distortion.k1 < 0.0:
        low, high = (-middle[0] * side, -middle[1] * side), ((1.0 - middle[0]) * side, (1.0 - middle[1]) * side)
        left, top = distorted(np.array(low[0]), np.array(low[1]), distortion)
        right, bottom = distorted(np.array(high[0]), np.array(high[1]), distortion)
        scale = (float(right - left) / side, float(bottom - top) / side)
        if min(scale) < _MIN_SCALE:  # as in Gazebo, no crop
            scale = (1.0, 1.0)
    u, v = (
        ((pixel / size - 0.5) * factor + 0.5 - center) * side
        for pixel, size, factor, center in zip((columns, rows), (width, height), scale, middle, strict=True)
    )
    across, along, is_valid = undistorted(u, v, distortion)
    right = across * width / focal / side + (middle[0] - 0.5) * width / focal
    return right, along * height / focal / side + (middle[1] - 0.5) * height / focal, is_valid


def _pixels(width: int, height: int) -> tuple[_Array, _Array]:
    """Return the columns and rows of the pixel centres, (height, width) each."""
    columns, rows = np.arange(width, dtype=np.float64) + 0.5, np.arange(height, dtype=np.float64) + 0.5
    return np.tile(columns, (height, 1)), np.repeat(rows[:, None], width, axis=1)


def _covering_intrinsics(right: _Array, down: _Array, focal: float, intrinsics: Intrinsics) -> Intrinsics:
    """Return a pinhole that covers all slopes, at the camera's resolution if the size limits allow it."""
    across = float(np.abs(right).max(initial=1e-3))
    along = float(np.abs(down).max(initial=1e-3))
    focal = min(focal, math.sqrt(_MAX_PX / (4.0 * across * along)), _MAX_ALONG / max(across, along))
    width, height = (2 * (math.ceil(focal * slope) + 1) for slope in (across, along))
    return Intrinsics(
        width_px=width,
        height_px=height,
        horizontal_fov_rad=2.0 * math.atan(width / (2.0 * focal)),
        near_m=intrinsics.near_m,
        far_m=intrinsics.far_m,
    )


def undistorted(right: _Array, down: _Array, distortion: Distortion) -> tuple[_Array, _Array, NDArray[np.bool_]]:
    """Return the undistorted slopes and a mask of the valid ones: beyond a fold the distortion has no inverse."""
    x, y = right.copy(), down.copy()
    with np.errstate(all="ignore"):
        for _ in range(_ROUNDS):
            radial, dx, dy = _terms(x, y, distortion)
            last, x, y = x, (right - dx) / radial, (down - dy) / radial
            if np.all(np.abs(x - last) < _STILL):
                break
        back_x, back_y = distorted(x, y, distortion)
        is_valid = (np.abs(back_x - right) < _CLOSE) & (np.abs(back_y - down) < _CLOSE)
    return np.where(is_valid, x, 0.0), np.where(is_valid, y, 0.0), is_valid


def distorted(x: _Array, y: _Array, distortion: Distortion) -> tuple[_Array, _Array]:
    """Return the distorted slopes, as in OpenCV's plumb_bob."""
    radial, dx, dy = _terms(x, y, distortion)
    return x * radial + dx, y * radial + dy


def _terms(x: _Array, y: _Array, d: Distortion) -> tuple[_Array, _Array, _Array]:
    r2 = x * x + y * y
    radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3))
    dx = 2.0 * d.p1 * x * y + d.p2 * (r2 + 2.0 * x * x)
    dy = d.p1 * (r2 + 2.0 * y * y) + 2.0 * d.p2 * x * y
    return radial, dx, dy
