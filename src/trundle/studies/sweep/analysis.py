"""Statistics of a table of results: influence of varied values, and outliers."""

from typing import TYPE_CHECKING, Any

import numpy as np

from trundle.base.extras import import_extra

if TYPE_CHECKING:
    from numpy.typing import NDArray

_NORMAL_MAD = 1.4826
"""Ratio of a normal distribution's standard deviation to its median absolute deviation."""


def numbers(column: Any) -> "NDArray[np.float64] | None":
    """Return a column of a `pyarrow.Table` as (rows,) numbers, NaN for missing values; None for a column of text."""
    values = column.to_pylist()
    if any(isinstance(value, str) for value in values):
        return None
    return np.array([np.nan if value is None else float(value) for value in values])


def rank_correlation(varied: Any, measured: "NDArray[np.float64]") -> float | None:
    """Return Spearman's rank correlation of a column and a measure, −1 to 1; None if one of them is constant.

    For text, which has no order, the result is the square root of the ranks' variance that it explains, 0 to 1.
    """
    rankdata = import_extra("scipy.stats").rankdata
    valid = np.isfinite(measured)
    values = numbers(varied)
    if values is not None:
        valid &= np.isfinite(values)
    if np.count_nonzero(valid) < 3:
        return None
    ranks = rankdata(measured[valid])
    if values is None:
        texts = np.array(varied.to_pylist(), dtype=object)[valid]
        means = {text: ranks[texts == text].mean() for text in set(texts)}
        fitted = np.array([means[text] for text in texts])
        return None if ranks.std() == 0 or len(means) < 2 else float(fitted.std() / ranks.std())
    others = rankdata(values[valid])
    if ranks.std() == 0 or others.std() == 0:
        return None
    return float(np.corrcoef(others, ranks)[0, 1])


def worst_rows(table: Any, measures: list[str], count: int) -> list[int]:
    """Return the worst rows: those that are not ok first, then by distance from the median of a measure.

    The distance is in robust standard deviations, the largest over all measures.
    """
    distance = np.zeros(table.num_rows)
    for name in measures:
        values = numbers(table[name])
        if values is None or not np.isfinite(values).any():
            continue
        off = np.abs(values - np.nanmedian(values))
        spread = _NORMAL_MAD * np.nanmedian(off) or np.nanmax(off)
        if spread > 0:
            distance = np.fmax(distance, off / spread)
    is_ok = np.array([status == "ok" for status in table["status"].to_pylist()], dtype=bool)
    order = np.lexsort((-distance, is_ok))
    return [table["row"][int(i)].as_py() for i in order[:count]]
