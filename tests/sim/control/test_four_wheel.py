"""Four steered wheels against their own geometry."""

import math

import pytest
from hypothesis import given, strategies as st

from trundle.sim.control import FourWheelSteering, axle_angle

LAW = FourWheelSteering(track=0.4, offset=0.05, radius=0.1, base=0.6)


@given(st.floats(0.1, 2.0), st.floats(-0.4, 0.4), st.sampled_from([1.0, -1.0]))
def test_wheel_speeds_determine_the_twist(speed: float, turning: float, sign: float) -> None:
    speeds, (fl, fr, rl, rr) = LAW.command_for_twist(sign * speed, turning)
    forward, sideways, turned = LAW.forward_kinematics(speeds, axle_angle(fl, fr), axle_angle(rl, rr))
    assert (forward, sideways) == (pytest.approx(sign * speed, rel=1e-2), pytest.approx(0.0, abs=1e-2))
    assert turned == pytest.approx(turning, rel=1e-2, abs=1e-2)


@given(st.floats(0.1, 2.0), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_axles_have_the_commanded_angles(speed: float, front: float, rear: float) -> None:
    _, (fl, fr, rl, rr) = LAW.command_for_angles(speed, front, rear)
    assert axle_angle(fl, fr) == pytest.approx(front, abs=2e-3)
    assert axle_angle(rl, rr) == pytest.approx(rear, abs=2e-3)


def test_wheels_are_perpendicular_to_the_direction_of_the_centre_of_rotation() -> None:
    """With both axles turned alike, 1 m/s and 0.5 rad/s turn about a point 2 m to the left, level with the middle."""
    speeds, angles = LAW.command_for_twist(1.0, 0.5)
    for y, angle, speed in zip((0.2, -0.2), angles, speeds, strict=False):
        assert angle == pytest.approx(math.atan2(0.3, 2.0 - y))
        outward = 0.05 if y < 0 else -0.05
        assert speed == pytest.approx(0.5 * (math.hypot(0.3, 2.0 - y) + outward) / 0.1)


def test_a_stationary_robot_keeps_its_steering_angles() -> None:
    assert LAW.command_for_twist(0.0, 1.0) == ((0.0,) * 4, (0.0, 0.0, 0.0, 0.0))
    speeds, (front, *_) = LAW.command_for_angles(0.0, 0.3, -0.3)
    assert speeds == (0.0,) * 4
    assert front > 0.3
    assert LAW.command_for_twist(0.01, 1.0)[1] == (math.pi / 2, math.pi / 2, -math.pi / 2, -math.pi / 2)
