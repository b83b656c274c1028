"""Quadrotor on the ROS graph, commanded and read by RotorS' topics."""

import pytest
from tests.gazebo.plugins.rotors.quadrotor import HOVER, PLUGIN, quadrotor
from tests.gazebo_server import Gazebo, until

_PLUGINS = {
    "controller_interface": "",
    "multirotor_base_plugin": "<linkName>base_link</linkName>",
    "imu_plugin": "<linkName>base_link</linkName>",
    "odometry_plugin": "<linkName>base_link</linkName><odometryTopic>odometry_sensor1/odometry</odometryTopic>",
}


def test_a_controller_flies_a_quadrotor_through_its_topics(gazebo: Gazebo) -> None:
    plugins = "".join(PLUGIN.format(name, parameters) for name, parameters in _PLUGINS.items())
    model = f'<sdf version="1.6"><model name="quad">{quadrotor(plugins)}</model></sdf>'
    assert gazebo.spawn(model, "quad").success
    odometry = gazebo.subscribe("/quad/odometry_sensor1/odometry", "nav_msgs/Odometry")
    imu_messages = gazebo.subscribe("/quad/imu", "sensor_msgs/Imu")
    speeds = gazebo.subscribe("/quad/motor_speed", "mav_msgs/Actuators")
    fly = gazebo.advertise("/quad/command/motor_speed", "mav_msgs/Actuators")
    fly({"angular_velocities": [1.1 * HOVER] * 4})
    gazebo.call("unpause_physics")

    until(lambda: odometry and odometry[-1].pose.pose.position.z > 1.5)
    assert list(map(abs, speeds[-1].angular_velocities)) == pytest.approx([1.1 * HOVER] * 4, rel=1e-2)
    assert imu_messages[-1].linear_acceleration.z == pytest.approx(1.1**2 * 9.8, abs=1.0)
    assert gazebo.report.warnings == []
