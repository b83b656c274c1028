"""Per-pixel operations on images, in C++."""

import math

import numpy as np
from numpy.typing import NDArray

from . import _native


def add_color_noise(rgb: NDArray[np.uint8], *, seed: int, mean: float, stddev: float) -> None:
    """Add Gaussian noise to an image in place, equal on all channels of a pixel, as in Gazebo's shader.

    Args:
        rgb: (height, width, 3)
        seed: 0 to 2^64 − 1; gives the same noise on every machine.
        mean: mean noise; 1 is the difference of black and white.
        stddev: standard deviation, in the same unit.
    """
    _native.add_color_noise(rgb, seed=seed, mean=mean, stddev=stddev)


def add_depth_noise(depths: NDArray[np.float32], *, seed: int, mean: float, stddev: float) -> None:
    """Add Gaussian noise to (height, width) depths [m] in place; see `add_color_noise`."""
    _native.add_depth_noise(depths, seed=seed, mean=mean, stddev=stddev)


def clip_depths(
    depths: NDArray[np.float32],
    *,
    near_m: float = -math.inf,
    far_m: float = math.inf,
    out: NDArray[np.float32] | None = None,
) -> NDArray[np.float32]:
    """Replace depths outside a range, and infinite ones, by NaN.

    Args:
        depths: (height, width) [m], contiguous.
        near_m: smallest depth kept.
        far_m: largest depth kept.
        out: (height, width) result, may be `depths`; None: a new array.
    """
    clipped = np.empty_like(depths) if out is None else out
    _native.clip_depths(depths, near=near_m, far=far_m, clipped=clipped)
    return clipped


def colored_points(
    depth: NDArray[np.float32], rgb: NDArray[np.uint8], right: NDArray[np.float32], down: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Return a colored point per pixel: (height, width, 4) x, y, z in the optical frame [m], and the color packed in
    a float.

    Args:
        depth: (height, width) [m]; NaN gives NaN points.
        rgb: (height, width, 3)
        right: (height, width) slope of a pixel's ray to the right, [m] at 1 m depth.
        down: (height, width) slope of a pixel's ray downwards, [m] at 1 m depth.
    """
    points = np.empty((*depth.shape, 4), dtype=np.float32)
    _native.fill_cloud(points, depth=depth, rgb=rgb, right=right, down=down)
    return points
