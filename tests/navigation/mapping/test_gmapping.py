"""The slam_gmapping node on a graph."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from tests.navigation.house import house_map, ranges_at, scan_fields

from trundle.navigation.mapping.gmapping_settings import read_settings
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import StaticTransformBroadcaster, Transform, TransformBroadcaster, TransformListener

WORLD = house_map()


def test_the_node_publishes_the_map_its_service_and_the_transform_of_odom(graph) -> None:
    """The map's frame is the odometry's at first; in it, the robot starts at (1, 1). The map grows beyond xmax."""
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    entropies = graph.listen("/slam_gmapping/entropy", "std_msgs/Float64")
    metadata = graph.listen("/map_metadata", "nav_msgs/MapMetaData")
    buffer = TransformListener(graph.client).buffer
    bounds = {"xmin": -1.0, "ymin": -1.0, "xmax": 2.2, "ymax": 5.4}
    graph.start("gmapping/slam_gmapping", particles=3, map_update_interval=0.0, linearUpdate=0.3, **bounds)
    static, odometry = StaticTransformBroadcaster(graph.client), TransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="base_link", child="base_scan"))
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    stamp_ns = 10**9

    def measure(x: float, condition: Any) -> None:
        def is_true() -> bool:
            nonlocal stamp_ns
            stamp_ns += 10**8
            scans.publish(scan_fields(ranges_at(WORLD, (x, 1.0, 0.0)), stamp_ns))
            transform = Transform(parent="odom", child="base_link", stamp_ns=stamp_ns, translation=(x, 1.0, 0.0))
            odometry.send_transform(transform)
            return bool(condition())

        graph.until(is_true)

    measure(1.0, lambda: maps and entropies)
    measure(1.5, lambda: len(maps) >= 2)
    measure(2.0, lambda: len(maps) >= 3)

    graph.until(lambda: buffer.can_transform("map", "odom") and metadata)
    assert buffer.lookup_transform("map", "odom").pose.position == pytest.approx((0.0, 0.0, 0.0), abs=0.03)
    info = maps[-1].info
    assert (info.height, info.origin.position.x, maps[-1].header.frame_id) == (128, -1.0, "map")
    assert (info.width % 32, info.width * 0.05 > 1.0 + 3.5 + 10.0) == (0, True)
    cells = np.array(maps[-1].data, dtype=np.int8).reshape(info.height, info.width)
    assert set(np.unique(cells)) == {-1, 0, 100}
    row, column = 40, round((3.5 + 1.0) / 0.05)  # y = 1 m, the wall at x = 3.5 m
    assert 100 in cells[row, column - 1 : column + 2]
    assert (cells[row, column - 40 : column - 2] == 0).all()
    answer = graph.call("/dynamic_map", "nav_msgs/GetMap")
    assert (answer.map.info.width, answer.map.info.resolution) == (info.width, pytest.approx(0.05))


def test_a_map_grows_by_patches_of_32_cells_where_something_was_seen_beyond() -> None:
    """As turtlebot3's: 20 m from xmin on are 12 patches; 10 m more on the side that was exceeded."""
    frame = read_settings(RosParameters({"xmin": -10.0, "ymin": -10.0, "xmax": 10.0, "ymax": 10.0}, "/slam")).frame

    assert frame == (-200, -200, 384, 384)
    assert frame.grown((-200, -200, 183, 183), 0.05) == frame
    assert frame.grown((-210, 0, 184, 0), 0.05) == (-200 - 224, -200, 224 + 384 + 224, 384)
    assert frame.grown((0, 0, 2**30, 2**30), 0.05) == frame  # more than a map may have


def test_bounds_without_room_are_of_a_map_that_grows_from_nothing(graph) -> None:
    """Launch files have xmin 10 and xmax -10; the original's map is empty, and grows."""
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    bounds = {"xmin": 10.0, "ymin": 10.0, "xmax": -10.0, "ymax": -10.0}
    graph.start("gmapping/slam_gmapping", particles=3, map_update_interval=0.0, **bounds)
    static, odometry = StaticTransformBroadcaster(graph.client), TransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="base_link", child="base_scan"))
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    stamps = itertools.count(10**9, 10**8)

    def measure() -> bool:
        stamp_ns = next(stamps)
        scans.publish(scan_fields(ranges_at(WORLD, (1.0, 1.0, 0.0)), stamp_ns))
        odometry.send_transform(
            Transform(parent="odom", child="base_link", stamp_ns=stamp_ns, translation=(1.0, 1.0, 0.0))
        )
        return bool(maps)

    graph.until(measure)

    info = maps[-1].info
    cells = np.array(maps[-1].data, dtype=np.int8).reshape(info.height, info.width)
    row, column = (round((value - info.origin.position.x) / 0.05) for value in (1.0, 3.5))
    assert info.origin.position.x == info.origin.position.y
    assert 100 in cells[row, column - 1 : column + 2]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"delta": 0.0}, "delta must be > 0"),
        ({"particles": -3}, "particles must be > 0"),
        ({"xmax": 1e9, "ymax": 1e9}, "at most 400000000"),
        ({"sigma": math.inf}, "sigma"),
    ],
)
def test_impossible_parameters_are_refused_in_a_sentence(values: dict[str, Any], message: str) -> None:
    with pytest.raises(ParamError, match=message):
        read_settings(RosParameters(values, "/slam_gmapping"))
