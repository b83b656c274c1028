"""Loops over the faces of meshes, in C++; none holds the GIL.

Points are (N, 3) [m], and faces (M, 3) indices into them; an index without a point raises IndexError.
"""

from numpy import float32, float64, intp
from numpy.typing import NDArray

def unique_rows(rows: NDArray[float32] | NDArray[float64]) -> tuple[NDArray[intp], NDArray[intp]]:
    """Return the indices of the first occurrences of the distinct rows of (N, 3), in ascending order of the rows, and
    (N,) the number of each row among them.
    """

def component_labels(count: int, faces: NDArray[intp]) -> NDArray[intp]:
    """Return for each of `count` points the smallest index of the points that are connected with it, (N,)."""

def double_areas(points: NDArray[float64], faces: NDArray[intp]) -> NDArray[float64]:
    """Return twice the area of each face, (M,) [m²]."""

def fold_height(points: NDArray[float64], faces: NDArray[intp]) -> float | None:
    """Return a bound of the height of any point above any face [m], from the folds between neighbours.

    The origin is inside. Infinite if there is no bound; None if an edge does not have two faces.
    """

class SupportGraph:
    """Points of a convex mesh with their neighbours."""

    def __init__(self, points: NDArray[float64], faces: NDArray[intp]) -> None: ...
    def climb(self, directions: NDArray[float64], starts: NDArray[intp]) -> NDArray[intp]:
        """Return the indices of the highest points along directions (D, 3), (D,), by climbing from neighbour to
        neighbour.

        Args:
            directions: of any length.
            starts: (D,) indices of points where the climbs start; near the highest points, they are short.
        """
