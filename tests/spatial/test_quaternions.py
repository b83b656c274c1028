"""Interpolation and rotation by quaternions."""

import math

import pytest
from hypothesis import given, strategies as st

from trundle.spatial import (
    IDENTITY_QUATERNION,
    Quaternion,
    conjugate,
    dot,
    quaternion_from_axis_angle,
    quaternion_from_rpy,
    quaternion_product,
    rotate,
    slerp,
)
from trundle.spatial.quaternions import rotated_axes

_angle = st.floats(-math.pi, math.pi)
_quaternions = st.builds(quaternion_from_rpy, _angle, _angle, _angle)
_ratio = st.floats(0.0, 1.0)


def _angle_between(a: Quaternion, b: Quaternion) -> float:
    w, x, y, z = quaternion_product(conjugate(a), b)
    return 2 * math.atan2(math.hypot(x, y, z), abs(w))


@given(_quaternions, _quaternions, _ratio)
def test_the_angle_is_proportional_to_the_ratio(a: Quaternion, b: Quaternion, ratio: float) -> None:
    between = slerp(a, b, ratio)

    assert math.hypot(*between) == pytest.approx(1.0, abs=1e-9)
    assert _angle_between(a, between) == pytest.approx(ratio * _angle_between(a, b), abs=1e-6)


def test_a_quaternion_and_its_negative_are_the_same_rotation() -> None:
    turn = quaternion_from_axis_angle((0.0, 0.0, 1.0), 0.2)
    w, x, y, z = turn

    assert slerp(IDENTITY_QUATERNION, (-w, -x, -y, -z), 0.5) == pytest.approx(
        quaternion_from_axis_angle((0.0, 0.0, 1.0), 0.1)
    )


def test_interpolation_between_equal_rotations_is_exact() -> None:
    turn = quaternion_from_rpy(0.3, -0.2, 1.0)

    assert slerp(turn, turn, 0.7) == turn


def test_a_rotation_keeps_its_axis() -> None:
    axis = (2 / 3, -2 / 3, 1 / 3)
    rotated = rotate(quaternion_from_axis_angle(axis, 1.0), axis)

    assert rotated == pytest.approx(axis)
    perpendicular = rotate(quaternion_from_axis_angle((0.0, 0.0, 1.0), 0.4), (1.0, 0.0, 0.0))
    assert math.acos(dot(perpendicular, (1.0, 0.0, 0.0))) == pytest.approx(0.4)


@given(st.tuples(*[st.floats(-1, 1)] * 4))
def test_rotated_axes_are_bit_identical_to_rotated_vectors(q: Quaternion) -> None:
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    assert list(map(repr, rotated_axes(q))) == [repr(rotate(q, axis)) for axis in axes]
