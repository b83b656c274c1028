"""Composition and inverse of poses; roll, pitch and yaw."""

import math

import pytest
from hypothesis import given, strategies as st

from trundle.spatial import Pose, quaternion_from_rpy, rotate, rpy_from_quaternion

angle = st.floats(-math.pi, math.pi)
length = st.floats(-100, 100)
poses = st.builds(Pose.from_rpy, length, length, length, angle, angle, angle)
points = st.tuples(length, length, length)


@given(poses, poses, points)
def test_a_composed_pose_transforms_points_like_its_factors(a: Pose, b: Pose, p: tuple[float, float, float]) -> None:
    assert (a @ b).transform_point(p) == pytest.approx(a.transform_point(b.transform_point(p)), abs=1e-9)


@given(poses, points)
def test_the_inverse_restores_a_point(pose: Pose, p: tuple[float, float, float]) -> None:
    assert pose.inverse().transform_point(pose.transform_point(p)) == pytest.approx(p, abs=1e-9)


@given(angle, angle, angle)
def test_roll_pitch_yaw_converts_back_to_the_same_rotation(roll: float, pitch: float, yaw: float) -> None:
    """At the poles only the rotation is unique, not roll and yaw."""
    q = quaternion_from_rpy(roll, pitch, yaw)
    converted = quaternion_from_rpy(*rpy_from_quaternion(q))

    for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        assert rotate(converted, axis) == pytest.approx(rotate(q, axis), abs=1e-5)


def test_rotations_are_about_fixed_axes_x_then_y_then_z() -> None:
    """SDF's and URDF's convention: 90° of roll, then 90° of yaw rotate z to x."""
    pose = Pose.from_rpy(0, 0, 0, math.pi / 2, 0, math.pi / 2)

    assert pose.transform_vector((0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("off", [0.0, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("sign", [1, -1])
def test_roll_pitch_yaw_is_exact_near_the_pole(off: float, sign: int) -> None:
    """The formula with asin has errors up to 1e-6; URDF has no quaternions to avoid them."""
    q = quaternion_from_rpy(0.4, sign * (math.pi / 2 - off), 1.1)
    converted = quaternion_from_rpy(*rpy_from_quaternion(q))
    assert min(math.dist(q, converted), math.dist(q, [-v for v in converted])) < 1e-10
