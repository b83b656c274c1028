"""fake_localization: the true pose as amcl's topics and transform."""

import math
from typing import Any

import pytest

from trundle.ros import Transform, TransformBroadcaster, TransformListener, to_nsec

POSE = "geometry_msgs/PoseWithCovarianceStamped"


def orientation(yaw: float) -> dict[str, float]:
    return {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}


def truth(stamp_ns: int, x: float, y: float, yaw: float) -> dict[str, Any]:
    header = {"stamp": stamp_ns, "frame_id": "world"}
    return {"header": header, "pose": {"pose": {"position": {"x": x, "y": y}, "orientation": orientation(yaw)}}}


def test_the_true_pose_becomes_a_pose_a_cloud_and_the_transform_of_odom(graph) -> None:
    """It waits for the odometry at the truth's stamp; the odometry has drifted."""
    poses, clouds = graph.listen("/amcl_pose", POSE), graph.listen("/particlecloud", "geometry_msgs/PoseArray")
    buffer = TransformListener(graph.client).buffer
    graph.start("fake_localization/fake_localization", delta_x=1.0, delta_y=2.0, transform_tolerance=0.5)
    truths = graph.advertise("/base_pose_ground_truth", "nav_msgs/Odometry")
    odometry = TransformBroadcaster(graph.client)
    graph.until(lambda: graph.linked("/amcl_pose") and graph.linked("/tf") and odometry.has_subscribers)

    truths.publish(truth(10**9, 4.0, 6.0, math.pi / 2))
    odometry.send_transform(Transform(parent="odom", child="base_link", stamp_ns=10**9, translation=(0.5, 0.0, 0.0)))

    graph.until(lambda: poses and clouds and buffer.can_transform("map", "odom"))
    assert (poses[0].pose.pose.position.x, poses[0].pose.pose.position.y) == pytest.approx((3.0, 4.0))
    assert poses[0].header.frame_id == "map"
    assert len(clouds[0].poses) == 1
    map_from_odom = buffer.lookup_transform("map", "odom")
    assert map_from_odom.pose.transform_point((0.5, 0.0, 0.0)) == pytest.approx((3.0, 4.0, 0.0))
    assert map_from_odom.stamp_ns == 1_500_000_000
    assert to_nsec(poses[0].header.stamp) == 10**9


def test_an_initial_pose_moves_the_frame_of_the_map(graph) -> None:
    poses = graph.listen("/amcl_pose", POSE)
    graph.start("fake_localization/fake_localization")
    truths = graph.advertise("/base_pose_ground_truth", "nav_msgs/Odometry")
    initial = graph.advertise("/initialpose", POSE)
    odometry = TransformBroadcaster(graph.client)
    graph.until(lambda: graph.linked("/amcl_pose") and odometry.has_subscribers)

    odometry.send_transform(Transform(parent="odom", child="base_link", stamp_ns=10**9))
    truths.publish(truth(10**9, 4.0, 6.0, 0.0))
    graph.until(lambda: len(poses) == 1)
    pose = {"position": {"x": 1.0, "y": 0.0}, "orientation": orientation(math.pi / 2)}
    initial.publish({"header": {"frame_id": "map"}, "pose": {"pose": pose}})
    odometry.send_transform(Transform(parent="odom", child="base_link", stamp_ns=2 * 10**9))

    def moved() -> bool:
        truths.publish(truth(2 * 10**9, 5.0, 6.0, 0.0))  # one metre ahead
        return poses[-1].pose.pose.position.y == pytest.approx(1.0)

    graph.until(moved)
    assert poses[-1].pose.pose.position.x == pytest.approx(1.0)
    assert poses[-1].pose.pose.orientation.z == pytest.approx(math.sqrt(0.5))
