"""A robot package as in ros_control's tutorial: xacro, transmissions, YAML, spawners, one launch file."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.page.built_client import needs_client
from tests.page.panel_user import PanelUser
from tests.system.browser import running_page

XACRO = """<?xml version="1.0"?>
<robot name="rr" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="body" params="name">
<link name="${name}">
<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
</link></xacro:macro>
<link name="world"/><xacro:body name="base"/><xacro:body name="arm"/>
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
<dynamics damping="0.7"/></joint>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
<joint name="shoulder"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
<actuator name="m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>
<gazebo><plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so">
<robotNamespace>/rr</robotNamespace></plugin></gazebo>
</robot>
"""
YAML = """rr:
  joint_state_controller: {type: joint_state_controller/JointStateController, publish_rate: 50}
  shoulder_position_controller:
    type: effort_controllers/JointPositionController
    joint: shoulder
    pid: {p: 100.0, i: 0.01, d: 10.0}
"""
LAUNCH = """<launch>
<include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/></include>
<param name="robot_description" command="$(find xacro)/xacro $(dirname)/rr.xacro"/>
<node name="urdf_spawner" pkg="gazebo_ros" type="spawn_model" args="-urdf -model rr -param robot_description"/>
<rosparam file="$(dirname)/rr.yaml" command="load"/>
<node name="controller_spawner" pkg="controller_manager" type="spawner" ns="/rr" output="screen"
 args="joint_state_controller shoulder_position_controller"/>
<node name="robot_state_publisher" pkg="robot_state_publisher" type="robot_state_publisher">
<remap from="/joint_states" to="/rr/joint_states"/></node>
</launch>
"""


_GOAL = """{goal: {trajectory: {joint_names: [shoulder], points: [
{positions: [0.4], time_from_start: {secs: 1}}, {positions: [0.8], time_from_start: {secs: 2}}]}}}"""


@pytest.mark.slow
def test_an_action_moves_the_arm_along_a_trajectory(
    start: Callable[..., Any], trundle: Callable[..., Any], until: Callable[..., None], tmp_path: Path
) -> None:
    controller = "{type: position_controllers/JointTrajectoryController, joints: [shoulder]}"
    yaml = f"{YAML.partition('  shoulder')[0]}  arm_controller: {controller}\n"
    launch = LAUNCH.replace("shoulder_position_controller", "arm_controller")
    xacro = XACRO.replace("EffortJointInterface", "PositionJointInterface")
    for name, text in (("rr.xacro", xacro), ("rr.yaml", yaml), ("rr.launch", launch)):
        (tmp_path / name).write_text(text)
    running = start("launch", str(tmp_path / "rr.launch"), "--headless")
    until("the controllers", lambda: "Started controllers: joint_state_controller, arm_controller" in running.output())
    action = "/rr/arm_controller/follow_joint_trajectory"
    kind = "control_msgs/FollowJointTrajectoryActionGoal"
    assert trundle("topic", "pub", "-1", f"{action}/goal", kind, _GOAL).returncode == 0

    def position() -> float:
        return float(trundle("topic", "echo", "-n", "1", "/rr/joint_states/position[0]").stdout.split()[0])

    until("the arm at the end", lambda: position() == pytest.approx(0.8, abs=1e-3))
    assert running.interrupt() == 130
    assert "Traceback" not in running.output()


@pytest.mark.slow
def test_a_published_robot_drives_by_cmd_vel_as_in_its_tutorial(
    start: Callable[..., Any], trundle: Callable[..., Any], until: Callable[..., None], master: Any, shared: Path
) -> None:
    """urdf_sim_tutorial's R2D2 with its diff_drive_controller."""
    repositories = shared / "corpus/repos"
    if not repositories.is_dir():
        pytest.skip("the published launch files (../shared/corpus) are not beside this checkout")
    running = start(
        "launch", "urdf_sim_tutorial", "13-diffdrive.launch", "--headless", ROS_PACKAGE_PATH=str(repositories)
    )
    base = "/r2d2_diff_drive_controller"
    until("the controller", lambda: f"{base}/odom" in dict(master.call("getTopicTypes")))
    publisher = start("topic", "pub", "-r", "10", f"{base}/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.5}}")

    def forwards() -> float:
        output = trundle("topic", "echo", "-n", "1", f"{base}/odom/pose/pose/position/x").stdout
        return float(output.split()[0])

    until("it to drive", lambda: forwards() > 0.3)
    publisher.interrupt()

    def speed() -> float:
        return float(trundle("topic", "echo", "-n", "1", f"{base}/odom/twist/twist/linear/x").stdout.split()[0])

    until("it to stop, as commands have ended", lambda: abs(speed()) < 0.01)
    assert running.interrupt() == 130
    assert "Traceback" not in running.output()


@pytest.mark.slow
def test_a_command_rotates_the_arm_and_its_frame(
    start: Callable[..., Any], trundle: Callable[..., Any], until: Callable[..., None], tmp_path: Path
) -> None:
    for name, text in (("rr.xacro", XACRO), ("rr.yaml", YAML), ("rr.launch", LAUNCH)):
        (tmp_path / name).write_text(text)
    running = start("launch", str(tmp_path / "rr.launch"), "--headless")
    started = "Started controllers: joint_state_controller, shoulder_position_controller"
    until("the controllers", lambda: started in running.output())
    trundle("topic", "pub", "-1", "/rr/shoulder_position_controller/command", "std_msgs/Float64", "data: 1.5")

    def arm() -> str:
        return trundle("tf", "echo", "-n", "1", "base", "arm").stdout

    until("the arm at 1.5 rad", lambda: "in RPY (radian) [0.000, 1.50" in arm() or "[0.000, 1.49" in arm())
    state = trundle("topic", "echo", "-n", "1", "/rr/shoulder_position_controller/state/set_point").stdout
    assert state == "1.5\n---\n"
    assert running.interrupt() == 130
    assert "Traceback" not in running.output()
    assert "error" not in running.output().lower()


@needs_client
@pytest.mark.slow
def test_gains_of_a_controller_are_changed_on_the_page(
    chromium: Any, trundle: Callable[..., Any], until: Callable[..., None], env: dict[str, str], tmp_path: Path
) -> None:
    """The arm has a target and zero gains until p is entered on the page."""
    launch = LAUNCH.replace('<arg name="gui" value="false"/>', "")
    for name, text in (
        ("rr.xacro", XACRO),
        ("rr.yaml", YAML.replace("p: 100.0, i: 0.01, d: 10.0", "p: 0.0")),
        ("rr.launch", launch),
    ):
        (tmp_path / name).write_text(text)

    def position() -> float:
        return float(trundle("topic", "echo", "-n", "1", "/rr/joint_states/position[0]").stdout.split()[0])

    with running_page("launch", str(tmp_path / "rr.launch"), "--view-port", "0", environment=env) as url:
        user = PanelUser(chromium, url)
        user.open("Reconfigure")
        user.page.get_by_role("option", name="/rr/shoulder_position_controller/pid").click()
        user.field("p").wait_for()
        command = "/rr/shoulder_position_controller/command"
        assert trundle("topic", "pub", "-1", command, "std_msgs/Float64", "1.0").returncode == 0
        assert position() == pytest.approx(0.0, abs=0.01)
        user.type("p", "100")
        until("the arm at its target", lambda: position() == pytest.approx(1.0, abs=0.02))
        user.close()
