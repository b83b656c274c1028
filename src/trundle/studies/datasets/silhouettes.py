"""Occlusion and truncation: each object drawn alone, as large as it fits a small picture, against the whole."""

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
"""Size of the small picture: an object covers one or two thousand of its pixels."""
_MARGIN = 1.05
_WIDEST = 2.6
"""Field of view for what surrounds the camera [rad]."""
_NEARER = 0.005
"""Share of the distance by which an occluder must be nearer, against rounding."""
_FLAT = 1e-9
"""Depth below which a pixel beside the camera stays finite."""
_WHITE = (1.0, 1.0, 1.0, 1.0)


class Hiding(Struct, frozen=True):
    """Hidden parts of an object."""

    occlusion: float
    """Share of it within the picture that others hide."""
    truncation: float
    """Share of it beyond the picture's edges."""


class Silhouettes:
    """Draws single objects of a scene."""

    def __init__(self, scene: Scene) -> None:
        shapes = tuple(replace(shape, texture=None, rgba=_WHITE, casts_shadow=False) for shape in scene.shapes)
        self._renderer = NativeRenderer(replace(scene, shapes=shapes, skins=(), lights=()))

    def hiding(
        self,
        bodies: range,
        poses: _Array,
        points: _Array,
        view: View,
        depth: NDArray[np.float32],
        instances: NDArray[np.uint16],
        number: int,
    ) -> Hiding:
        """Return the hidden parts of an object.

        Args:
            bodies: the object's links.
            poses: (links, 7) of the whole picture.
            points: (N, 3) extent of the object in the world [m].
            view: the picture's camera.
            depth: (height, width) of the picture [m].
            instances: (height, width) number of the instance at each pixel.
            number: the object's.
        """
        alone = np.full_like(poses, np.nan)
        alone[bodies.start : bodies.stop] = poses[bodies.start : bodies.stop]
        eye = view.world_from_camera.position
        world_from_small, lens = _fitted(eye, points, view)
        self._renderer.update(alone)
        found = self._renderer.render([(world_from_small, lens)], depth=True)[0].depth
        assert found is not None
        rows, columns = np.nonzero(np.isfinite(found))
        if not len(rows):
            return Hiding(0.0, 0.0)
        u, v, ahead = _pixels_in(view, world_from_small, lens, rows, columns)
        ahead *= found[rows, columns]
        height, width = depth.shape
        inside = np.flatnonzero((ahead > view.lens.near_m) & (u >= 0) & (u < width) & (v >= 0) & (v < height))
        if not len(inside):
            return Hiding(0.0, 1.0)
        at = v[inside].astype(np.intp), u[inside].astype(np.intp)
        # What is seen behind the object beside its edge does not hide it.
        hidden = (instances[at] != number) & (depth[at] < ahead[inside] * (1.0 - _NEARER))
        return Hiding(int(np.count_nonzero(hidden)) / len(inside), 1.0 - len(inside) / len(rows))


def _pixels_in(
    view: View, world_from_small: Pose, lens: Intrinsics, rows: NDArray[np.intp], columns: NDArray[np.intp]
) -> tuple[_Array, _Array, _Array]:
    """Return columns and rows in the picture [px] of pixels of a small one, and depths there of what is 1 m ahead here.

    Both cameras are at the same place, so that the depth does not move a pixel.
    """
    f, optical_from_small = view.lens.focal_px, view.rotation.T @ matrix_from_quaternion(world_from_small.quaternion)
    aside, up = (_SIDE_PX / 2 - 0.5 - columns) / lens.focal_px, (_SIDE_PX / 2 - 0.5 - rows) / lens.focal_px
    x, y, ahead = (each[0] + each[1] * aside + each[2] * up for each in optical_from_small)
    safe = np.where(np.abs(ahead) < _FLAT, _FLAT, ahead)
    return view.lens.width_px / 2 + f * x / safe, view.lens.height_px / 2 + f * y / safe, ahead


def _fitted(eye: tuple[float, float, float], points: _Array, view: View) -> tuple[Pose, Intrinsics]:
    """Return a camera at the same place that looks at the points alone."""
    low, high = points.min(axis=0), points.max(axis=0)
    x, y, z = ((low + high) / 2).tolist()
    turn = looking_rotation(eye, (x, y, z))
    local = (points - eye) @ matrix_from_quaternion(turn)
    if (local[:, 0] > view.lens.near_m).all():
        half = float(np.abs(local[:, 1:] / local[:, :1]).max())
        fov = min(2.0 * math.atan(half * _MARGIN), _WIDEST)
    else:
        fov = _WIDEST
    lens = Intrinsics(
        width_px=_SIDE_PX,
        height_px=_SIDE_PX,
        horizontal_fov_rad=max(fov, 1e-4),
        near_m=view.lens.near_m,
        far_m=1e6,
    )
    return Pose(eye, turn), lens
