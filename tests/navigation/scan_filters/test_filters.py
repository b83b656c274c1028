"""Filters of laser_filters on small scans."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tests.graphs import running_graph, until

from trundle.navigation.scan_filters.chain import FilterChain
from trundle.navigation.scan_filters.scan import Scan
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Messages, Node, StaticTransformBroadcaster, Transform, TransformListener

NAN = math.nan
INCREMENT = math.radians(1.0)


def scan(*ranges: float, **more: Any) -> Scan:
    fields: dict[str, Any] = {
        "angle_min": 0.0,
        "range_min": 0.1,
        "range_max": 10.0,
        **more,
    }
    return Scan(
        stamp_ns=0,
        frame="laser",
        angle_increment=INCREMENT,
        time_increment=0.001,
        scan_time=0.1,
        ranges=np.array(ranges, dtype=np.float32),
        intensities=np.array(fields.pop("intensities", ()), dtype=np.float32),
        **fields,
    )


@pytest.fixture(scope="module")
def chain() -> Iterator[Any]:
    with running_graph(Messages()) as graph:
        node = Node("/n", loop=graph.loop, master_uri=graph.core.uri)
        buffer = TransformListener(node).buffer
        static = StaticTransformBroadcaster(node)
        static.send_transform(Transform(parent="base_link", child="laser", translation=(1.0, 0.0, 0.0)))
        until(lambda: buffer.can_transform("base_link", "laser"))

        def make(*filters: tuple[str, dict[str, Any]]) -> FilterChain:
            entries = [{"name": f"f{i}", "type": kind, "params": params} for i, (kind, params) in enumerate(filters)]
            return FilterChain(RosParameters({"chain": entries}, "/n").sections("chain"), node, buffer)

        yield make


def filtered(chain: Any, measured: Scan, kind: str, **params: Any) -> Any:
    assert chain((f"laser_filters/{kind}", params)).apply(measured) == ""
    return pytest.approx(measured.ranges.tolist(), nan_ok=True, abs=1e-4)


def test_ranges_beyond_thresholds_are_replaced(chain: Any) -> None:
    bounds = {"lower_threshold": 1.0, "upper_threshold": 3.0}
    measured = scan(0.5, 1.0, 2.0, 3.0, math.inf, NAN)
    assert filtered(chain, measured, "LaserScanRangeFilter", **bounds) == [0.0, 0.0, 2.0, 1e5, 1e5, NAN]
    bounds = {"use_message_range_limits": True, "lower_replacement_value": -1.0, "upper_replacement_value": 99.0}
    assert filtered(chain, scan(0.05, 2.0, 11.0), "LaserScanRangeFilter", **bounds) == [-1.0, 2.0, 99.0]


def test_dark_beams_are_removed(chain: Any) -> None:
    measured = scan(1.0, 2.0, 3.0, 4.0, intensities=[50.0, 500.0, 20_000.0])
    limits = {"lower_threshold": 100.0, "upper_threshold": 10_000.0}
    assert filtered(chain, measured, "LaserScanIntensityFilter", **limits) == [NAN, 2.0, NAN, 4.0]
    more = {"invert": True, "filter_override_range": False, "filter_override_intensity": True}
    filtered(chain, measured, "LaserScanIntensityFilter", **limits, **more)
    assert measured.intensities.tolist() == [1.0, 0.0, 1.0]


def test_angular_bounds_shorten_the_scan(chain: Any) -> None:
    measured = scan(0.0, 1.0, 2.0, 3.0, 4.0, intensities=range(5))
    bounds = {"lower_angle": 0.5 * INCREMENT, "upper_angle": 3.5 * INCREMENT}
    assert filtered(chain, measured, "LaserScanAngularBoundsFilter", **bounds) == [1.0, 2.0, 3.0]
    assert (measured.angle_min, measured.stamp_ns) == (pytest.approx(INCREMENT), 1_000_000)
    assert measured.intensities.tolist() == [1.0, 2.0, 3.0]
    fields = measured.fields()
    assert fields["angle_max"] == pytest.approx(3.0 * INCREMENT)
    measured = scan(1.0, 1.0, 1.0)
    assert filtered(chain, measured, "LaserScanAngularBoundsFilter", lower_angle=2.0, upper_angle=3.0) == []


def test_beams_between_angles_are_cleared_in_place(chain: Any) -> None:
    measured = scan(1.0, 1.0, 1.0, intensities=[5.0, 5.0])
    bounds = {"lower_angle": 0.5 * INCREMENT, "upper_angle": 9.0}
    assert filtered(chain, measured, "LaserScanAngularBoundsFilterInPlace", **bounds) == [1.0, 11.0, 11.0]
    assert measured.intensities.tolist() == [5.0, 0.0]
    with pytest.raises(ParamError, match="upper_angle is not set"):
        chain(("LaserScanAngularBoundsFilterInPlace", {"lower_angle": 0.0}))


def test_a_sector_is_cleared_across_the_back(chain: Any) -> None:
    back = {"angle_min": 3.0, "angle_max": -3.0}
    start = {"angle_min": math.pi - INCREMENT}
    measured = scan(1.0, 2.0, 3.0, **start)
    assert filtered(chain, measured, "LaserScanSectorFilter", **back, range_max=2.5) == [11.0, 11.0, 3.0]
    measured = scan(1.0, 2.0, 3.0, **start)
    assert filtered(chain, measured, "LaserScanSectorFilter", **back, range_max=2.5, invert=True) == [1.0, 2.0, 11.0]


def test_gaps_are_interpolated_between_measured_beams(chain: Any) -> None:
    measured = scan(1.0, 11.0, NAN, 3.0, 0.0, 5.0)
    assert filtered(chain, measured, "InterpolationFilter") == [1.0, 2.0, 2.0, 3.0, 4.0, 5.0]
    assert filtered(chain, scan(11.0, 4.0, 11.0), "InterpolationFilter") == [6.995, 4.0, 6.995]
    assert filtered(chain, scan(), "InterpolationFilter") == []


def test_masked_beams_of_a_frame_are_removed(chain: Any) -> None:
    masks = {"laser": [0, 2, 700], "other": [1]}
    assert filtered(chain, scan(1.0, 2.0, 3.0), "LaserScanMaskFilter", masks=masks) == [NAN, 2.0, NAN]


def test_veils_at_edges_are_removed(chain: Any) -> None:
    """Beams between a near post and a far wall: the line along the veil makes a small angle with them."""
    measured = scan(*[1.0] * 5, 1.8, *[3.0] * 5)
    params = {"min_angle": 10.0, "max_angle": 170.0, "window": 1, "neighbors": 1}
    ranges = filtered(chain, measured, "ScanShadowsFilter", **params)
    assert ranges == [*[1.0] * 5, NAN, NAN, *[3.0] * 4]
    measured = scan(*[1.0] * 5, 1.8, *[3.0] * 5)
    ranges = filtered(chain, measured, "ScanShadowsFilter", **params, remove_shadow_start_point=True)
    assert ranges == [*[1.0] * 4, NAN, NAN, NAN, *[3.0] * 4]


def test_a_straight_wall_casts_no_shadow(chain: Any) -> None:
    angles = np.arange(-30, 31) * INCREMENT
    wall = (2.0 / np.cos(angles)).tolist()
    measured = scan(*wall, angle_min=float(angles[0]))
    assert filtered(chain, measured, "ScanShadowsFilter", min_angle=10, max_angle=170, window=1, neighbors=20) == wall


@pytest.mark.parametrize("filter_type", [0, 1])
def test_specks_are_removed_and_walls_stay(chain: Any, filter_type: int) -> None:
    measured = scan(*[1.5] * 6, 0.5, *[1.5] * 6, 5.0)
    params = {"filter_type": filter_type, "filter_window": 2, "max_range_difference": 0.1}
    assert filtered(chain, measured, "LaserScanSpeckleFilter", **params) == [*[1.5] * 6, NAN, *[1.5] * 6, 5.0]
    assert "2 beams" in chain(("LaserScanSpeckleFilter", params)).apply(scan(1.0, 1.0))


def test_the_robot_itself_is_removed(chain: Any) -> None:
    """The laser is 1 m before base_link, and looks forward."""
    assert filtered(chain, scan(0.5, 2.0, NAN), "LaserScanFootprintFilter", inscribed_radius=1.6) == [NAN, 2.0, NAN]
    box = {"box_frame": "base_link", "max_x": 1.6, "min_x": 0.0}
    assert filtered(chain, scan(0.5, 2.0, NAN), "LaserScanBoxFilter", **box) == [NAN, 2.0, NAN]
    assert filtered(chain, scan(0.5, 2.0, 11.0), "LaserScanBoxFilter", **box, invert=True) == [0.5, NAN, 11.0]
    corners = [[1.2, 0.3], [1.2, -0.3], [1.4, -0.3], [1.4, 0.3]]
    polygon = {"polygon_frame": "base_link", "polygon": corners}
    assert filtered(chain, scan(0.3, 0.5), "LaserScanPolygonFilter", **polygon) == [NAN, 0.5]
    assert filtered(chain, scan(0.3, 0.5), "LaserScanPolygonFilter", **polygon, polygon_padding=0.15) == [0.3, NAN]
    assert "nowhere" in chain(("LaserScanBoxFilter", {"box_frame": "nowhere"})).apply(scan(1.0))


def test_the_median_over_time_drops_a_flicker(chain: Any) -> None:
    entry = [{"name": "m", "type": "filters/MultiChannelMedianFilterFloat", "params": {"number_of_observations": 3}}]
    used = chain(("LaserArrayFilter", {"range_filter_chain": entry}))
    results: list[Any] = []
    for value in (2.0, 9.0, 2.1, 2.2):
        measured = scan(value, 1.0, intensities=[7.0])
        used.apply(measured)
        results.append(measured.ranges.tolist())
        assert measured.intensities.tolist() == [7.0]
    assert [row[0] for row in results] == pytest.approx([2.0, 2.0, 2.1, 2.2])
    longer = scan(1.0, 2.0, 3.0)
    used.apply(longer)
    assert longer.ranges.tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("kind", "params", "message"),
    [
        ("LaserArrayFilter", {"range_filter_chain": [{"name": "x", "type": "Foo"}]}, "no filter 'Foo'; there are"),
        ("LaserScanMaskFilter", {"masks": {"laser": [1.5]}}, "not a list of beams' numbers"),
        ("LaserScanPolygonFilter", {"polygon_frame": "a", "polygon": [[0, 0], [1, 1], "x"]}, "not a list of pairs"),
        ("LaserScanPolygonFilter", {"polygon_frame": "a", "polygon": [[0, 0]]}, "has 1 corners"),
        ("ScanShadowsFilter", {"min_angle": 10, "max_angle": 170}, "window is not set"),
        ("LaserScanRangeFilter", {"lower_threshold": "near"}, "'near' is not a number"),
    ],
)
def test_invalid_parameters_are_sentences(chain: Any, kind: str, params: dict[str, Any], message: str) -> None:
    with pytest.raises(ParamError, match=message):
        chain((kind, params))
