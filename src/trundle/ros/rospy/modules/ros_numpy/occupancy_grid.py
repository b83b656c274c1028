"""OccupancyGrid messages."""

from typing import TYPE_CHECKING, Any

import numpy as np
from nav_msgs.msg import MapMetaData, OccupancyGrid

from .registry import converts_from_numpy, converts_to_numpy

if TYPE_CHECKING:
    from numpy.typing import NDArray


@converts_to_numpy(OccupancyGrid)
def occupancygrid_to_numpy(msg: Any) -> "np.ma.MaskedArray[Any, np.dtype[np.int8]]":
    """Masked int8 array (height, width); unknown cells are masked."""
    cells = np.asarray(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
    return np.ma.array(cells, mask=cells == -1, fill_value=-1)


@converts_from_numpy(OccupancyGrid)
def numpy_to_occupancy_grid(arr: "NDArray[Any]", info: Any = None) -> Any:
    """OccupancyGrid from an int8 array (height, width), with the other fields of a MapMetaData.

    Raises:
        TypeError: another shape or type.
    """
    if arr.ndim != 2:
        raise TypeError("Array must be 2D")
    if arr.dtype != np.int8:
        raise TypeError("Array must be of int8s")
    cells = arr.filled(-1) if isinstance(arr, np.ma.MaskedArray) else arr
    grid = OccupancyGrid(data=cells.ravel(), info=info or MapMetaData())
    grid.info.height, grid.info.width = arr.shape
    return grid
