"""Renderer interface: poses in, images out."""

import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.spatial import Pose

_LARGEST = 16384
"""[px]"""


class Intrinsics(Struct, frozen=True, kw_only=True):
    """Pinhole camera without distortion."""

    width_px: int
    height_px: int
    horizontal_fov_rad: float
    """Less than pi for rendering; a wide-angle image is composed of several images."""
    near_m: float = 0.1
    far_m: float = 100.0

    def __post_init__(self) -> None:
        """Validate the values.

        Raises:
            ValueError: a value is out of range.
        """
        if not (1 <= self.width_px <= _LARGEST and 1 <= self.height_px <= _LARGEST):
            size = f"{self.width_px} x {self.height_px}"
            raise ValueError(f"a picture is 1 to {_LARGEST} pixels wide and high, not {size}")
        if not 0.0 < self.horizontal_fov_rad <= math.tau:
            raise ValueError(f"a field of view is between 0 and 2 pi, not {self.horizontal_fov_rad:g} rad")
        if not 0.0 < self.near_m < self.far_m:
            raise ValueError(f"a camera needs 0 < near < far, not {self.near_m:g} m and {self.far_m:g} m")

    @property
    def focal_px(self) -> float:
        """Focal length [px], the same along both axes, as gazebo_ros computes it."""
        return self.width_px / (2.0 * math.tan(self.horizontal_fov_rad / 2.0))


class Picture(Struct, frozen=True, eq=False):
    """Rendered image."""

    rgb: NDArray[np.uint8]
    """(height, width, 3)"""
    depth: NDArray[np.float32] | None = None
    """(height, width) depth along the view axis [m]; infinite in the background."""
    segmentation: NDArray[np.int32] | None = None
    """(height, width) index of the shape in the scene; -1 in the background."""


def size_of(views: Sequence[tuple[Pose, Intrinsics]]) -> tuple[int, int]:
    """Return the common height and width of views [px].

    Raises:
        ValueError: there are no views, or their sizes differ.
    """
    sizes = {(lens.height_px, lens.width_px) for _, lens in views}
    if len(sizes) != 1:
        raise ValueError("a call draws one picture or more, all of one size")
    return sizes.pop()


class Renderer(Protocol):
    """Renderer of one scene."""

    def update(self, poses: NDArray[np.float64]) -> None:
        """Set the body poses: (bodies, 7) x y z qw qx qy qz in the world."""
        ...

    def set_vertices(self, shape: int, vertices: NDArray[np.float32]) -> None:
        """Set the vertices (N, 3) of a mesh shape; its faces stay."""
        ...

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        """Render the views of several cameras at one instant.

        Args:
            views: world_from_camera and intrinsics of each; a camera looks along its +x, with y to the left and z up,
                as in SDF.
            depth: render depths, too.
            segmentation: render shape indices, too.

        Returns:
            One image per view, in order.

        Raises:
            ValueError: there are no views, or their sizes differ.
        """
        ...
