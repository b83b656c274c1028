"""What rays find, however they are cast."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Vector3

_Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """What each ray met."""

    distances: _Array
    """(rays,) [m]; inf where there is nothing."""
    retros: _Array
    """(rays,) The laser_retro of what is there; 0 where there is nothing."""


class Rays(Protocol):
    """Casts rays against shapes."""

    def __call__(self, origin: Vector3, directions: _Array, reach: float, exclude: int, /) -> Found:
        """From one place in (rays, 3) directions in the world, [m] far, looking through one link."""
        ...
