"""Per-pixel operations on a drawn picture, in C++."""

import math

import numpy as np
from numpy.typing import NDArray

from . import _native


def add_colour_noise(rgb: NDArray[np.uint8], *, seed: int, mean: float, stddev: float) -> None:
    """Add Gaussian noise to a picture where it is, the same to all colours of a pixel, as Gazebo's shader does.

    Args:
        rgb: (height, width, 3)
        seed: the same numbers follow from it on every machine; 0 to 2^64 − 1.
        mean: 1 is as much as from black to white.
        stddev: likewise.
    """
    _native.add_colour_noise(rgb, seed=seed, mean=mean, stddev=stddev)


def add_depth_noise(depths: NDArray[np.float32], *, seed: int, mean: float, stddev: float) -> None:
    """Add Gaussian noise to (height, width) depths [m] where they are; see `add_colour_noise`."""
    _native.add_depth_noise(depths, seed=seed, mean=mean, stddev=stddev)


def clip_depths(
    depths: NDArray[np.float32],
    *,
    near_m: float = -math.inf,
    far_m: float = math.inf,
    out: NDArray[np.float32] | None = None,
) -> NDArray[np.float32]:
    """Replace depths outside a range, and endless ones, by not a number.

    Args:
        depths: (height, width) [m], in one piece.
        near_m: the least one that is kept.
        far_m: the largest.
        out: (height, width) where the result goes, which may be `depths`; new memory if None.
    """
    clipped = np.empty_like(depths) if out is None else out
    _native.clip_depths(depths, near=near_m, far=far_m, clipped=clipped)
    return clipped


def coloured_points(
    depth: NDArray[np.float32], rgb: NDArray[np.uint8], right: NDArray[np.float32], down: NDArray[np.float32]
) -> NDArray[np.float32]:
    """A point for each pixel: (height, width, 4) of x, y, z in the optical frame [m], and the colour packed in a float.

    Args:
        depth: (height, width) [m]; where it is not a number the point is not, either.
        rgb: (height, width, 3)
        right: (height, width) how far to the right a pixel looks, 1 m ahead [m].
        down: (height, width) likewise.
    """
    points = np.empty((*depth.shape, 4), dtype=np.float32)
    _native.fill_cloud(points, depth=depth, rgb=rgb, right=right, down=down)
    return points
