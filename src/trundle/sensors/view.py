"""Ways that a camera looks: the pinhole pictures it needs, and the picture it makes of them."""

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from trundle.model import CameraOptics, Distortion
from trundle.render import Intrinsics, Picture
from trundle.spatial import Pose

from .lens import CUBE, directions_through
from .remap import Remap
from .undistort import undistorted

_Array = NDArray[np.float64]
_STEEPEST = math.tan(math.radians(85.0))
"""No pinhole picture reaches farther from its axis than this slope."""
_MOST_PX = 1 << 25


class View(Protocol):
    """How a camera looks."""

    @property
    def faces(self) -> list[tuple[Pose, Intrinsics]]:
        """The pinhole pictures it needs: camera_from_face, and their sizes."""
        ...

    def developed(self, pictures: list[Picture]) -> Picture:
        """The camera's own picture, made of those."""
        ...

    def slopes(self) -> tuple[_Array, _Array]:
        """How far to the right and down each pixel looks, (height, width) each, 1 m ahead [m]."""
        ...


class PinholeView:
    """One picture as it is drawn."""

    def __init__(self, intrinsics: Intrinsics) -> None:
        self.faces = [(Pose(), intrinsics)]

    def developed(self, pictures: list[Picture]) -> Picture:
        """See `View.developed`."""
        return pictures[0]

    def slopes(self) -> tuple[_Array, _Array]:
        """See `View.slopes`."""
        ((_, seen),) = self.faces
        columns, rows = _pixels(seen.width_px, seen.height_px)
        f = seen.focal_px
        return (columns - seen.width_px / 2) / f, (rows - seen.height_px / 2) / f


class BentView:
    """A pinhole picture that distortion bends, or whose middle or pixels are not as a renderer has them."""

    def __init__(self, optics: CameraOptics, intrinsics: Intrinsics) -> None:
        """Find where each pixel looks, and the pinhole picture that holds all of that."""
        width, height = optics.width_px, optics.height_px
        columns, rows = _pixels(width, height)
        f, pinhole, distortion = intrinsics.focal_px, optics.intrinsics, optics.distortion
        if pinhole is None:
            fx = fy = f
            middle = (distortion.center[0] * width, distortion.center[1] * height)
            right, down = (columns - middle[0]) / f, (rows - middle[1]) / f
            beside, below = (middle[0] - width / 2) / f, (middle[1] - height / 2) / f
        else:
            fx, fy = pinhole.fx, pinhole.fy
            down = (rows - pinhole.cy) / fy
            right = (columns - pinhole.cx - pinhole.skew * down) / fx
            beside = below = 0.0
        right, down, sound = undistorted(right, down, distortion)
        self._right, self._down = right + beside, down + below
        sound &= (np.abs(self._right) < _STEEPEST) & (np.abs(self._down) < _STEEPEST)
        face = _face(self._right[sound], self._down[sound], max(fx, fy), intrinsics)
        self.faces = [(Pose(), face)]
        ahead = np.ones_like(self._right)
        directions = np.stack([ahead, -self._right, -self._down], axis=-1)
        self._remap = Remap(self.faces, directions, sound)

    def developed(self, pictures: list[Picture]) -> Picture:
        """See `View.developed`."""
        return self._remap.developed(pictures)

    def slopes(self) -> tuple[_Array, _Array]:
        """See `View.slopes`."""
        return self._right, self._down


class WideView:
    """What a wide lens sees, looked up in those sides of a cube that it needs."""

    def __init__(self, optics: CameraOptics, intrinsics: Intrinsics) -> None:
        lens = optics.lens
        assert lens is not None, "not a wide-angle camera"
        width, height = optics.width_px, optics.height_px
        columns, rows = _pixels(width, height)
        half = width / 2
        x, y = (columns - half) / half, (rows - height / 2) / half
        directions, seen = directions_through(lens, optics.horizontal_fov_rad, x, y)
        # Two pixels more than a quarter turn: neighbours are looked up within one face.
        size = lens.face_px + 2
        fov = 2.0 * math.atan(size / lens.face_px)
        face = Intrinsics(
            width_px=size,
            height_px=size,
            horizontal_fov_rad=fov,
            near_m=intrinsics.near_m,
            far_m=intrinsics.far_m,
        )
        self._remap = Remap([(side, face) for side in CUBE], directions, seen)
        self.faces = self._remap.faces

    def developed(self, pictures: list[Picture]) -> Picture:
        """See `View.developed`."""
        return self._remap.developed(pictures)

    def slopes(self) -> tuple[_Array, _Array]:
        """A wide lens looks to where no slope leads."""
        raise AssertionError("depths are seen through pinholes only")


def view_of(optics: CameraOptics, intrinsics: Intrinsics) -> View:
    """How a camera with these optics looks."""
    if optics.lens is not None:
        return WideView(optics, intrinsics)
    if optics.intrinsics is not None or optics.distortion != Distortion():
        return BentView(optics, intrinsics)
    return PinholeView(intrinsics)


def _pixels(width: int, height: int) -> tuple[_Array, _Array]:
    """Columns and rows of the pixels' middles, (height, width) each."""
    columns, rows = np.arange(width, dtype=np.float64) + 0.5, np.arange(height, dtype=np.float64) + 0.5
    return np.tile(columns, (height, 1)), np.repeat(rows[:, None], width, axis=1)


def _face(right: _Array, down: _Array, focal: float, intrinsics: Intrinsics) -> Intrinsics:
    """A pinhole picture that holds all these slopes, as sharp as the camera's own if that is possible."""
    across = float(np.abs(right).max(initial=1e-3))
    along = float(np.abs(down).max(initial=1e-3))
    focal = min(focal, math.sqrt(_MOST_PX / (4.0 * across * along)))
    width, height = (2 * (math.ceil(focal * slope) + 1) for slope in (across, along))
    return Intrinsics(
        width_px=width,
        height_px=height,
        horizontal_fov_rad=2.0 * math.atan(width / (2.0 * focal)),
        near_m=intrinsics.near_m,
        far_m=intrinsics.far_m,
    )
