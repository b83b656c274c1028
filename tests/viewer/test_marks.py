"""The driven path follows the driving, not the leaps of a reset."""

import numpy as np

from trundle.viewer.marks import arrows_along


def test_arrows_join_points_and_leave_out_leaps() -> None:
    points = np.array([[0.0, 0, 0], [0.1, 0, 0], [5.0, 0, 0], [5.1, 0, 0]])

    arrows = arrows_along(points)

    assert arrows.tolist() == [[[0.0, 0, 0], [0.1, 0, 0]], [[5.0, 0, 0], [5.1, 0, 0]]]
