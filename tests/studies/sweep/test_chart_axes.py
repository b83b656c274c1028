"""Axes of charts: where values lie, and which ticks they have."""

import numpy as np
import pytest

from trundle.studies.sweep.chart_axes import axis_of, tick_texts


def test_values_lie_between_the_ends_in_proportion() -> None:
    axis = axis_of(np.array([2.0, 4.0]), 10.0, 110.0)

    assert axis.coordinates(np.array([2.0, 3.0, 4.0])) == pytest.approx([10.0, 60.0, 110.0])
    assert axis_of(np.array([7.0, 7.0]), 0.0, 10.0).coordinates(np.array([7.0])) == [5.0], "a constant is in the middle"


def test_a_logarithm_spaces_decades_evenly_and_needs_positive_values() -> None:
    axis = axis_of(np.array([0.01, 1.0]), 0.0, 100.0, is_log=True)

    assert axis.coordinates(np.array([0.01, 0.1, 1.0])) == pytest.approx([0.0, 50.0, 100.0])
    assert not axis_of(np.array([0.0, 1.0]), 0.0, 100.0, is_log=True).is_log


@pytest.mark.parametrize(
    ("values", "is_log", "texts"),
    [
        ([-0.0031, 1.36], False, ["0", "0.5", "1"]),
        ([10.0, 30.0], False, ["10", "15", "20", "25", "30"]),
        ([6.5e-6, 0.032], False, ["0.01", "0.02", "0.03"]),
        ([0.0103, 0.818], True, ["0.02", "0.05", "0.1", "0.2", "0.5"]),
        ([1e-9, 1.0], True, ["1e-09", "1e-07", "1e-05", "0.001", "0.1"]),
        ([3.0, 3.0], False, ["3"]),
    ],
)
def test_ticks_are_round_and_few(values: list[float], is_log: bool, texts: list[str]) -> None:
    ticks = axis_of(np.array(values), 0.0, 100.0, is_log=is_log).ticks(5)

    assert tick_texts(ticks) == texts
    assert all(values[0] <= tick <= values[1] for tick in ticks)
