"""Distinct rows of an array, in the time of a sort."""

from typing import Any

import numpy as np
from numpy.typing import NDArray


def unique_rows(rows: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the indices of the first occurrences of the distinct rows of (N, K), in ascending order of the rows, and
    (N,) the number of each row among them.

    `numpy.unique` of rows compares field by field and takes ten times as long.
    """
    order = np.lexsort(rows.T[::-1])
    ordered = rows[order]
    is_new = np.ones(len(rows), dtype=bool)
    is_new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    number = np.empty(len(rows), dtype=np.intp)
    number[order] = np.cumsum(is_new) - 1
    return order[is_new], number
