"""Filters of imus against motions whose orientation is known."""

import math
import random
from collections.abc import Iterator

import pytest

from trundle.gazebo.nodes.imu_filters.complementary import ComplementaryFilter
from trundle.gazebo.nodes.imu_filters.madgwick import MadgwickFilter
from trundle.gazebo.nodes.imu_filters.orientation import orientation_from_field, orientation_from_gravity
from trundle.spatial import (
    IDENTITY_QUATERNION,
    Quaternion,
    Vector3,
    conjugate,
    quaternion_from_axis_angle,
    quaternion_from_rpy,
    quaternion_product,
    rotate,
    rpy_from_quaternion,
)

DT = 0.01
FIELDS: dict[str, Vector3] = {"enu": (0.0, 2e-5, -4e-5), "nwu": (2e-5, 0.0, -4e-5), "ned": (2e-5, 0.0, 4e-5)}
"""The magnetic field of middle Europe in each world frame [T]."""
UP: dict[str, Vector3] = {"enu": (0.0, 0.0, 9.81), "nwu": (0.0, 0.0, 9.81), "ned": (0.0, 0.0, -9.81)}


def angle_between(a: Quaternion, b: Quaternion) -> float:
    """Return the angle from one orientation to another [°]."""
    w, x, y, z = quaternion_product(conjugate(a), b)
    return math.degrees(2.0 * math.atan2(math.hypot(x, y, z), abs(w)))


def rocking(
    frame: str, seconds: float, *, noise: float = 0.0
) -> Iterator[tuple[Quaternion, Vector3, Vector3, Vector3]]:
    """An imu that turns about a swinging axis: world_from_imu, angular velocity, acceleration, field."""
    generator = random.Random(1)
    world_from_imu = quaternion_from_rpy(0.2, -0.3, 1.0)

    def measured(vector: Vector3, size: float) -> Vector3:
        x, y, z = (value + generator.gauss(0.0, noise * size) for value in vector)
        return (x, y, z)

    for step in range(round(seconds / DT)):
        time = step * DT
        turn = (0.5 * math.sin(time), 0.4 * math.cos(1.3 * time), 0.6 * math.sin(0.7 * time))
        rate = math.hypot(*turn)
        axis = (turn[0] / rate, turn[1] / rate, turn[2] / rate)
        world_from_imu = quaternion_product(world_from_imu, quaternion_from_axis_angle(axis, rate * DT))
        imu_from_world = conjugate(world_from_imu)
        yield (
            world_from_imu,
            measured(turn, 0.05),
            measured(rotate(imu_from_world, UP[frame]), 0.2),
            measured(rotate(imu_from_world, FIELDS[frame]), 1e-6),
        )


@pytest.mark.parametrize(("frame", "yaw"), [("enu", 0.0), ("ned", 90.0), ("nwu", -90.0)])
def test_an_imu_that_looks_east_has_the_heading_of_its_world_frame(frame: str, yaw: float) -> None:
    """It lies flat, its z axis up in enu and nwu, down in ned; north is to its left or right."""
    north = {"enu": (0.0, 2e-5, -4e-5), "nwu": (0.0, 2e-5, -4e-5), "ned": (0.0, -2e-5, 4e-5)}[frame]
    orientation = orientation_from_field(UP[frame], north, frame)
    assert orientation is not None
    roll, pitch, heading = map(math.degrees, rpy_from_quaternion(orientation))
    assert (roll, pitch, heading) == pytest.approx((0.0, 0.0, yaw), abs=1e-6)


def test_without_a_field_a_flat_imu_looks_along_x_and_a_tilted_one_keeps_its_tilt() -> None:
    assert orientation_from_gravity((0.0, 0.0, 9.81), "enu") == pytest.approx((1.0, 0.0, 0.0, 0.0))
    tilted = rotate(conjugate(quaternion_from_rpy(0.3, -0.2, 0.0)), UP["enu"])
    orientation = orientation_from_gravity(tilted, "enu")
    assert orientation is not None
    assert rpy_from_quaternion(orientation)[:2] == pytest.approx((0.3, -0.2))
    assert orientation_from_gravity((0.0, 0.0, 0.05), "enu") is None
    assert orientation_from_field((0.0, 0.0, 9.81), (0.0, 0.0, 4e-5), "enu") is None


@pytest.mark.parametrize("frame", ["enu", "ned", "nwu"])
def test_madgwick_follows_a_rocking_imu_and_finds_it_from_a_wrong_start(frame: str) -> None:
    estimate = MadgwickFilter(frame, gain=0.2, drift_gain=0.0)
    errors: list[float] = []
    for true, turn, acceleration, field in rocking(frame, 40.0, noise=1.0):
        estimate.update(turn, acceleration, field, DT)
        errors.append(angle_between(true, estimate.orientation))
    assert errors[0] > 40.0
    assert max(errors[2000:]) < 2.0


def test_madgwick_without_a_field_keeps_gravity() -> None:
    estimate = MadgwickFilter("enu", gain=0.1, drift_gain=0.0)
    true = IDENTITY_QUATERNION
    for true, turn, acceleration, _ in rocking("enu", 20.0):  # noqa: B007
        estimate.update(turn, acceleration, None, DT)
    up = rotate(conjugate(estimate.orientation), UP["enu"])
    assert up == pytest.approx(rotate(conjugate(true), UP["enu"]), abs=0.1)


def test_madgwick_learns_the_drift_of_the_angular_velocity() -> None:
    """A drift of 0.05 rad/s about z, with a gain that corrects up to twice 0.02 rad/s."""
    errors: dict[float, float] = {}
    for zeta in (0.0, 0.01):
        estimate, true = MadgwickFilter("enu", gain=0.02, drift_gain=zeta), IDENTITY_QUATERNION
        for true, turn, acceleration, field in rocking("enu", 60.0):  # noqa: B007
            estimate.update((turn[0], turn[1], turn[2] + 0.05), acceleration, field, DT)
        errors[zeta] = angle_between(true, estimate.orientation)
    assert errors[0.0] > 20.0
    assert errors[0.01] < 5.0


def complementary(**more: float) -> ComplementaryFilter:
    gains = {"gain_acc": 0.02, "gain_mag": 0.02, "bias_alpha": 0.01, **more}
    return ComplementaryFilter(**gains, does_estimate_bias=True, is_adaptive=True)


def test_the_complementary_filter_follows_a_rocking_imu() -> None:
    estimate = complementary()
    errors: list[float] = []
    for true, turn, acceleration, field in rocking("nwu", 20.0, noise=1.0):
        estimate.update(turn, acceleration, field, DT)
        assert estimate.orientation is not None
        errors.append(angle_between(true, estimate.orientation))
    assert max(errors[500:]) < 3.0


def test_the_complementary_filter_learns_the_bias_at_rest_only() -> None:
    estimate = complementary()
    for _ in range(1000):
        estimate.update((0.0, 0.0, 0.05), (0.0, 0.0, 9.81), None, DT)
    assert estimate.is_steady
    assert estimate.bias == pytest.approx((0.0, 0.0, 0.05), abs=1e-3)
    for _ in range(1000):
        estimate.update((0.0, 0.0, 0.5), (0.0, 0.0, 9.81), None, DT)
    assert not estimate.is_steady
    assert estimate.bias == pytest.approx((0.0, 0.0, 0.05), abs=1e-3)


def test_a_hard_push_does_not_tilt_an_adaptive_filter() -> None:
    """3 m/s² along x for a second make the acceleration 5 % longer than gravity; 8 m/s², 29 %."""
    tilts: list[float] = []
    for push in (3.0, 8.0):
        estimate = complementary()
        for _ in range(100):
            estimate.update((0.0, 0.0, 0.0), (0.0, 0.0, 9.81), None, DT)
        for _ in range(100):
            estimate.update((0.0, 0.0, 0.0), (push, 0.0, 9.81), None, DT)
        assert estimate.orientation is not None
        tilts.append(abs(math.degrees(rpy_from_quaternion(estimate.orientation)[1])))
    assert tilts[0] > 5.0
    assert tilts[1] < 0.1
