"""Depth images and point clouds become laser scans, checked against the known ranges of walls."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.gazebo.nodes.depthimage_to_laserscan import Pinhole, read_depths, scan_from_depths
from trundle.gazebo.nodes.pointcloud_to_laserscan import Slice, read_points

WALL_M = 2.0
CAMERA = Pinhole(focal_px=100.0, center_x_px=50.0, center_y_px=20.0)


def scan(depths: Any, **more: Any) -> tuple[float, float, Any]:
    return scan_from_depths(depths, CAMERA, **{"rows": 1, "min_range_m": 0.45, "max_range_m": 10.0, **more})


def test_a_wall_ahead_has_its_distance_over_the_cosine() -> None:
    low, high, ranges = scan(np.full((41, 101), WALL_M))

    assert (low, high) == (pytest.approx(-math.atan(0.5)), pytest.approx(math.atan(0.5)))
    angles = np.linspace(low, high, 101)
    hit = np.isfinite(ranges)
    assert hit.sum() > 90
    # A column's ray lies within half an increment of its place in the scan.
    error = WALL_M * abs(1.0 / np.cos(abs(angles) + 0.005) - 1.0 / np.cos(angles)).max()
    assert np.abs(ranges[hit] - WALL_M / np.cos(angles[hit])).max() <= error + 1e-5


def test_the_nearest_depth_of_the_used_rows_counts() -> None:
    depths = np.full((41, 101), WALL_M)
    depths[19, 50], depths[30, 50] = 1.0, 0.5
    _, _, ranges = scan(depths, rows=4)
    assert ranges[50] == pytest.approx(1.0)


def test_ranges_below_the_minimum_and_unmeasured_ones_are_not_finite() -> None:
    depths = np.full((41, 101), np.nan)
    depths[:, 40], depths[:, 60] = 0.2, np.inf
    _, _, ranges = scan(depths)
    assert not np.isfinite(ranges).any()
    assert np.isinf(ranges).sum() == 1


def image(messages: Any, encoding: str, pixels: Any, *, big: bool = False) -> Any:
    height, width = pixels.shape
    fields = {"height": height, "width": width, "encoding": encoding, "is_bigendian": int(big)}
    return messages.new("sensor_msgs/Image", {**fields, "step": pixels.strides[0], "data": list(pixels.tobytes())})


def test_millimetres_and_byte_orders_are_read(messages) -> None:
    pixels = np.array([[0, 1500]], dtype=">u2")
    depths = read_depths(image(messages, "16UC1", pixels, big=True))
    assert math.isnan(depths[0, 0])
    assert depths[0, 1] == 1.5
    assert read_depths(image(messages, "32FC1", np.array([[2.5]], dtype="<f4")))[0, 0] == 2.5


SLICE = Slice(
    min_height_m=-0.5,
    max_height_m=0.5,
    angle_min=-math.pi,
    angle_max=math.pi,
    angle_increment=math.pi / 2.0,
    range_min_m=0.1,
    range_max_m=50.0,
    empty_range_m=math.inf,
)


def test_points_fall_into_their_rays_and_the_nearest_counts() -> None:
    points = np.array(
        [[3.0, 0.1, 0.0], [2.0, 0.1, 0.4], [1.0, 0.1, 0.6], [0.01, 0.0, 0.0], [-4.0, -0.1, 0.0], [math.nan, 0.0, 0.0]]
    )
    ranges = SLICE.ranges(points)

    assert ranges.tolist() == pytest.approx([math.hypot(4.0, 0.1), math.inf, math.hypot(2.0, 0.1), math.inf])


def cloud(messages: Any, points: Any) -> Any:
    fields = [{"name": name, "offset": 4 * i, "datatype": 7, "count": 1} for i, name in enumerate("xyz")]
    return messages.new(
        "sensor_msgs/PointCloud2",
        {
            "header": {"frame_id": "camera"},
            "height": 1,
            "width": len(points),
            "fields": fields,
            "point_step": 16,
            "row_step": 16 * len(points),
            "data": list(np.pad(np.asarray(points, dtype="<f4"), ((0, 0), (0, 1))).tobytes()),
        },
    )


def test_points_with_padding_are_read(messages) -> None:
    assert read_points(cloud(messages, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])).tolist() == [[1, 2, 3], [4, 5, 6]]
    with pytest.raises(ValueError, match="no fields x, y, z"):
        read_points(messages.new("sensor_msgs/PointCloud2", {}))


def test_a_cloud_is_transformed_into_the_target_frame(graph, messages) -> None:
    graph.start("tf2_ros/static_transform_publisher", "0 0 1 0 0 0 base camera", name="still")
    graph.start("pointcloud_to_laserscan/pointcloud_to_laserscan_node", target_frame="base", min_height=0.5)
    scans = graph.listen("/scan", "sensor_msgs/LaserScan")
    clouds = graph.advertise("/cloud_in", "sensor_msgs/PointCloud2")

    def received() -> bool:
        clouds.publish(cloud(messages, [[2.0, 0.01, 0.0]]))
        return bool(scans)

    graph.until(received)
    assert scans[0].header.frame_id == "base"
    assert min(scans[0].ranges) == pytest.approx(math.hypot(2.0, 0.01), rel=1e-6)


def test_a_cloud_waits_for_its_transform(graph, messages) -> None:
    """Points at the height of the frame or below are ignored, unless min_height is lower: as in the original."""
    graph.start("pointcloud_to_laserscan/pointcloud_to_laserscan_node", target_frame="base")
    scans = graph.listen("/scan", "sensor_msgs/LaserScan")
    clouds = graph.advertise("/cloud_in", "sensor_msgs/PointCloud2")
    graph.until(lambda: graph.connected("/scan"))
    clouds.publish(cloud(messages, [[2.0, 0.01, 0.0], [1.0, 0.01, -1.0]]))
    graph.start("tf2_ros/static_transform_publisher", "0 0 1 0 0 0 base camera", name="still")

    graph.until(lambda: scans)
    assert min(scans[0].ranges) == pytest.approx(math.hypot(2.0, 0.01), rel=1e-6)


def test_a_depth_camera_becomes_a_scan(graph, messages) -> None:
    graph.start("depthimage_to_laserscan/depthimage_to_laserscan", "image:=cam/depth/image_raw")
    scans = graph.listen("/scan", "sensor_msgs/LaserScan")
    infos = graph.client.advertise("/cam/depth/camera_info", "sensor_msgs/CameraInfo", latch=True)
    infos.publish({"K": [100.0, 0, 50.0, 0, 100.0, 20.0, 0, 0, 1.0]})
    images = graph.advertise("/cam/depth/image_raw", "sensor_msgs/Image")

    def received() -> bool:
        images.publish(image(messages, "32FC1", np.full((41, 101), WALL_M, dtype="<f4")))
        return bool(scans)

    graph.until(received)
    assert scans[0].header.frame_id == "camera_depth_frame"
    assert scans[0].ranges[50] == pytest.approx(WALL_M)
