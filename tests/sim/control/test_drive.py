"""The differential drive against its own geometry."""

import math

import pytest

from trundle.sim.control import DifferentialDrive, WheelOdometry, step_towards

DRIVE = DifferentialDrive(wheel_radius=0.0635, separation=0.3048)


def test_driving_straight_turns_both_wheels_equally() -> None:
    assert DRIVE.wheel_speeds(0.635, 0.0) == pytest.approx((10.0, 10.0))


def test_turning_left_speeds_the_right_wheel_up() -> None:
    left, right = DRIVE.wheel_speeds(0.0, 1.0)

    assert right == -left
    assert right == pytest.approx(0.1524 / 0.0635)


def test_a_full_circle_ends_where_it_began() -> None:
    odometry = WheelOdometry(DRIVE)
    left, right = DRIVE.wheel_speeds(0.5, 0.5)
    steps = 10_000
    for _ in range(steps):
        odometry.update(left * 4 * math.pi / steps, right * 4 * math.pi / steps)

    assert (odometry.x, odometry.y) == pytest.approx((0.0, 0.0), abs=1e-6)
    assert odometry.yaw == pytest.approx(2 * math.pi)


def test_a_quarter_circle_to_the_left_has_its_radius() -> None:
    odometry = WheelOdometry(DRIVE)
    left, right = DRIVE.wheel_speeds(1.0, 1.0)
    for _ in range(1000):
        odometry.update(left * math.pi / 2000, right * math.pi / 2000)

    assert (odometry.x, odometry.y) == pytest.approx((1.0, 1.0), abs=1e-6)


@pytest.mark.parametrize(("value", "target", "expected"), [(0.0, 1.0, 0.1), (0.0, -1.0, -0.1), (0.0, 0.05, 0.05)])
def test_step_towards_is_limited_by_the_largest_step(value: float, target: float, expected: float) -> None:
    assert step_towards(value, target, 0.1) == pytest.approx(expected)
