"""The filter chain and the merger as nodes of a graph."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.ros import StaticTransformBroadcaster, Transform


def scan(ranges: list[float], *, frame: str = "laser", stamp_ns: int = 10**9) -> dict[str, Any]:
    count = len(ranges)
    angles = {"angle_min": -math.pi / 2, "angle_max": math.pi / 2, "angle_increment": math.pi / (count - 1)}
    header = {"frame_id": frame, "stamp": stamp_ns}
    return {"header": header, **angles, "range_min": 0.1, "range_max": 10.0, "ranges": ranges}


def test_scans_pass_a_chain_and_dynamic_reconfigure_changes_it(graph: Any) -> None:
    chain = [
        {"name": "range", "type": "laser_filters/LaserScanRangeFilter", "params": {"upper_threshold": 5.0}},
        {"name": "odd", "type": "somebody/Filter"},
        {"name": "bounds", "type": "LaserScanAngularBoundsFilter", "params": {"lower_angle": 0.0, "upper_angle": 2.0}},
    ]
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    filtered = graph.listen("/scan_filtered", "sensor_msgs/LaserScan")
    graph.start("laser_filters/scan_to_scan_filter_chain", name="filters", scan_filter_chain=chain)
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    graph.until(lambda: graph.linked("/scan_filtered"))

    scans.publish(scan([1.0, 2.0, 3.0, 4.0, 6.0]))
    graph.until(lambda: filtered)
    assert list(filtered[0].ranges) == [3.0, 4.0, 100_000.0]
    assert filtered[0].angle_min == pytest.approx(0.0, abs=1e-6)
    graph.until(lambda: any("no type 'somebody/Filter'" in str(line.msg) for line in log))

    config = {"doubles": [{"name": "upper_threshold", "value": 3.5}]}
    graph.call("/filters/range/set_parameters", "dynamic_reconfigure/Reconfigure", config=config)
    scans.publish(scan([1.0, 2.0, 3.0, 4.0, 6.0]))
    graph.until(lambda: len(filtered) == 2)
    assert list(filtered[1].ranges) == [3.0, 100_000.0, 100_000.0]


def test_a_scan_waits_for_the_transform_of_the_message_filter(graph: Any) -> None:
    box = {"box_frame": "base_link", "max_x": 1.5, "min_x": 0.0, "max_y": 5.0, "min_y": -5.0}
    chain = [{"name": "box", "type": "laser_filters/LaserScanBoxFilter", "params": box}]
    target = {"tf_message_filter_target_frame": "base_link"}
    filtered = graph.listen("/scan_filtered", "sensor_msgs/LaserScan")
    graph.start("laser_filters/scan_to_scan_filter_chain", scan_filter_chain=chain, **target)
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    graph.until(lambda: graph.linked("/scan_filtered"))
    scans.publish(scan([3.0, 1.0, 3.0]))
    StaticTransformBroadcaster(graph.client).send_transform(Transform(parent="base_link", child="laser"))

    graph.until(lambda: filtered)
    assert math.isnan(filtered[0].ranges[1])


def test_a_filtered_scan_becomes_a_cloud_in_another_frame(graph: Any) -> None:
    """The laser is 0.5 m before the robot's center; a range of infinity and one beyond 5 m are left out."""
    chain = [{"name": "range", "type": "laser_filters/LaserScanRangeFilter", "params": {"upper_threshold": 5.0}}]
    clouds = graph.listen("/cloud_filtered", "sensor_msgs/PointCloud2")
    graph.start("laser_filters/scan_to_cloud_filter_chain", scan_filter_chain=chain)
    StaticTransformBroadcaster(graph.client).send_transform(
        Transform(parent="base_link", child="laser", translation=(0.5, 0.0, 0.2))
    )
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    graph.until(lambda: graph.linked("/cloud_filtered"))
    scans.publish({**scan([math.nan, 6.0, 2.0, math.inf, 1.0]), "intensities": [1.0, 2.0, 3.0, 4.0, 5.0]})

    graph.until(lambda: clouds)
    cloud = clouds[0]
    assert (cloud.header.frame_id, cloud.width, cloud.point_step) == ("base_link", 2, 20)
    assert [field.name for field in cloud.fields] == ["x", "y", "z", "intensity", "index"]
    numbers = np.frombuffer(bytes(cloud.data), dtype="<f4,<f4,<f4,<f4,<i4").tolist()
    assert numbers[0] == pytest.approx((2.5, 0.0, 0.2, 3.0, 2), abs=1e-5)
    assert numbers[1] == pytest.approx((0.5, 1.0, 0.2, 5.0, 4), abs=1e-5)


def test_two_lasers_become_one_scan(graph: Any) -> None:
    """One looks forward and one back, each 0.5 m from the cart's center; walls are 2.5 m from it."""
    scans_out = graph.listen("/scan_multi", "sensor_msgs/LaserScan")
    clouds = graph.listen("/merged_cloud", "sensor_msgs/PointCloud2")
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="cart_frame", child="front", translation=(0.5, 0.0, 0.0)))
    back = Transform(parent="cart_frame", child="rear", translation=(-0.5, 0.0, 0.0), rotation=(0.0, 0.0, 0.0, 1.0))
    static.send_transform(back)
    bounds = {"angle_min": -3.0, "angle_max": 3.14, "angle_increment": 0.1}
    graph.start("ira_laser_tools/laserscan_multi_merger", laserscan_topics="/front /rear", **bounds)
    front, rear = (graph.advertise(f"/{name}", "sensor_msgs/LaserScan") for name in ("front", "rear"))
    graph.until(lambda: graph.linked("/scan_multi") and graph.linked("/merged_cloud"))
    front.publish(scan([20.0, 2.0, 20.0], frame="front"))
    rear.publish(scan([20.0, 2.0, 2.5], frame="rear"))

    graph.until(lambda: scans_out and clouds)
    merged = scans_out[0]
    assert (merged.header.frame_id, len(merged.ranges), merged.range_max) == ("cart_frame", 62, 25.0)
    hits = {round(-3.0 + 0.1 * i, 1): r for i, r in enumerate(merged.ranges) if r < 26.0}
    assert sorted(hits.values()) == pytest.approx([2.5, math.hypot(0.5, 2.5)])
    assert hits[0.0] == pytest.approx(2.5)
    assert clouds[0].width == 3  # the one straight back is beyond the scan's angles


def test_a_merger_without_lasers_ends_with_a_sentence(graph: Any) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    assert graph.start("ira_laser_tools/laserscan_multi_merger").result(60.0) == 1
    graph.until(lambda: any("no lasers; set laserscan_topics" in str(line.msg) for line in log))
