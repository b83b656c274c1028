"""Statistics of a table of results."""

import numpy as np
import pytest

from trundle.studies.sweep.analysis import numbers, rank_correlation, worst_rows

pa = pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")


def test_a_monotonic_relation_is_one_and_noise_is_none() -> None:
    draw = np.random.default_rng(3)
    x, noise = draw.random(2000), draw.random(2000)

    assert rank_correlation(pa.array(x), np.exp(9 * x)) == pytest.approx(1.0)
    assert rank_correlation(pa.array(x), -(x**3)) == pytest.approx(-1.0)
    assert rank_correlation(pa.array(x), noise) == pytest.approx(0.0, abs=0.06)
    assert rank_correlation(pa.array([1.0] * 2000), noise) is None


def test_texts_and_missing_values_are_ranked_too() -> None:
    texts = pa.array(["a", "b"] * 50)
    measured = np.array([1.0, 5.0] * 50)

    assert rank_correlation(texts, measured) == pytest.approx(1.0)
    measured[::4] = np.nan
    assert rank_correlation(texts, measured) == pytest.approx(1.0)
    flags = numbers(pa.array([True, None, False]))
    assert flags is not None
    assert flags.tolist()[::2] == [1.0, 0.0]
    assert numbers(texts) is None


def test_the_worst_rows_are_failed_ones_then_those_far_out() -> None:
    status = ["ok"] * 20
    status[3] = status[8] = "failed"
    x = [float(i % 5) for i in range(20)]
    x[8], x[15] = 50.0, 90.0
    table = pa.table({"row": list(range(100, 120)), "status": status, "x": x})

    assert worst_rows(table, ["x"], 3) == [108, 103, 115]
