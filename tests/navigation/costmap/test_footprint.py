"""Footprints from parameters."""

import pytest

from trundle.navigation.costmap import radii
from trundle.navigation.costmap.footprint import read_footprint
from trundle.robots.parameters import ParamError, RosParameters


def _read(value: object, **options: float):
    return read_footprint(RosParameters({"footprint": value}, "/move_base/costmap"), options.get("radius", 0.2), 0.01)


_SQUARE = "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]"


@pytest.mark.parametrize("value", [_SQUARE, [[0.3, 0.2], [0.3, -0.2], [-0.3, 0]]])
def test_a_footprint_is_a_list_or_its_text_and_padded(value: object) -> None:
    points = _read(value)

    assert points[0].tolist() == pytest.approx([0.31, 0.21])


def test_without_a_footprint_the_robot_is_a_circle_of_sixteen_corners() -> None:
    points = _read("[]")

    assert len(points) == 16
    assert radii(points) == pytest.approx((0.205, 0.214), abs=0.01)


@pytest.mark.parametrize("value", ["[[1, 2]]", "[1, 2", "[[0, 0], [1, 0], [.nan, 1]]", [[1, 2], [3]], "x"])
def test_a_footprint_that_is_no_polygon_is_refused(value: object) -> None:
    with pytest.raises(ParamError, match="parameter /move_base/costmap/footprint"):
        _read(value)
