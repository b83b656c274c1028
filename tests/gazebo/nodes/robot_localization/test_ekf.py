"""ekf_localization_node on a graph: what it publishes of odometry and an imu."""

import math
from typing import Any

import numpy as np
import pytest

from trundle.ros import Transform, TransformListener

NOW: dict[str, Any] = {"stamp": "now"}
_COVARIANCE = (0.01 * np.eye(6)).ravel().tolist()


def config(*used: int) -> list[bool]:
    return [index in used for index in range(15)]


def speed(x: float, turning: float, stamp_ns: int) -> dict[str, Any]:
    twist = {"twist": {"linear": {"x": x}, "angular": {"z": turning}}, "covariance": _COVARIANCE}
    return {"header": {"stamp": stamp_ns, "frame_id": "odom"}, "child_frame_id": "base_link", "twist": twist}


@pytest.mark.parametrize("program", ["ekf_localization_node", "ukf_localization_node"])
def test_wheels_and_an_imu_give_the_pose_and_its_transform(stage, program: str) -> None:
    """Wheels claim to turn at 1 rad/s; the better imu says 0.2 rad/s, and is believed."""
    heard = stage.listen("/odometry/filtered", "nav_msgs/Odometry")
    buffer = TransformListener(stage.client).buffer
    stage.start(
        f"robot_localization/{program}",
        frequency=50.0,
        two_d_mode=True,
        odom0="wheels",
        odom0_config=config(6, 7, 11),
        imu0="imu",
        imu0_config=config(11),
    )
    wheels, imu = stage.speak("/wheels", "nav_msgs/Odometry"), stage.speak("/imu", "sensor_msgs/Imu")
    stage.until(lambda: stage.linked("/odometry/filtered"))
    certain = (1e-6 * np.eye(3)).ravel().tolist()

    def arrived() -> object:
        now = stage.client.clock.now_ns()
        wheels.publish(speed(0.5, 1.0, now))
        header = {"stamp": now, "frame_id": "base_link"}
        imu.publish({"header": header, "angular_velocity": {"z": 0.2}, "angular_velocity_covariance": certain})
        return heard and heard[-1].pose.pose.position.x > 0.3

    stage.until(arrived)
    last = heard[-1]
    assert (last.header.frame_id, last.child_frame_id) == ("odom", "base_link")
    assert last.twist.twist.linear.x == pytest.approx(0.5, abs=0.02)
    assert last.twist.twist.angular.z == pytest.approx(0.2, abs=0.02)
    assert abs(last.pose.pose.position.z) < 1e-3
    yaw = 2.0 * math.atan2(last.pose.pose.orientation.z, last.pose.pose.orientation.w)
    assert last.pose.pose.position.x == pytest.approx(0.5 / 0.2 * math.sin(yaw), abs=0.05), "an arc of 2.5 m radius"
    assert last.pose.covariance[0] > 0.0
    stage.until(lambda: buffer.can_transform("odom", "base_link"))
    assert buffer.lookup_transform("odom", "base_link").translation[0] > 0.0


def test_in_the_map_it_sends_where_odometry_began(stage) -> None:
    """The robot is 1 m on by odometry, and 3 m on in the map: the odometry frame is 2 m on."""
    buffer = TransformListener(stage.client).buffer
    stage.start(
        "robot_localization/ekf_localization_node", world_frame="map", pose0="gps", pose0_config=config(0, 1, 5)
    )
    gps = stage.speak("/gps", "geometry_msgs/PoseWithCovarianceStamped")
    frames = stage.client.advertise("/tf", "tf2_msgs/TFMessage", queue_size=None)

    def arrived() -> object:
        now = stage.client.clock.now_ns()
        odom = {"header": {"stamp": now, "frame_id": "odom"}, "child_frame_id": "base_link"}
        frames.publish({"transforms": [{**odom, "transform": {"translation": {"x": 1.0}, "rotation": {"w": 1.0}}}]})
        pose = {"pose": {"position": {"x": 3.0}, "orientation": {"w": 1.0}}, "covariance": _COVARIANCE}
        gps.publish({"header": {"stamp": now, "frame_id": "map"}, "pose": pose})
        return buffer.can_transform("map", "odom")

    stage.until(arrived)
    found: Transform = buffer.lookup_transform("map", "odom")
    assert found.translation == pytest.approx((2.0, 0.0, 0.0), abs=0.05)


def test_set_pose_moves_it_and_toggle_halts_it(stage) -> None:
    heard = stage.listen("/odometry/filtered", "nav_msgs/Odometry")
    stage.start("robot_localization/ekf_localization_node", name="ekf", odom0="wheels", odom0_config=config(6, 7, 11))
    pose = {"pose": {"position": {"x": 7.0, "y": -1.0}, "orientation": {"w": 1.0}}, "covariance": _COVARIANCE}
    header = {"frame_id": "odom"}
    stage.call("/set_pose", "robot_localization/SetPose", pose={"header": header, "pose": pose})
    stage.until(lambda: heard and heard[-1].pose.pose.position.x == pytest.approx(7.0))

    assert stage.call("/ekf/toggle", "robot_localization/ToggleFilterProcessing", on=False).status
    assert not stage.call("/ekf/toggle", "robot_localization/ToggleFilterProcessing", on=False).status


def test_without_a_sensor_it_ends_with_the_parameters_that_it_wants(stage) -> None:
    log = stage.listen("/rosout", "rosgraph_msgs/Log")
    assert stage.start("robot_localization/ekf_localization_node").result(60.0) == 1
    stage.until(lambda: any("no sensor; odom0, pose0, twist0 or imu0" in str(line.msg) for line in log))
