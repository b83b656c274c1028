"""Poses are a group; roll, pitch and yaw name its rotations."""

import math

import pytest
from hypothesis import given, strategies as st

from trundle.spatial import Pose, quaternion_from_rpy, rotate, rpy_from_quaternion

angle = st.floats(-math.pi, math.pi)
length = st.floats(-100, 100)
poses = st.builds(Pose.from_rpy, length, length, length, angle, angle, angle)
points = st.tuples(length, length, length)


@given(poses, poses, points)
def test_composing_is_applying_one_after_the_other(a: Pose, b: Pose, p: tuple[float, float, float]) -> None:
    assert (a @ b).transform_point(p) == pytest.approx(a.transform_point(b.transform_point(p)), abs=1e-9)


@given(poses, points)
def test_the_inverse_takes_a_point_back(pose: Pose, p: tuple[float, float, float]) -> None:
    assert pose.inverse().transform_point(pose.transform_point(p)) == pytest.approx(p, abs=1e-9)


@given(angle, angle, angle)
def test_roll_pitch_yaw_and_back_is_the_same_rotation(roll: float, pitch: float, yaw: float) -> None:
    """At the poles roll and yaw are not unique; the rotation is."""
    q = quaternion_from_rpy(roll, pitch, yaw)
    again = quaternion_from_rpy(*rpy_from_quaternion(q))

    for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        assert rotate(again, axis) == pytest.approx(rotate(q, axis), abs=1e-5)


def test_rotations_are_about_fixed_axes_x_then_y_then_z() -> None:
    """SDF's and URDF's convention: a quarter of roll, then a quarter of yaw, takes z to x."""
    pose = Pose.from_rpy(0, 0, 0, math.pi / 2, 0, math.pi / 2)

    assert pose.transform_vector((0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("off", [0.0, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("sign", [1, -1])
def test_close_to_the_pole_no_digits_are_lost(off: float, sign: int) -> None:
    """The formula with asin is off by up to 1e-6 there: URDF, which has no quaternions, cannot afford it."""
    q = quaternion_from_rpy(0.4, sign * (math.pi / 2 - off), 1.1)
    again = quaternion_from_rpy(*rpy_from_quaternion(q))
    assert min(math.dist(q, again), math.dist(q, [-v for v in again])) < 1e-10
