"""Occupancy grids in messages."""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from trundle.ros.message_types import nav_msgs


def read_cells(message: "nav_msgs.OccupancyGrid") -> NDArray[np.int8]:
    """Return the cells of a map: (height, width), row 0 at the bottom.

    Raises:
        ValueError: the number of cells does not fit the size, or the resolution is not positive.
    """
    info = message.info
    cells = np.asarray(message.data, dtype=np.int8)
    if cells.size != info.width * info.height:
        raise ValueError(f"{cells.size} cells do not fit the size {info.width} × {info.height}")
    if not 0.0 < info.resolution < math.inf:
        raise ValueError(f"its resolution must be > 0 m, got {info.resolution:g}")
    return np.ascontiguousarray(cells.reshape(info.height, info.width))
