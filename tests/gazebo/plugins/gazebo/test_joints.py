"""Plugins that drive joints, against the motion of an inertia under a torque."""

import math
from pathlib import Path

import pytest
from tests.gazebo.plugins.plugin_world import ARM, FakeNode, load

from trundle.sim.control import Pid

CONTROL = '<plugin name="p" filename="libJointControlPlugin.so">{}</plugin>'
KEYS = '<plugin name="p" filename="libKeysToJointsPlugin.so">{}</plugin>'
INERTIA = 0.1
"""[kg·m²]"""


def test_a_force_controller_accelerates_constantly(tmp_path: Path) -> None:
    sim = load(
        tmp_path,
        ARM + CONTROL.format('<controller type="force"><joint>hinge</joint><target>0.2</target></controller>'),
    )
    sim.run(1.0)

    assert sim["m"].joint("hinge").velocity == pytest.approx(0.2 / INERTIA, rel=1e-6)


def test_a_position_controller_acts_as_a_spring_and_a_damper(tmp_path: Path) -> None:
    """p = 4 N·m/rad and d = 2·√(4·0.1), critical: q = 1 − (1 + ωt) e^(−ωt) once the first jump of d is over."""
    gains = f"{4.0} 0 {2 * math.sqrt(4 * INERTIA)}"
    controller = f'<controller type="position"><joint>hi.*</joint><target>1</target><pid_gains>{gains}</pid_gains>'
    sim = load(tmp_path, ARM + CONTROL.format(controller + "</controller>"))
    sim.run(3.0)

    assert sim["m"].joint("hinge").position == pytest.approx(1.0, abs=1e-4)
    sim.reset()
    sim.run(3.0)
    assert sim["m"].joint("hinge").position == pytest.approx(1.0, abs=1e-4)


def test_a_velocity_controller_converges_with_the_time_constant_of_its_gain(tmp_path: Path) -> None:
    controller = '<controller type="velocity"><joint>hinge</joint><target>2</target><pid_gains>0.5 0 0</pid_gains>'
    sim = load(tmp_path, ARM + CONTROL.format(controller + "</controller>"))
    sim.run(0.2)

    assert sim["m"].joint("hinge").velocity == pytest.approx(2 * (1 - math.exp(-0.5 / INERTIA * 0.2)), rel=5e-3)


def test_an_invalid_controller_is_reported(tmp_path: Path) -> None:
    controllers = (
        '<controller type="torque"><joint>hinge</joint></controller>'
        '<controller type="force"><joint>elbow</joint><joint>(</joint><target>1</target></controller>'
    )
    sim = load(tmp_path, ARM + CONTROL.format(controllers))

    warnings = " ".join(sim.report.warnings)
    assert "no controller type 'torque'; types: force, position, velocity" in warnings
    assert "no movable joint matches 'elbow'; joints here: 'weld', 'hinge'" in warnings
    assert "'(' is not a regular expression" in warnings


def test_the_simple_arm_follows_cosines(tmp_path: Path) -> None:
    swinging = ARM.replace('"hinge"', '"simple::arm_wrist_lift_joint"').replace('version="1.6"', 'version="1.5"')
    sim = load(tmp_path, swinging + '<plugin name="p" filename="libJointTrajectoryPlugin.so"/>')
    sim.run(1.5)

    position = sim["m"].joints[1].position
    assert position == pytest.approx(-0.35 + 0.45 * math.cos(0.5 * 1.5), abs=1e-3)


def test_keys_move_joints(tmp_path: Path) -> None:
    node = FakeNode()
    maps = (
        '<map key="119" scale="0.5" type="position" kp="10" kd="2"><joint>hinge</joint></map>'
        '<map key="115" scale="3" type="force"><joint>hinge</joint></map>'
        '<map key="97" scale="3" type="force"><joint>elbow</joint></map><map key="98"><joint>hinge</joint></map>'
    )
    sim = load(tmp_path, ARM + KEYS.format(maps), node=node)
    hinge = sim["m"].joint("hinge")

    node.receive("/keyboard/keypress", data=115)
    sim.run(0.01)
    assert hinge.velocity == pytest.approx(3 / INERTIA * 0.001, rel=1e-6), "one step of force"
    hinge.set_position(0.0)
    node.receive("/keyboard/keypress", data=119)
    sim.run(5.0)
    assert hinge.position == pytest.approx(0.5, abs=1e-3)
    assert len(sim.report.warnings) == 2


def test_keys_drive_as_in_gazebo_and_stop_at_the_limits(tmp_path: Path) -> None:
    node = FakeNode()
    parameters = "<cmd_vel_topic>~/tank/cmd_vel</cmd_vel_topic><max_linear_vel>0.8</max_linear_vel>"
    load(tmp_path, ARM + f'<plugin name="p" filename="libKeysToCmdVelPlugin.so">{parameters}</plugin>', node=node)

    for key in (16777235, 16777235, 37, 40, 99, 32):
        node.receive("/keyboard/keypress", data=key)

    poses = node.published["/tank/cmd_vel"]
    assert [pose.position.x for pose in poses] == pytest.approx([0.5, 0.8, 0.8, 0.3, 0.0])
    yaws = [2 * math.atan2(pose.orientation.z, pose.orientation.w) for pose in poses]
    assert yaws == pytest.approx([0.0, 0.0, -0.5, -0.5, 0.0])


def test_keys_without_a_ros_graph_are_reported(tmp_path: Path) -> None:
    sim = load(tmp_path, ARM + KEYS.format(""))

    (warning,) = sim.report.warnings
    assert warning.endswith("plugin 'p' reads keys from a ROS topic, which --no-ros leaves out")


def test_a_pid_law_clamps_its_integral_and_its_command() -> None:
    pid = Pid(p=2.0, i=10.0, d=0.5, i_min=-1.0, i_max=1.0, low=-4.0, high=100.0)

    # −(2·1 + clamp(10·0.5) + 0.5·1/0.5), then an integral that leaves its clamp at once.
    assert pid.command(1.0, 0.5) == -4.0
    assert pid.command(-0.01, 0.5) == pytest.approx(0.02 - (1.0 - 0.05) + 0.5 * 1.01 / 0.5)
    pid.reset()
    assert pid.command(0.0, 0.5) == 0.0
    assert pid.command(1.0, 0.0) == 0.0
