"""ekf_localization_node on a graph, with odometry and an IMU."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.ros import Transform, TransformListener

NOW: dict[str, Any] = {"stamp": "now"}
_COVARIANCE = (0.01 * np.eye(6)).ravel().tolist()
_VAGUE_TURNING = np.diag([0.01, 0.01, 0.01, 0.01, 0.01, 1.0]).ravel().tolist()
"""So vague that an estimate published between the wheels' message and the IMU's is the IMU's, too."""


def config(*used: int) -> list[bool]:
    return [index in used for index in range(15)]


def speed(x: float, turning: float, stamp_ns: int) -> dict[str, Any]:
    twist = {"twist": {"linear": {"x": x}, "angular": {"z": turning}}, "covariance": _VAGUE_TURNING}
    return {"header": {"stamp": stamp_ns, "frame_id": "odom"}, "child_frame_id": "base_link", "twist": twist}


@pytest.mark.parametrize("program", ["ekf_localization_node", "ukf_localization_node"])
def test_wheels_and_an_imu_are_fused_into_a_pose(graph, program: str) -> None:
    """Wheels measure 1 rad/s; the IMU measures 0.2 rad/s with less variance, and dominates."""
    odometry = graph.listen("/odometry/filtered", "nav_msgs/Odometry")
    buffer = TransformListener(graph.client).buffer
    graph.start(
        f"robot_localization/{program}",
        frequency=50.0,
        two_d_mode=True,
        odom0="wheels",
        odom0_config=config(6, 7, 11),
        imu0="imu",
        imu0_config=config(11),
    )
    wheels, imu = graph.advertise("/wheels", "nav_msgs/Odometry"), graph.advertise("/imu", "sensor_msgs/Imu")
    graph.until(lambda: graph.linked("/odometry/filtered"))
    certain = (1e-6 * np.eye(3)).ravel().tolist()

    def arrived() -> object:
        now = graph.client.clock.now_ns()
        wheels.publish(speed(0.5, 1.0, now))
        header = {"stamp": now, "frame_id": "base_link"}
        imu.publish({"header": header, "angular_velocity": {"z": 0.2}, "angular_velocity_covariance": certain})
        return odometry and odometry[-1].pose.pose.position.x > 0.3

    graph.until(arrived)
    last = odometry[-1]
    assert (last.header.frame_id, last.child_frame_id) == ("odom", "base_link")
    assert last.twist.twist.linear.x == pytest.approx(0.5, abs=0.02)
    assert last.twist.twist.angular.z == pytest.approx(0.2, abs=0.02)
    assert abs(last.pose.pose.position.z) < 1e-3
    yaw = 2.0 * math.atan2(last.pose.pose.orientation.z, last.pose.pose.orientation.w)
    assert last.pose.pose.position.x == pytest.approx(0.5 / 0.2 * math.sin(yaw), abs=0.05), "an arc of 2.5 m radius"
    assert last.pose.covariance[0] > 0.0
    graph.until(lambda: buffer.can_transform("odom", "base_link"))
    assert buffer.lookup_transform("odom", "base_link").translation[0] > 0.0


def test_in_the_map_frame_it_publishes_the_odom_transform(graph) -> None:
    """The robot is at 1 m by odometry and at 3 m in the map: the odometry frame is at 2 m."""
    buffer = TransformListener(graph.client).buffer
    graph.start(
        "robot_localization/ekf_localization_node", world_frame="map", pose0="gps", pose0_config=config(0, 1, 5)
    )
    gps = graph.advertise("/gps", "geometry_msgs/PoseWithCovarianceStamped")
    frames = graph.client.advertise("/tf", "tf2_msgs/TFMessage", queue_size=None)

    def arrived() -> object:
        now = graph.client.clock.now_ns()
        odom = {"header": {"stamp": now, "frame_id": "odom"}, "child_frame_id": "base_link"}
        frames.publish({"transforms": [{**odom, "transform": {"translation": {"x": 1.0}, "rotation": {"w": 1.0}}}]})
        pose = {"pose": {"position": {"x": 3.0}, "orientation": {"w": 1.0}}, "covariance": _COVARIANCE}
        gps.publish({"header": {"stamp": now, "frame_id": "map"}, "pose": pose})
        return buffer.can_transform("map", "odom")

    graph.until(arrived)
    transform: Transform = buffer.lookup_transform("map", "odom")
    assert transform.translation == pytest.approx((2.0, 0.0, 0.0), abs=0.05)


def test_set_pose_sets_the_pose_and_toggle_stops_it(graph) -> None:
    odometry = graph.listen("/odometry/filtered", "nav_msgs/Odometry")
    graph.start("robot_localization/ekf_localization_node", name="ekf", odom0="wheels", odom0_config=config(6, 7, 11))
    pose = {"pose": {"position": {"x": 7.0, "y": -1.0}, "orientation": {"w": 1.0}}, "covariance": _COVARIANCE}
    header = {"frame_id": "odom"}
    graph.call("/set_pose", "robot_localization/SetPose", pose={"header": header, "pose": pose})
    graph.until(lambda: odometry and odometry[-1].pose.pose.position.x == pytest.approx(7.0))

    assert graph.call("/ekf/toggle", "robot_localization/ToggleFilterProcessing", on=False).status
    assert not graph.call("/ekf/toggle", "robot_localization/ToggleFilterProcessing", on=False).status


def test_without_a_sensor_it_ends_with_an_error(graph) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    assert graph.start("robot_localization/ekf_localization_node").result(60.0) == 1
    graph.until(lambda: any("no sensor; set odom0, pose0, twist0 or imu0" in str(line.msg) for line in log))
