"""Occlusion and truncation, from a small picture of each object alone, compared with the whole picture."""

import math

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.sim.render import Intrinsics, NativeRenderer, Scene
from trundle.spatial import Pose, matrix_from_quaternion

from .view import View, looking_rotation

_Array = NDArray[np.float64]
_SIDE_PX = 64
"""Side of the small picture, of which an object covers one or two thousand pixels."""
_MARGIN = 1.05
_MAX_FOV_RAD = 2.6
"""Field of view for an object that surrounds the camera."""
_NEARER_RATIO = 0.005
"""Minimum distance between an object and its occluder, relative to its depth, to allow for rounding."""
_MIN_DEPTH = 1e-9
"""Minimum absolute depth in a projection, so that pixels beside the camera stay finite."""
_WHITE = (1.0, 1.0, 1.0, 1.0)


class HiddenParts(Struct, frozen=True):
    """Hidden fractions of an object."""

    occlusion: float
    """Fraction that other objects hide, of the object's part within the picture."""
    truncation: float
    """Fraction of the object that is outside the picture."""


class Silhouettes:
    """Renderer of single objects of a scene."""

    def __init__(self, scene: Scene) -> None:
        shapes = tuple(replace(shape, texture=None, rgba=_WHITE, casts_shadow=False) for shape in scene.shapes)
        self._renderer = NativeRenderer(replace(scene, shapes=shapes, skins=(), lights=()))

    def hidden_parts(
        self,
        bodies: range,
        poses: _Array,
        points: _Array,
        view: View,
        depth: NDArray[np.float32],
        instances: NDArray[np.uint16],
        number: int,
    ) -> HiddenParts:
        """Return the hidden fractions of an object.

        Args:
            bodies: links of the object.
            poses: (links, 7) poses in the picture.
            points: (N, 3) extent of the object in the world [m].
            view: camera of the picture.
            depth: (height, width) depths of the picture [m].
            instances: (height, width) number of the instance at each pixel.
            number: number of the object.
        """
        alone = np.full_like(poses, np.nan)
        alone[bodies.start : bodies.stop] = poses[bodies.start : bodies.stop]
        eye = view.world_from_camera.position
        world_from_small, lens = _fitted(eye, points, view)
        self._renderer.update(alone)
        small_depth = self._renderer.render([(world_from_small, lens)], depth=True)[0].depth
        assert small_depth is not None
        rows, columns = np.nonzero(np.isfinite(small_depth))
        if not len(rows):
            return HiddenParts(0.0, 0.0)
        u, v, ahead = _pixels_in(view, world_from_small, lens, rows, columns)
        ahead *= small_depth[rows, columns]
        height, width = depth.shape
        inside = np.flatnonzero((ahead > view.lens.near_m) & (u >= 0) & (u < width) & (v >= 0) & (v < height))
        if not len(inside):
            return HiddenParts(0.0, 1.0)
        at = v[inside].astype(np.intp), u[inside].astype(np.intp)
        # Background next to the object's edge does not hide it.
        hidden = (instances[at] != number) & (depth[at] < ahead[inside] * (1.0 - _NEARER_RATIO))
        return HiddenParts(int(np.count_nonzero(hidden)) / len(inside), 1.0 - len(inside) / len(rows))


def _pixels_in(
    view: View, world_from_small: Pose, lens: Intrinsics, rows: NDArray[np.intp], columns: NDArray[np.intp]
) -> tuple[_Array, _Array, _Array]:
    """Return columns and rows in the picture [px] of a small picture's pixels, and the ratio of depths in the two
    pictures.

    Both cameras have the same position, so the pixel does not depend on the depth.
    """
    f, optical_from_small = view.lens.focal_px, view.rotation.T @ matrix_from_quaternion(world_from_small.quaternion)
    aside, up = (_SIDE_PX / 2 - 0.5 - columns) / lens.focal_px, (_SIDE_PX / 2 - 0.5 - rows) / lens.focal_px
    x, y, ahead = (row[0] + row[1] * aside + row[2] * up for row in optical_from_small)
    safe = np.where(np.abs(ahead) < _MIN_DEPTH, _MIN_DEPTH, ahead)
    return view.lens.width_px / 2 + f * x / safe, view.lens.height_px / 2 + f * y / safe, ahead


def _fitted(eye: tuple[float, float, float], points: _Array, view: View) -> tuple[Pose, Intrinsics]:
    """Return a camera at the same position whose view fits the points."""
    low, high = points.min(axis=0), points.max(axis=0)
    x, y, z = ((low + high) / 2).tolist()
    turn = looking_rotation(eye, (x, y, z))
    local = (points - eye) @ matrix_from_quaternion(turn)
    if (local[:, 0] > view.lens.near_m).all():
        half = float(np.abs(local[:, 1:] / local[:, :1]).max())
        fov = min(2.0 * math.atan(half * _MARGIN), _MAX_FOV_RAD)
    else:
        fov = _MAX_FOV_RAD
    lens = Intrinsics(
        width_px=_SIDE_PX,
        height_px=_SIDE_PX,
        horizontal_fov_rad=max(fov, 1e-4),
        near_m=view.lens.near_m,
        far_m=1e6,
    )
    return Pose(eye, turn), lens
