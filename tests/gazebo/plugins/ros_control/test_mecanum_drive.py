"""A robot with mecanum wheels behind mecanum_drive_controller."""

from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.steered import robot, wheel
from tests.gazebo.plugins.ros_control.test_steering import driving, repeat_until
from tests.gazebo_server import Gazebo

_CORNERS = {"front_left": (0.3, 0.2), "front_right": (0.3, -0.2), "rear_left": (-0.3, 0.2), "rear_right": (-0.3, -0.2)}
_FREE = "".join(f'<gazebo reference="{name}"><mu1>0</mu1><mu2>0</mu2></gazebo>' for name in _CORNERS)
ROBOT = robot("".join(wheel(name, "base_link", x, y) for name, (x, y) in _CORNERS.items()) + _FREE)
MECANUM: dict[str, Any] = {
    "type": "mecanum_drive_controller/MecanumDriveController",
    "front_left_wheel_joint": "front_left_joint",
    "front_right_wheel_joint": "front_right_joint",
    "back_left_wheel_joint": "rear_left_joint",
    "back_right_wheel_joint": "rear_right_joint",
    "linear": {"y": {"has_velocity_limits": True, "max_velocity": 0.2}},
    "twist_covariance_diagonal": [0.1, 0.1, 0.1, 0.2, 0.2, 0.2],
}


def test_wheels_and_odometry_have_the_commanded_twist_within_limits(gazebo: Gazebo) -> None:
    """At 0.3 m/s forward, 0.2 m/s left and 0.4 rad/s, a wheel at (0.3, 0.2) m of radius 0.1 m turns at -1 rad/s."""
    with driving(gazebo, ROBOT, MECANUM):
        odometry = gazebo.subscribe("/base/odom", "nav_msgs/Odometry")
        frames = gazebo.subscribe("/tf", "tf2_msgs/TFMessage")
        drive = gazebo.advertise("/base/cmd_vel", "geometry_msgs/Twist")
        command = {"linear": {"x": 0.3, "y": 5.0}, "angular": {"z": 0.4}}
        repeat_until(drive, command, lambda: odometry and odometry[-1].pose.pose.position.x > 0.1)

        twist = odometry[-1].twist.twist
        assert (twist.linear.x, twist.linear.y) == pytest.approx((0.3, 0.2), abs=0.02)
        assert twist.angular.z == pytest.approx(0.4, abs=0.02)
        assert odometry[-1].pose.pose.position.y > 0.05
        assert odometry[0].twist.covariance[0] == 0.1
        assert frames[-1].transforms[0].child_frame_id == "base_link"
        joints = [
            gazebo.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name=f"{name}_joint")
            for name in _CORNERS
        ]
        wheel_speeds = [joint.rate[0] for joint in joints]
        assert wheel_speeds == pytest.approx([-1.0, 7.0, 3.0, 3.0], abs=0.2)


def test_a_robot_stops_when_commands_end(gazebo: Gazebo) -> None:
    with driving(gazebo, ROBOT, MECANUM):
        odometry = gazebo.subscribe("/base/odom", "nav_msgs/Odometry")
        drive = gazebo.advertise("/base/cmd_vel", "geometry_msgs/Twist")
        repeat_until(drive, {"linear": {"x": 0.3}}, lambda: odometry and odometry[-1].twist.twist.linear.x > 0.25)
        repeat_until(lambda _: None, {}, lambda: abs(odometry[-1].twist.twist.linear.x) < 1e-3)
