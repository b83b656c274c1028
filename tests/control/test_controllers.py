"""Laws of ros_control's controllers, against analytic solutions."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from trundle.control import JointPoint, JointSpline, ToolboxPid

number = st.floats(-10.0, 10.0)


def test_an_integral_contributes_no_more_than_its_clamp() -> None:
    pid = ToolboxPid(p=2.0, i=1.0, i_clamp=0.5)
    assert pid.command(1.0, 0.1) == pytest.approx(2.1)
    for _ in range(100):
        last = pid.command(1.0, 0.1)
    assert last == pytest.approx(2.5)
    assert pid.command(-1.0, 0.1) == pytest.approx(-1.5)  # the integral grew on, beyond its output limit

    pid = ToolboxPid(i=1.0, i_clamp=0.5, antiwindup=True)
    for _ in range(100):
        pid.command(1.0, 0.1)
    assert pid.command(-1.0, 0.1) == pytest.approx(0.4)


def test_a_slope_is_that_of_the_error() -> None:
    pid = ToolboxPid(d=3.0)
    assert pid.command(1.0, 0.5) == pytest.approx(6.0)
    assert pid.command(2.0, 0.5) == pytest.approx(6.0)
    assert pid.command(2.0, 0.5, slope=-1.0) == -3.0
    pid.reset()
    assert pid.command(0.0, 0.5) == 0.0
    assert pid.command(1.0, 0.0) == 0.0


@given(st.tuples(number, number, number), st.tuples(number, number, number), st.floats(0.1, 10.0))
def test_a_quintic_meets_both_ends(a: tuple[float, float, float], b: tuple[float, float, float], span: float) -> None:
    spline = JointSpline([JointPoint(1.0, *a), JointPoint(1.0 + span, *b)])
    assert spline.sample(1.0) == pytest.approx(a)
    end = spline.sample(1.0 + span * (1.0 - 1e-9))
    assert end == pytest.approx(b, rel=1e-4, abs=1e-3)


@given(number, number, number, number, st.floats(0.0, 1.0))
def test_speeds_are_the_slope_of_positions(p0: float, p1: float, v0: float, v1: float, at: float) -> None:
    spline = JointSpline([JointPoint(0.0, p0, v0), JointPoint(2.0, p1, v1)])
    t, h = 0.1 + 1.8 * at, 1e-5
    slope = (spline.sample(t + h)[0] - spline.sample(t - h)[0]) / (2 * h)
    assert spline.sample(t)[1] == pytest.approx(slope, rel=1e-5, abs=1e-5)


def test_without_speeds_it_goes_straight_and_outside_it_stays() -> None:
    spline = JointSpline([JointPoint(0.0, 1.0), JointPoint(2.0, 3.0), JointPoint(3.0, 0.0)])
    assert spline.sample(0.5) == (1.5, 1.0, 0.0)
    assert spline.sample(2.5) == (1.5, -3.0, 0.0)
    assert spline.sample(-1.0) == (1.0, 0.0, 0.0)
    assert spline.sample(9.0) == (0.0, 0.0, 0.0)
    assert spline.end_s == 3.0
