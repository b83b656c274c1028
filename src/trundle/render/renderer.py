"""What a renderer does: poses in, pictures out. Implementations live where their engines do."""

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
    """A pinhole without distortion."""

    width_px: int
    height_px: int
    horizontal_fov_rad: float
    """Less than pi where a picture is to be drawn; what a wide lens sees is looked up in several such pictures."""
    near_m: float = 0.1
    far_m: float = 100.0

    def __post_init__(self) -> None:
        """Refuse what no picture can be made with.

        Raises:
            ValueError: with the reason.
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
    """What a camera saw."""

    rgb: NDArray[np.uint8]
    """(height, width, 3)"""
    depth: NDArray[np.float32] | None = None
    """(height, width) distance along the view axis [m]; infinite where nothing is."""
    segmentation: NDArray[np.int32] | None = None
    """(height, width) index of the shape in the scene; -1 where nothing is."""


def size_of(views: Sequence[tuple[Pose, Intrinsics]]) -> tuple[int, int]:
    """The height and width of all of them [px].

    Raises:
        ValueError: there are none, or not all are of one size.
    """
    sizes = {(lens.height_px, lens.width_px) for _, lens in views}
    if len(sizes) != 1:
        raise ValueError("a call draws one picture or more, all of one size")
    return sizes.pop()


class Renderer(Protocol):
    """Draws one scene from anywhere."""

    def update(self, poses: NDArray[np.float64]) -> None:
        """Move the scene's bodies: (bodies, 7) x y z qw qx qy qz in the world."""
        ...

    def set_vertices(self, shape: int, vertices: NDArray[np.float32]) -> None:
        """Give a shape that is a mesh other places for its vertices, (N, 3); its faces stay."""
        ...

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        """Draw what cameras see at one instant, all in one call.

        Args:
            views: world_from_camera and the lens of each; a camera looks along its +x, with y to the left and z up, as
                in SDF.
            depth: whether distances are wanted, too.
            segmentation: likewise.

        Returns:
            A picture for each, in their order.

        Raises:
            ValueError: there are none, or not all are of one size.
        """
        ...
