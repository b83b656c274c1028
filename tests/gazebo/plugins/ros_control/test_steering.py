"""Robots with steered wheels behind ackermann_ and four_wheel_steering_controller."""

import math
from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.steered import RADIUS, knuckle, robot, wheel
from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.controller_manager import Spawner
from trundle.ros import Message, Node

_SKID = '<collision><origin xyz="{} {} -0.048"/><geometry><sphere radius="0.05"/></geometry></collision>'
BIKE = robot(
    wheel("rear", "base_link", 0.0, 0.0) + knuckle("fork", 0.5, 0.0) + wheel("front", "fork", 0.0, 0.0, driven=False),
    com="0.25 0 0",
    skids=_SKID.format(0.25, 0.2) + _SKID.format(0.25, -0.2),
)
ACKERMANN: dict[str, Any] = {
    "type": "ackermann_steering_controller/AckermannSteeringController",
    "rear_wheel": "rear_joint",
    "front_steer": "fork_joint",
    "pose_covariance_diagonal": [0.1, 0.1, 0.1, 0.2, 0.2, 0.2],
    "linear": {"x": {"has_velocity_limits": True, "max_velocity": 0.5}},
}

_CORNERS = {"fl": (0.25, 0.2), "fr": (0.25, -0.2), "rl": (-0.25, 0.2), "rr": (-0.25, -0.2)}
ROVER = robot(
    "".join(knuckle(f"{name}_steer", x, y) for name, (x, y) in _CORNERS.items())
    + "".join(wheel(name, f"{name}_steer", 0.0, math.copysign(0.05, y)) for name, (_, y) in _CORNERS.items())
)
FOUR: dict[str, Any] = {
    "type": "four_wheel_steering_controller/FourWheelSteeringController",
    "front_wheel": ["fl_joint", "fr_joint"],
    "rear_wheel": ["rl_joint", "rr_joint"],
    "front_steering": ["fl_steer_joint", "fr_steer_joint"],
    "rear_steering": ["rl_steer_joint", "rr_steer_joint"],
}


@contextmanager
def driving(gazebo: Gazebo, urdf: str, settings: dict[str, Any]) -> Generator[None]:
    """Spawn a robot on the ground and run its controller `base`."""
    gazebo.loop.run(gazebo.client.params.set("/robot_description", urdf))
    gazebo.loop.run(gazebo.client.params.set("/base", settings))
    pose = {"position": {"z": RADIUS}}
    response = gazebo.call(
        "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="car", model_xml=urdf, initial_pose=pose
    )
    assert response.success, response.status_message
    node = Node("/spawner", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
    future = gazebo.loop.spawn(Spawner(node, ["base"], NodeHost()).run())
    gazebo.call("unpause_physics")
    yield
    future.cancel()
    gazebo.loop.run(node.shutdown(), timeout_s=PATIENCE_S)


def repeat_until(
    publish: Callable[[dict[str, Any]], None], message: dict[str, Any], done: Callable[[], object]
) -> None:
    """Repeat a command until a condition holds."""

    def is_done() -> object:
        publish(message)
        return done()

    until(is_done)


def _yaw(pose: Message) -> float:
    return 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def _assert_odometry_matches(gazebo: Gazebo, odometry: list[Message], *, tolerance: float) -> None:
    """Assert that odometry agrees with the true pose of a robot at rest."""
    until(lambda: abs(odometry[-1].twist.twist.linear.x) < 1e-3)
    estimate, truth = odometry[-1].pose.pose, gazebo.state("car").pose
    assert (estimate.position.x, estimate.position.y) == (
        pytest.approx(truth.position.x, abs=tolerance),
        pytest.approx(truth.position.y, abs=tolerance),
    )
    assert _yaw(estimate) == pytest.approx(_yaw(truth), abs=tolerance)


def test_ackermann_steering_turns_by_its_steering_angle(gazebo: Gazebo) -> None:
    """angular.z is the steering angle: at 0.5 m/s, 0.5 m between the wheels and 0.4 rad it turns at tan 0.4 rad/s."""
    with driving(gazebo, BIKE, ACKERMANN):
        odometry = gazebo.subscribe("/base/odom", "nav_msgs/Odometry")
        frames = gazebo.subscribe("/tf", "tf2_msgs/TFMessage")
        drive = gazebo.advertise("/base/cmd_vel", "geometry_msgs/Twist")
        command = {"linear": {"x": 5.0}, "angular": {"z": 0.4}}
        repeat_until(drive, command, lambda: odometry and _yaw(odometry[-1].pose.pose) > 1.0)

        assert odometry[-1].twist.twist.linear.x == pytest.approx(0.5, abs=0.01)
        assert odometry[-1].twist.twist.angular.z == pytest.approx(math.tan(0.4), abs=0.02)
        assert (odometry[0].header.frame_id, odometry[0].child_frame_id) == ("odom", "base_link")
        assert odometry[0].pose.covariance[7] == 0.1
        assert frames[-1].transforms[0].child_frame_id == "base_link"
        _assert_odometry_matches(gazebo, odometry, tolerance=0.08)  # no more commands


def test_a_second_command_publisher_is_refused_if_not_allowed(gazebo: Gazebo) -> None:
    with driving(gazebo, BIKE, {**ACKERMANN, "allow_multiple_cmd_vel_publishers": False}):
        log = gazebo.subscribe("/rosout_agg", "rosgraph_msgs/Log")
        odometry = gazebo.subscribe("/base/odom", "nav_msgs/Odometry")
        drive = gazebo.advertise("/base/cmd_vel", "geometry_msgs/Twist")
        until(lambda: odometry)
        other = Node("/other", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
        other_publisher = other.advertise("/base/cmd_vel", "geometry_msgs/Twist")
        until(lambda: other_publisher.has_subscribers)
        error = "Detected 2 publishers. Only 1 publisher is allowed."
        repeat_until(drive, {"linear": {"x": 0.5}}, lambda: any(error in str(line.msg) for line in log))
        assert odometry[-1].pose.pose.position.x == pytest.approx(0.0, abs=1e-3)
        gazebo.loop.run(other.shutdown(), timeout_s=PATIENCE_S)


def test_four_wheel_steering_follows_a_twist(gazebo: Gazebo) -> None:
    with driving(gazebo, ROVER, FOUR):
        odometry = gazebo.subscribe("/base/odom", "nav_msgs/Odometry")
        drive = gazebo.advertise("/base/cmd_vel", "geometry_msgs/Twist")
        command = {"linear": {"x": 0.5}, "angular": {"z": 0.6}}
        repeat_until(drive, command, lambda: odometry and _yaw(odometry[-1].pose.pose) > 1.0)

        assert odometry[-1].twist.twist.linear.x == pytest.approx(0.5, abs=0.02)
        assert odometry[-1].twist.twist.angular.z == pytest.approx(0.6, abs=0.02)
        assert (odometry[0].header.frame_id, odometry[0].child_frame_id) == ("odom", "base_link")
        _assert_odometry_matches(gazebo, odometry, tolerance=0.08)


def test_equally_steered_axles_drive_sideways(gazebo: Gazebo) -> None:
    with driving(gazebo, ROVER, FOUR):
        odometry = gazebo.subscribe("/base/odom", "nav_msgs/Odometry")
        messages = gazebo.subscribe("/base/odom_steer", "four_wheel_steering_msgs/FourWheelSteeringStamped")
        steer = gazebo.advertise("/base/cmd_four_wheel_steering", "four_wheel_steering_msgs/FourWheelSteering")
        command = {"speed": 0.5, "front_steering_angle": 0.5, "rear_steering_angle": 0.5}
        repeat_until(steer, command, lambda: odometry and odometry[-1].pose.pose.position.y > 0.3)

        assert odometry[-1].twist.twist.linear.y == pytest.approx(0.5 * math.sin(0.5), abs=0.02)
        assert _yaw(odometry[-1].pose.pose) == pytest.approx(0.0, abs=0.05)
        assert messages[-1].data.speed == pytest.approx(0.5, abs=0.02)
        assert messages[-1].data.rear_steering_angle == pytest.approx(0.5, abs=0.02)
        _assert_odometry_matches(gazebo, odometry, tolerance=0.08)


def test_a_single_joint_for_an_axle_is_refused(gazebo: Gazebo) -> None:
    with driving(gazebo, ROVER, {**FOUR, "front_wheel": "fl_joint"}):
        log = gazebo.subscribe("/rosout_agg", "rosgraph_msgs/Log")
        error = "Could not load controller 'base': parameter /base/front_wheel must be a left and a right joint"
        call = ("/controller_manager/load_controller", "controller_manager_msgs/LoadController", {"name": "base"})
        gazebo.loop.run(gazebo.client.wait_for_service(call[0], PATIENCE_S))

        def is_logged() -> bool:
            assert not gazebo.loop.run(gazebo.client.call_service(*call), timeout_s=PATIENCE_S).ok
            return any(error in str(line.msg) for line in log)

        until(is_logged)
