"""Mecanum wheels against the motion of a roller's contact point."""

import math

import pytest
from hypothesis import given, strategies as st

from trundle.sim.control import MecanumDrive

LAW = MecanumDrive(radius=0.1, reach=0.3 + 0.2)
_CORNERS = ((0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2))
"""Front left, front right, rear left, rear right [m]."""
_SPEED = st.floats(-2.0, 2.0)


@given(_SPEED, _SPEED, _SPEED)
def test_wheel_speeds_determine_the_twist(forward: float, left: float, turning: float) -> None:
    twist = LAW.twist(LAW.wheel_speeds(forward, left, turning))
    assert twist == pytest.approx((forward, left, turning), abs=1e-9)


@given(_SPEED, _SPEED, _SPEED)
def test_contact_points_do_not_slip_along_their_rollers_axes(forward: float, left: float, turning: float) -> None:
    """A roller rolls freely across its axis, which points 45 degrees inwards at the ground; along it nothing slips."""
    for (x, y), speed in zip(_CORNERS, LAW.wheel_speeds(forward, left, turning), strict=True):
        over_ground = (forward - turning * y - speed * LAW.radius, left + turning * x)
        axis = (math.sqrt(0.5), -math.copysign(math.sqrt(0.5), x * y))
        assert over_ground[0] * axis[0] + over_ground[1] * axis[1] == pytest.approx(0.0, abs=1e-9)
