"""Image remapping by a precomputed table."""

import numpy as np
from numpy.typing import NDArray

from trundle.sim.render import Intrinsics, Picture
from trundle.spatial import Pose, rotate_vectors

_Array = NDArray[np.float64]
_STEPS = 256
"""Subpixel steps of the interpolation: fixed-point, so the table is equal on every machine."""
_SHIFT = 16
"""Bits of a weight, the product of two subpixel steps."""


class Remap:
    """Looks up each pixel in one of several equal-sized pinhole images; colors are interpolated bilinearly."""

    def __init__(self, faces: list[tuple[Pose, Intrinsics]], directions: _Array, is_valid: NDArray[np.bool_]) -> None:
        """Compute the table.

        Args:
            faces: camera_from_face and intrinsics of views of one size; unused ones are dropped.
            directions: (height, width, 3) ray of each pixel in the camera frame.
            is_valid: (height, width) mask of valid pixels; invalid pixels are black, infinitely far and show no shape.
        """
        in_faces = np.stack([rotate_vectors(pose.inverse(), directions) for pose, _ in faces])
        nearest = np.argmax(in_faces[..., 0], axis=0)
        used = [i for i in range(len(faces)) if np.any(nearest[is_valid] == i)] or [0]
        self.pinhole_views = [faces[i] for i in used]
        number = np.searchsorted(used, np.where(is_valid, nearest, used[0]))
        ray = np.take_along_axis(in_faces, nearest[None, ..., None], axis=0)[0]
        size = self.pinhole_views[0][1]
        width, count = size.width_px, size.width_px * size.height_px
        ahead = np.where(is_valid, ray[..., 0], 1.0)
        column = np.where(is_valid, size.width_px / 2 - size.focal_px * ray[..., 1] / ahead - 0.5, 0.0)
        row = np.where(is_valid, size.height_px / 2 - size.focal_px * ray[..., 2] / ahead - 0.5, 0.0)
        column = np.clip(np.rint(column * _STEPS).astype(np.int64), 0, (size.width_px - 1) * _STEPS - 1)
        row = np.clip(np.rint(row * _STEPS).astype(np.int64), 0, (size.height_px - 1) * _STEPS - 1)
        (i, u), (j, v) = np.divmod(column, _STEPS), np.divmod(row, _STEPS)
        corner = number * count + j * width + i
        self._corners = [corner + step for step in (0, 1, width, width + 1)]
        right, below = (u >= _STEPS // 2).astype(np.int64), (v >= _STEPS // 2).astype(np.int64)
        self._nearest = corner + below * width + right
        self._weights = [
            w.astype(np.uint32)[..., None]
            for w in ((_STEPS - u) * (_STEPS - v), u * (_STEPS - v), (_STEPS - u) * v, u * v)
        ]
        self._blind = ~is_valid

    def compose(self, pictures: list[Picture]) -> Picture:
        """Compose the image; depths and shapes are taken from the nearest pixel, not interpolated."""
        colors = np.concatenate([picture.rgb.reshape(-1, 3) for picture in pictures])
        mixed = np.full((*self._blind.shape, 3), _STEPS * _STEPS // 2, dtype=np.uint32)
        for corner, weight in zip(self._corners, self._weights, strict=True):
            mixed += np.take(colors, corner, axis=0, mode="clip") * weight  # "clip" skips the bounds check
        rgb = (mixed >> _SHIFT).astype(np.uint8)
        rgb[self._blind] = 0
        depths = [picture.depth for picture in pictures if picture.depth is not None]
        shapes = [picture.segmentation for picture in pictures if picture.segmentation is not None]
        depth = segmentation = None
        if depths:
            depth = np.concatenate([image.reshape(-1) for image in depths])[self._nearest]
            depth[self._blind] = np.inf
        if shapes:
            segmentation = np.concatenate([image.reshape(-1) for image in shapes])[self._nearest]
            segmentation[self._blind] = -1
        return Picture(rgb, depth, segmentation)
