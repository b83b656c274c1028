"""laser_scan_matcher and rf2o_laser_odometry as nodes of a graph."""

import math
import time
from typing import Any

import pytest
from tests.navigation.house import scan_fields
from tests.navigation.laser_drive import scans

from trundle.ros import StaticTransformBroadcaster, Transform, TransformListener, to_nsec

DRIVE = [(1.0, 1.0 + 0.03 * step, math.pi / 2) for step in range(15)]
LENGTH = 0.03 * 14


def drive(graph: Any, topic: str, count: Any) -> None:
    publisher = graph.advertise(topic, "sensor_msgs/LaserScan")
    for number, ranges in enumerate(scans(DRIVE)):
        publisher.publish(scan_fields(ranges, 10**9 + number * 10**8))
        graph.until(lambda expected=number + 1: count() >= expected)


def test_the_matcher_publishes_poses_and_the_transform(graph: Any) -> None:
    poses = graph.listen("/pose2D", "geometry_msgs/Pose2D")
    stamped = graph.listen("/pose_with_covariance_stamped", "geometry_msgs/PoseWithCovarianceStamped")
    buffer = TransformListener(graph.client).buffer
    StaticTransformBroadcaster(graph.client).send_transform(Transform(parent="base_link", child="base_scan"))
    options = {"publish_pose_with_covariance_stamped": True, "do_compute_covariance": 1, "fixed_frame": "odom"}
    graph.start("laser_scan_matcher/laser_scan_matcher_node", **options)
    graph.until(lambda: graph.linked("/pose2D") and graph.linked("/pose_with_covariance_stamped"))
    drive(graph, "/scan", lambda: len(poses))

    assert (poses[-1].x, poses[-1].y, poses[-1].theta) == pytest.approx((LENGTH, 0.0, 0.0), abs=0.03)
    graph.until(lambda: len(stamped) == len(DRIVE))
    assert stamped[-1].header.frame_id == "odom"
    assert 0.0 < stamped[-1].pose.covariance[0] < 1e-4
    graph.until(lambda: buffer.can_transform("odom", "base_link"))


def test_the_matcher_is_led_by_odometry_over_a_jump(graph: Any) -> None:
    """Scans 0.8 m apart are too far for the match alone; poses beyond measure are ignored."""
    poses = graph.listen("/pose2D", "geometry_msgs/Pose2D")
    StaticTransformBroadcaster(graph.client).send_transform(Transform(parent="base_link", child="base_scan"))
    graph.start("laser_scan_matcher/laser_scan_matcher_node", publish_tf=False)
    odometry = graph.advertise("/odom", "nav_msgs/Odometry")
    scans_in = graph.advertise("/scan", "sensor_msgs/LaserScan")
    graph.until(lambda: graph.linked("/pose2D"))
    for number, ranges in enumerate(scans([(1.0, 1.0, math.pi / 2), (1.0, 1.8, math.pi / 2)])):
        wild = {"position": {"x": 1e308}, "orientation": {"w": 1.0}}
        odometry.publish({"pose": {"pose": wild}})
        pose = {"position": {"x": 5.0 + 0.78 * number}, "orientation": {"w": 1.0}}
        odometry.publish({"pose": {"pose": pose}})
        time.sleep(0.2)  # the topics' order is not fixed
        scans_in.publish(scan_fields(ranges, 10**9 + number * 10**8))
        graph.until(lambda count=number + 1: len(poses) >= count)
    assert poses[-1].x == pytest.approx(0.8, abs=0.03)


def test_rf2o_publishes_odometry_from_its_initial_pose_on(graph: Any) -> None:
    odometry = graph.listen("/odom_rf2o", "nav_msgs/Odometry")
    StaticTransformBroadcaster(graph.client).send_transform(Transform(parent="base_link", child="base_scan"))
    graph.start("rf2o_laser_odometry/rf2o_laser_odometry_node", laser_scan_topic="/scan")
    start = graph.advertise("/base_pose_ground_truth", "nav_msgs/Odometry", latch=True)
    start.publish({"pose": {"pose": {"position": {"x": 2.0}, "orientation": {"w": 1.0}}}})
    graph.until(lambda: graph.linked("/odom_rf2o"))
    publisher = graph.advertise("/scan", "sensor_msgs/LaserScan")
    first = scans(DRIVE[:1])[0]

    def begun() -> bool:
        publisher.publish(scan_fields(first, 10**8))
        return bool(odometry)

    graph.until(begun)
    for number, ranges in enumerate(scans(DRIVE)):
        stamp_ns = 10**9 + number * 10**8
        publisher.publish(scan_fields(ranges, stamp_ns))
        graph.until(lambda stamp=stamp_ns: to_nsec(odometry[-1].header.stamp) == stamp)
    last = odometry[-1]
    assert (last.header.frame_id, last.child_frame_id) == ("odom", "base_link")
    assert last.pose.pose.position.x == pytest.approx(2.0 + LENGTH, abs=0.03)
    assert last.twist.twist.linear.x == pytest.approx(0.3, abs=0.1)
