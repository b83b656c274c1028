"""Occupancy of cubes in space, in C++."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

class OccupancyTree:
    """Log-odds of cubes that rays reached, at octomap's 16 levels; all else is unknown."""

    def __init__(self, resolution: float, *, hit: float, miss: float, lower: float, upper: float) -> None:
        """Begin empty.

        Args:
            resolution: length of a cube [m].
            hit: change of the log-odds by a ray that ends in a cube; positive.
            miss: change by one that passes; negative.
            lower, upper: limits of the log-odds.
        """

    def insert(
        self, origin: Sequence[float], hits: NDArray[np.float64], floor: NDArray[np.float64], *, max_range: float
    ) -> bool:
        """Add rays from a point to points (n, 3) [m]; those of the floor end in free cubes.

        `max_range`: length beyond which rays are cut [m]; ≤ 0: none is. False: there is no room for more cubes.
        """

    def clear_box(self, low: Sequence[float], high: Sequence[float]) -> None:
        """Make the known cubes between two corners [m] free."""

    def reset(self) -> None:
        """Forget everything."""

    def binary(self) -> NDArray[np.uint8]:
        """Return octomap's stream of free and occupied cubes, pruned."""

    def full(self) -> NDArray[np.uint8]:
        """Return octomap's stream of log-odds, pruned."""

    def read(self, data: NDArray[np.uint8], *, binary: bool, node_size: int = 5) -> bool:
        """Replace all by a stream; False: it is damaged or too large. `node_size`: bytes of a node of a full one."""

    def leaves(self, *, occupied: bool) -> NDArray[np.int32]:
        """Return the largest free or occupied cubes (n, 4): x, y, z in cubes of their depth, and the depth."""

    def project(self, low: float, high: float) -> tuple[int, int, NDArray[np.int8]]:
        """Project the cubes between two heights [m].

        Returns:
            Keys x, y of the first cell, and cells (height, width): −1 unknown, 0 free, 100 occupied.

        Raises:
            ValueError: there are more than 100 million cells.
        """

    def odds(self, point: Sequence[float]) -> float:
        """Return the log-odds at a point [m]; NaN: unknown."""

    @property
    def resolution(self) -> float:
        """Length of a cube [m]."""

    @property
    def is_empty(self) -> bool: ...
