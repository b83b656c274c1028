"""Visible pixels of objects."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .annotation import Box2d


class ObjectPixels(Struct, frozen=True, eq=False):
    """Visible pixels of an object within their bounding box."""

    top: int
    left: int
    mask: NDArray[np.bool_]
    """(height, width) mask of the box's pixels that show the object."""

    @property
    def box(self) -> Box2d:
        """Bounding box [px]."""
        height, width = self.mask.shape
        return Box2d(float(self.left), float(self.top), float(self.left + width), float(self.top + height))


def find_pixels(instances: NDArray[np.uint16], number: int) -> ObjectPixels | None:
    """Return the pixels of an instance; None if none is visible.

    Args:
        instances: (height, width) number of the instance at each pixel.
        number: number of the instance.
    """
    mask = instances == number
    rows = np.flatnonzero(mask.any(axis=1))
    if not len(rows):
        return None
    top, bottom = int(rows[0]), int(rows[-1]) + 1
    columns = np.flatnonzero(mask[top:bottom].any(axis=0))
    left, right = int(columns[0]), int(columns[-1]) + 1
    return ObjectPixels(top=top, left=left, mask=mask[top:bottom, left:right])
