"""robot_pose_ekf: wheels that slip, an imu that does not."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.gazebo.nodes.robot_pose_ekf.pose_filter import PoseFilter
from trundle.ros import TransformListener
from trundle.spatial import Pose

_WHEELS = np.diag([1e-4, 1e-4, 1e9, 1e9, 1e9, 0.1]).ravel().tolist()
_IMU = np.diag([1e-6, 1e-6, 1e-6]).ravel().tolist()


def odometry(stamp_ns: int, x: float, y: float, yaw: float) -> dict[str, Any]:
    orientation = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    pose = {"position": {"x": x, "y": y}, "orientation": orientation}
    return {"header": {"stamp": stamp_ns, "frame_id": "odom"}, "pose": {"pose": pose, "covariance": _WHEELS}}


def imu(stamp_ns: int, yaw: float) -> dict[str, Any]:
    orientation = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    header = {"stamp": stamp_ns, "frame_id": "base_footprint"}
    return {"header": header, "orientation": orientation, "orientation_covariance": _IMU}


def test_a_measurement_replaces_what_was_forgotten_and_angles_wrap() -> None:
    estimate = PoseFilter(Pose.from_rpy(1.0, 0.0, 0.0, yaw=3.1))
    estimate.predict()
    estimate.correct((0, 1, 5), (2.0, 3.0, -3.1), 0.01 * np.eye(3))
    assert estimate.state[[0, 1]] == pytest.approx((2.0, 3.0), abs=1e-4)
    assert estimate.state[5] == pytest.approx(math.tau - 3.1, abs=1e-4)
    assert estimate.covariance[0, 0] == pytest.approx(0.01, rel=1e-3)
    assert estimate.covariance[2, 2] == pytest.approx(1000.0**2, rel=1e-3)


def test_the_imu_leads_the_heading_and_the_wheels_the_way(graph: Any) -> None:
    """The wheels report 1 rad/s while the robot turns at 0.2 rad/s at 0.5 m/s: it drives an arc of 2.5 m radius."""
    combined = graph.listen("/robot_pose_ekf/odom_combined", "geometry_msgs/PoseWithCovarianceStamped")
    buffer = TransformListener(graph.client).buffer
    graph.start("robot_pose_ekf/robot_pose_ekf", vo_used=False, freq=100.0)
    wheels, imus = graph.advertise("/odom", "nav_msgs/Odometry"), graph.advertise("/imu_data", "sensor_msgs/Imu")
    graph.until(lambda: graph.linked("/robot_pose_ekf/odom_combined"))
    start_ns = graph.client.clock.now_ns()

    def arrived() -> bool:
        now_ns = graph.client.clock.now_ns()
        time = (now_ns - start_ns) / 1e9
        # what slipping wheels report: each bit of way is forward, the heading five times too fast
        wheels.publish(odometry(now_ns, 0.5 * math.sin(time), 0.5 * (1.0 - math.cos(time)), time))
        imus.publish(imu(now_ns, 0.3 + 0.2 * time))
        return bool(combined) and time > 2.0

    graph.until(arrived)
    pose = combined[-1].pose.pose
    yaw = 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)
    first = combined[0].pose.pose
    turned = yaw - 2.0 * math.atan2(first.orientation.z, first.orientation.w)
    assert turned > 0.2
    way = math.hypot(pose.position.x - first.position.x, pose.position.y - first.position.y)
    assert way == pytest.approx(2.0 * 2.5 * math.sin(turned / 2.0), rel=0.05)
    assert combined[-1].header.frame_id == "odom_combined"
    graph.until(lambda: buffer.can_transform("odom_combined", "base_footprint"))
    status = graph.call("/robot_pose_ekf/get_status", "robot_pose_ekf/GetStatus").status
    assert "listens to topic /imu_data" in status
    assert "NOT used" in status


def test_a_measurement_without_a_variance_is_left_out_with_a_sentence(graph: Any) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    graph.start("robot_pose_ekf/robot_pose_ekf")
    wheels = graph.advertise("/odom", "nav_msgs/Odometry")
    graph.until(lambda: graph.connected("/rosout"))
    message = odometry(10**9, 0.0, 0.0, 0.0)
    message["pose"]["covariance"] = [0.0] * 36

    def warned() -> bool:
        wheels.publish(message)
        return any("a variance that is not positive" in str(line.msg) for line in log)

    graph.until(warned)
