"""A grid of costs in the plane of a frame."""

import math
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

FREE_SPACE, INSCRIBED, LETHAL, NO_INFORMATION = 0, 253, 254, 255
"""Costs of costmap_2d; the robot's center may be in cells below INSCRIBED."""
MAX_CELLS = 100_000_000
"""Maximum number of cells of a grid."""
_ROUNDING = 1e-6
"""Rounding error allowed at a cell's edge [cells], so that grids which follow one another stay aligned."""
_Number = TypeVar("_Number", np.uint8, np.uint32)


@dataclass(slots=True)
class Costmap:
    """Costs of cells; row 0 is at the smallest y."""

    width: int
    height: int
    resolution_m: float
    origin: tuple[float, float]
    """Outer corner of the first cell [m]."""
    default: int = FREE_SPACE
    """Cost of cells before any observation."""
    cells: NDArray[np.uint8] = field(init=False)
    """(height, width)"""

    def __post_init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Give every cell the default cost."""
        self.cells = np.full((self.height, self.width), self.default, dtype=np.uint8)

    def copy(self) -> "Costmap":
        """Return a copy, whose costs later updates do not change."""
        grid = Costmap(*self.geometry, self.default)
        grid.cells = self.cells.copy()
        return grid

    @property
    def geometry(self) -> tuple[int, int, float, tuple[float, float]]:
        """Size in cells, resolution [m] and origin [m]."""
        return self.width, self.height, self.resolution_m, self.origin

    def cell(self, x: float, y: float) -> tuple[int, int] | None:
        """Return the column and row of a point [m]; None outside."""
        column = (x - self.origin[0]) / self.resolution_m
        row = (y - self.origin[1]) / self.resolution_m
        return (int(column), int(row)) if 0.0 <= column < self.width and 0.0 <= row < self.height else None

    def in_cells(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert points (n, 2) [m] to cells; the first cell reaches from 0 to 1."""
        return (points - np.array(self.origin)) / self.resolution_m

    def center(self, column: float, row: float) -> tuple[float, float]:
        """Return the center of a cell [m]."""
        return (
            self.origin[0] + (column + 0.5) * self.resolution_m,
            self.origin[1] + (row + 0.5) * self.resolution_m,
        )

    def shift_to(self, x: float, y: float) -> tuple[int, int]:
        """Move the origin to the grid's cell at a point [m]; costs stay where they are in the frame.

        Returns the number of columns and rows by which the origin moved.
        """
        columns = math.floor((x - self.origin[0]) / self.resolution_m + _ROUNDING)
        rows = math.floor((y - self.origin[1]) / self.resolution_m + _ROUNDING)
        self.origin = (
            self.origin[0] + columns * self.resolution_m,
            self.origin[1] + rows * self.resolution_m,
        )
        self.cells = moved(self.cells, columns, rows, self.default)
        return columns, rows


def moved(cells: NDArray[_Number], columns: int, rows: int, fill: int) -> NDArray[_Number]:
    """Return cells (height, width) of a grid whose origin moved by columns and rows; new ones are `fill`."""
    if columns == rows == 0:
        return cells
    height, width = cells.shape
    result = np.full_like(cells, fill)
    if abs(columns) < width and abs(rows) < height:
        kept = cells[max(rows, 0) : height + min(rows, 0), max(columns, 0) : width + min(columns, 0)]
        top, left = max(-rows, 0), max(-columns, 0)
        result[top : top + kept.shape[0], left : left + kept.shape[1]] = kept
    return result


@dataclass(slots=True)
class Bounds:
    """The part of a costmap that an update may change [m]; empty at first."""

    min_x: float = math.inf
    min_y: float = math.inf
    max_x: float = -math.inf
    max_y: float = -math.inf

    def touch(self, points: NDArray[np.float64]) -> None:
        """Extend to points (n, 2) [m]."""
        if len(points):
            (low_x, low_y), (high_x, high_y) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
            self.join(Bounds(low_x, low_y, high_x, high_y))

    def join(self, other: "Bounds", margin: float = 0.0) -> None:
        """Extend to other bounds, and a margin around them [m]."""
        self.min_x, self.min_y = min(self.min_x, other.min_x - margin), min(self.min_y, other.min_y - margin)
        self.max_x, self.max_y = max(self.max_x, other.max_x + margin), max(self.max_y, other.max_y + margin)

    def touch_all(self, costmap: Costmap) -> None:
        """Extend to a whole costmap."""
        x, y = costmap.origin
        across, along = costmap.width * costmap.resolution_m, costmap.height * costmap.resolution_m
        self.join(Bounds(x, y, x + across, y + along))

    def window(self, costmap: Costmap) -> tuple[int, int, int, int]:
        """Return the cells x0, y0, x1, y1 within the costmap; x1 and y1 are past the end."""
        if self.min_x > self.max_x:
            return 0, 0, 0, 0
        low = costmap.in_cells(np.array([[self.min_x, self.min_y]]))[0]
        high = costmap.in_cells(np.array([[self.max_x, self.max_y]]))[0]
        size = (costmap.width, costmap.height)
        x0, y0 = (int(min(max(math.floor(value), 0), limit)) for value, limit in zip(low, size, strict=True))
        x1, y1 = (int(min(max(math.floor(value) + 1, 0), limit)) for value, limit in zip(high, size, strict=True))
        return x0, y0, max(x1, x0), max(y1, y0)
