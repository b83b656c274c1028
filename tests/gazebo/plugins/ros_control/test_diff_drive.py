"""A robot on two driven wheels behind diff_drive_controller, on the ground."""

import math
from collections.abc import Iterator
from typing import Any

import pytest
from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.controller_manager import Spawner
from trundle.ros import Message, Node
from trundle.sim.control import SpeedLimit

_RADIUS, _SEPARATION = 0.1, 0.4


def _inertial(mass: float, moment: float) -> str:
    moments = " ".join(f'{name}="{moment}"' for name in ("ixx", "iyy", "izz"))
    return f'<inertial><mass value="{mass}"/><inertia {moments} ixy="0" ixz="0" iyz="0"/></inertial>'


def _wheel(side: str, y: float) -> str:
    cylinder = f'<geometry><cylinder radius="{_RADIUS}" length="0.04"/></geometry>'
    return f"""<link name="{side}">{_inertial(0.5, 0.002)}
<collision><origin rpy="{math.pi / 2} 0 0"/>{cylinder}</collision></link>
<joint name="{side}_joint" type="continuous"><parent link="base_link"/><child link="{side}"/>
<origin xyz="0 {y} 0"/><axis xyz="0 1 0"/></joint>
<transmission name="{side}_t"><type>transmission_interface/SimpleTransmission</type>
<joint name="{side}_joint"><hardwareInterface>VelocityJointInterface</hardwareInterface></joint>
<actuator name="{side}_m"/></transmission>"""


_BALL = f'<collision><origin xyz="{{0}} 0 {-_RADIUS / 2}"/><geometry><sphere radius="0.05"/></geometry></collision>'
CAR = f"""<robot name="car"><link name="base_link">{_inertial(5, 0.1)}{_BALL.format(0.15)}{_BALL.format(-0.15)}</link>
{_wheel("left", _SEPARATION / 2)}{_wheel("right", -_SEPARATION / 2)}
<gazebo reference="base_link"><mu1>0</mu1><mu2>0</mu2></gazebo>
<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/</robotNamespace></plugin></gazebo>
</robot>"""
BASE: dict[str, Any] = {
    "type": "diff_drive_controller/DiffDriveController",
    "left_wheel": "left_joint",
    "right_wheel": ["right_joint"],
    "pose_covariance_diagonal": [0.1, 0.1, 0.1, 0.2, 0.2, 0.2],
    "linear": {"x": {"has_velocity_limits": True, "max_velocity": 0.5}},
}


@pytest.fixture
def car(gazebo: Gazebo) -> Iterator[Gazebo]:
    gazebo.loop.run(gazebo.client.params.set("/robot_description", CAR))
    gazebo.loop.run(gazebo.client.params.set("/base", BASE))
    pose = {"position": {"z": _RADIUS}}
    response = gazebo.call(
        "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="car", model_xml=CAR, initial_pose=pose
    )
    assert response.success, response.status_message
    node = Node("/spawner", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
    future = gazebo.loop.spawn(Spawner(node, ["base"], NodeHost()).run())
    gazebo.call("unpause_physics")
    yield gazebo
    future.cancel()
    gazebo.loop.run(node.shutdown(), timeout_s=PATIENCE_S)


def _yaw(message: Message) -> float:
    orientation = message.pose.pose.orientation
    return 2.0 * math.atan2(orientation.z, orientation.w)


def test_a_command_drives_and_odometry_follows_the_wheels(car: Gazebo) -> None:
    odometry = car.subscribe("/base/odom", "nav_msgs/Odometry")
    frames = car.subscribe("/tf", "tf2_msgs/TFMessage")
    drive = car.advertise("/base/cmd_vel", "geometry_msgs/Twist")

    def arrived() -> bool:
        drive({"linear": {"x": 5.0}})  # limited to 0.5 m/s
        return bool(odometry) and odometry[-1].pose.pose.position.x > 0.5

    until(arrived)
    assert odometry[-1].twist.twist.linear.x == pytest.approx(0.5, abs=0.01)
    assert (odometry[0].header.frame_id, odometry[0].child_frame_id) == ("odom", "base_link")
    assert odometry[0].pose.covariance[7] == 0.1
    assert frames[-1].transforms[0].child_frame_id == "base_link"

    def stopped() -> bool:
        return abs(odometry[-1].twist.twist.linear.x) < 1e-3

    until(stopped)  # no more commands
    until(lambda: abs(car.state("car").twist.linear.x) < 1e-3)  # the car slides on after its wheels have stopped
    estimate, truth = odometry[-1].pose.pose.position, car.state("car").pose.position
    assert (estimate.x, estimate.y) == (pytest.approx(truth.x, abs=0.02), pytest.approx(truth.y, abs=0.02))


def test_a_positive_yaw_rate_turns_left(car: Gazebo) -> None:
    odometry = car.subscribe("/base/odom", "nav_msgs/Odometry")
    drive = car.advertise("/base/cmd_vel", "geometry_msgs/Twist")

    def turned() -> bool:
        drive({"angular": {"z": 1.0}})
        return bool(odometry) and _yaw(odometry[-1]) > 0.5

    until(turned)
    assert odometry[-1].twist.twist.angular.z == pytest.approx(1.0, abs=0.02)
    state = car.state("car").pose.orientation
    assert 2.0 * math.atan2(state.z, state.w) > 0.4


def test_speeds_change_no_faster_than_their_limits() -> None:
    limit = SpeedLimit(min_velocity=-1.0, max_velocity=2.0, min_acceleration=-4.0, max_acceleration=1.0)
    assert limit.limit(5.0, 0.0, 0.0, 0.1) == pytest.approx(0.1)
    assert limit.limit(-5.0, 0.0, 0.0, 0.1) == pytest.approx(-0.4)
    assert limit.limit(5.0, 1.95, 1.9, 0.1) == 2.0
    assert SpeedLimit(max_jerk=10.0, min_jerk=-10.0).limit(5.0, 0.0, 0.0, 0.1) == pytest.approx(0.2)
