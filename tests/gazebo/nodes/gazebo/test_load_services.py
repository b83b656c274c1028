"""/gazebo's services that apply loads, tested by the motion they cause."""

import math
from typing import Any

import pytest
from tests.gazebo_server import Gazebo

from trundle.ros import Message

_INERTIA = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
_BALL = f"""<sdf version="1.6"><model name="m"><pose>0 0 100 0 0 0</pose><link name="link"><gravity>false</gravity>
<inertial><mass>2</mass>{_INERTIA}</inertial></link></model></sdf>"""
_WHEEL = f"""<sdf version="1.6"><model name="m"><link name="rim"><inertial><mass>1</mass>{_INERTIA}</inertial></link>
<joint name="turn" type="revolute"><parent>world</parent><child>rim</child><axis><xyz>0 0 1</xyz></axis></joint>
</model></sdf>"""
_HALF_S, _UNLIMITED = {"nanosec": 500_000_000}, {"sec": -1}


def _apply_force(gazebo: Gazebo, force_n: float, **more: Any) -> Message:
    fields = {"body_name": "ball::link", "wrench": {"force": {"x": force_n}}, **more}
    return gazebo.call("apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", **fields)


def _after(gazebo: Gazebo, seconds: float) -> Message:
    """Velocity of the ball, while paused."""
    gazebo.call("unpause_physics")
    gazebo.until_s(seconds)
    gazebo.call("pause_physics")
    return gazebo.state("ball").twist


def test_a_wrench_in_the_world_frame_acts_at_the_centre_of_mass(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "ball", x=7.0)
    assert _apply_force(gazebo, 4.0, reference_frame="world", duration=_HALF_S).success

    twist = _after(gazebo, 0.6)
    assert twist.linear.x == pytest.approx(1.0, rel=1e-3)
    assert twist.angular.z == pytest.approx(0.0, abs=1e-9)


def test_a_wrench_has_its_reference_point_and_frame(gazebo: Gazebo) -> None:
    """2 N along the ball's x, a quarter turn from the world's, 0.5 m beside it: −1 N·m for half a second."""
    half = math.sqrt(0.5)
    gazebo.call(
        "spawn_sdf_model",
        "gazebo_msgs/SpawnModel",
        model_name="ball",
        model_xml=_BALL,
        initial_pose={"position": {"x": 7.0}, "orientation": {"z": half, "w": half}},
    )
    _apply_force(gazebo, 2.0, reference_frame="ball::link", reference_point={"y": 0.5}, duration=_HALF_S)

    twist = _after(gazebo, 0.001)
    assert twist.linear.y == pytest.approx(1.0 * gazebo.time_s, rel=0.3)
    assert abs(twist.linear.x) < 0.3 * twist.linear.y
    assert _after(gazebo, 0.6).angular.z == pytest.approx(-5.0, rel=1e-2)


def test_a_wrench_starts_at_its_time_and_the_newest_acts_alone(gazebo: Gazebo) -> None:
    """4 N for ever, but 12 N from 0.5 s to 1 s: 2 kg have 1 m/s, then 4 m/s, then 5 m/s at 1.5 s."""
    gazebo.spawn(_BALL, "ball")
    _apply_force(gazebo, 4.0, duration=_UNLIMITED)
    _apply_force(gazebo, 12.0, start_time=_HALF_S, duration=_HALF_S)

    assert _after(gazebo, 1.5).linear.x == pytest.approx(4.0 + 2.0 * (gazebo.time_s - 1.0), rel=2e-3)
    gazebo.call("clear_body_wrenches", "gazebo_msgs/BodyRequest", body_name="ball::link")
    speed = gazebo.state("ball").twist.linear.x
    assert _after(gazebo, gazebo.time_s + 0.2).linear.x == pytest.approx(speed, rel=1e-6)


def test_a_wrench_continues_after_a_spawn_and_ends_with_a_reset(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "ball")
    _apply_force(gazebo, 4.0, duration=_UNLIMITED)
    gazebo.spawn(_BALL, "other", x=3.0)
    assert _after(gazebo, 0.5).linear.x == pytest.approx(2.0 * gazebo.time_s, rel=2e-3)

    gazebo.call("reset_simulation")
    assert _after(gazebo, 0.2).linear.x == pytest.approx(0.0, abs=1e-9)


def test_joint_efforts_add_up_until_they_are_cleared(gazebo: Gazebo) -> None:
    gazebo.spawn(_WHEEL, "ball")
    for _ in range(2):
        fields = {"joint_name": "turn", "effort": 0.05, "duration": _UNLIMITED}
        assert gazebo.call("apply_joint_effort", "gazebo_msgs/ApplyJointEffort", **fields).success

    assert _after(gazebo, 0.5).angular.z == pytest.approx(gazebo.time_s, rel=5e-3)
    gazebo.call("clear_joint_forces", "gazebo_msgs/JointRequest", joint_name="turn")
    speed = gazebo.state("ball").twist.angular.z
    assert _after(gazebo, gazebo.time_s + 0.2).angular.z == pytest.approx(speed, rel=1e-6)


def test_clearing_an_unknown_body_or_joint_succeeds(gazebo: Gazebo) -> None:
    gazebo.call("clear_body_wrenches", "gazebo_msgs/BodyRequest", body_name="nothing")
    gazebo.call("clear_joint_forces", "gazebo_msgs/JointRequest", joint_name="nothing")
