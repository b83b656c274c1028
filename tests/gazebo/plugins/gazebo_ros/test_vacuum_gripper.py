"""libgazebo_ros_vacuum_gripper.so: switched on and off, and its topic."""

import pytest
from tests.gazebo_server import PATIENCE_S, Gazebo, until

_INERTIA = "<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>"
_ARM = f"""<sdf version="1.6"><model name="arm"><pose>0 0 1 0 0 0</pose><link name="cup"><inertial><mass>1</mass>
{_INERTIA}</inertial></link><joint name="weld" type="fixed"><parent>world</parent><child>cup</child></joint>
<plugin name="p" filename="libgazebo_ros_vacuum_gripper.so"><robotNamespace>/arm</robotNamespace>
<bodyName>cup</bodyName><topicName>grasping</topicName>{{more}}</plugin></model></sdf>"""
_BALL = f"""<sdf version="1.6"><model name="ball"><pose>0 0 {{z}} 0 0 0</pose><link name="l"><inertial><mass>0.1</mass>
{_INERTIA}</inertial></link></model></sdf>"""


def _switch(gazebo: Gazebo, service: str) -> None:
    gazebo.loop.run(gazebo.client.call_service(f"/arm/{service}", "std_srvs/Empty", {}), timeout_s=PATIENCE_S)


def _z(gazebo: Gazebo, model: str) -> float:
    return float(gazebo.state(model).pose.position.z)


def test_a_nearby_link_is_held_while_the_gripper_is_on(gazebo: Gazebo) -> None:
    assert gazebo.spawn(_ARM.format(more=""), "arm").success
    assert gazebo.spawn(_BALL.format(z=0.97), "ball").success
    assert gazebo.spawn(_BALL.format(z=0.9), "other").success
    messages = gazebo.subscribe("/arm/grasping", "std_msgs/Bool")
    _switch(gazebo, "on")
    gazebo.call("unpause_physics")
    gazebo.until_s(0.5)
    assert _z(gazebo, "ball") == pytest.approx(1.0, abs=0.05)
    assert _z(gazebo, "other") < 0.5, "too far away"
    assert messages[-1].data

    _switch(gazebo, "off")
    until(lambda: not messages[-1].data)
    until(lambda: _z(gazebo, "ball") < 0.5)


def test_unknown_and_missing_parameters_are_reported(gazebo: Gazebo) -> None:
    assert gazebo.spawn(_ARM.format(more="<maxForce>9</maxForce>"), "arm").success
    assert gazebo.spawn(_ARM.format(more="").replace("grasping", "").replace("/arm<", "/b<"), "b").success
    for message in ("<maxForce>", "<topicName> is missing"):
        until(lambda message=message: any(message in warning for warning in gazebo.report.warnings))
