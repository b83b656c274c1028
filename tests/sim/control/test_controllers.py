"""Laws of ros_control's controllers, against analytic solutions."""

import pytest
from hypothesis import given, strategies as st

from trundle.sim.control import JointSegment, JointState, ToolboxPid

number = st.floats(-10.0, 10.0)


def test_an_integral_term_is_limited_by_its_clamp() -> None:
    pid = ToolboxPid(p=2.0, i=1.0, i_clamp=0.5)
    assert pid.command(1.0, 0.1) == pytest.approx(2.1)
    commands = [pid.command(1.0, 0.1) for _ in range(100)]
    assert commands[-1] == pytest.approx(2.5)
    assert pid.command(-1.0, 0.1) == pytest.approx(-1.5)  # the integral kept growing beyond its output limit

    pid = ToolboxPid(i=1.0, i_clamp=0.5, antiwindup=True)
    for _ in range(100):
        pid.command(1.0, 0.1)
    assert pid.command(-1.0, 0.1) == pytest.approx(0.4)


def test_the_derivative_term_uses_the_errors_slope() -> None:
    pid = ToolboxPid(d=3.0)
    assert pid.command(1.0, 0.5) == pytest.approx(6.0)
    assert pid.command(2.0, 0.5) == pytest.approx(6.0)
    assert pid.command(2.0, 0.5, slope=-1.0) == -3.0
    pid.reset()
    assert pid.command(0.0, 0.5) == 0.0
    assert pid.command(1.0, 0.0) == 0.0


def _segment(a: JointState, b: JointState, span_s: float, *, start_s: float = 1.0) -> JointSegment:
    start_ns = round(start_s * 1e9)
    return JointSegment.between(start_ns, a, start_ns + round(span_s * 1e9), b)


@given(st.tuples(number, number, number), st.tuples(number, number, number), st.floats(0.1, 10.0))
def test_a_quintic_segment_meets_both_end_states(
    a: tuple[float, float, float], b: tuple[float, float, float], span: float
) -> None:
    segment = _segment(JointState(*a), JointState(*b), span)
    assert segment.sample(segment.start_ns) == pytest.approx(a)
    assert segment.sample(segment.end_ns) == pytest.approx(b, rel=1e-4, abs=1e-3)


@given(number, number, number, number, st.floats(0.0, 1.0))
def test_velocities_are_the_derivatives_of_positions(p0: float, p1: float, v0: float, v1: float, at: float) -> None:
    segment = _segment(JointState(p0, v0), JointState(p1, v1), 2.0, start_s=0.0)
    t, h = round((0.1 + 1.8 * at) * 1e9), 10_000
    slope = (segment.sample(t + h)[0] - segment.sample(t - h)[0]) / (2e-9 * h)
    assert segment.sample(t)[1] == pytest.approx(slope, rel=1e-5, abs=1e-5)


@pytest.mark.parametrize("end", [JointState(3.0), JointState(3.0, None, 5.0)])
def test_a_segment_without_velocities_is_linear_and_constant_outside(end: JointState) -> None:
    segment = _segment(JointState(1.0, 4.0, 5.0), end, 2.0)
    assert segment.sample(1_500_000_000) == (1.5, 1.0, 0.0)
    assert segment.sample(0) == (1.0, 0.0, 0.0)
    assert segment.sample(9_000_000_000) == (3.0, 0.0, 0.0)


@pytest.mark.parametrize("state", [JointState(1.0), JointState(1.0, 2.0), JointState(1.0, 2.0, 3.0)])
def test_a_segment_without_length_stays_at_its_start(state: JointState) -> None:
    segment = _segment(state, JointState(7.0, 0.0, 0.0), 0.0)
    assert segment.sample(segment.start_ns) == (1.0, state.velocity or 0.0, state.acceleration or 0.0)
    assert segment.sample(segment.start_ns + 1) == (1.0, 0.0, 0.0)


def test_a_segment_does_not_end_before_its_start() -> None:
    with pytest.raises(ValueError, match="end_time < start_time"):
        _segment(JointState(1.0), JointState(2.0), -0.1)
