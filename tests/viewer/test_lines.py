"""Lines that plugins draw."""

import numpy as np

from trundle.viewer.lines import segments_along


def test_a_strip_is_drawn_from_point_to_point() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 2, 0]], dtype=np.float32)

    assert segments_along(points).tolist() == [[[0, 0, 0], [1, 0, 0]], [[1, 0, 0], [1, 2, 0]]]
