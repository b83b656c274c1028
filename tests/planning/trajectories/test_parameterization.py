"""Times along paths keep every limit, and are as short as they may be."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from tests.planning.scenes import seven_axis

from trundle.base.diagnostics import UsageError
from trundle.planning.trajectories import Method, MotionLimits, find_method, motion_limits, parameterize


def _limits(velocity: float, acceleration: float, n: int) -> MotionLimits:
    return MotionLimits(np.full(n, velocity), np.full(n, acceleration))


@st.composite
def _problems(draw: st.DrawFn) -> tuple[NDArray[np.float64], MotionLimits]:
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n, count = draw(st.integers(1, 7)), draw(st.integers(2, 12))
    waypoints = rng.uniform(-2.0, 2.0, (count, n)) * rng.choice([0.001, 0.1, 1.0], (count, n))
    if draw(st.booleans()) and count > 3:
        waypoints[2] = waypoints[1]  # twice the same
        waypoints[-1] = waypoints[-3]  # straight back
    return waypoints, MotionLimits(rng.uniform(0.3, 3.0, n), rng.uniform(0.3, 6.0, n))


@pytest.mark.parametrize("method", ["time_optimal", "iterative_parabolic"])
@settings(max_examples=60, deadline=None)
@given(problem=_problems(), scaling=st.sampled_from([1.0, 0.5, 0.1]))
def test_every_limit_is_kept(method: Method, problem: tuple[NDArray[np.float64], MotionLimits], scaling: float) -> None:
    waypoints, limits = problem

    trajectory = parameterize(
        waypoints, limits, velocity_scaling=scaling, acceleration_scaling=scaling, method=method, resample_dt=0.01
    )

    assert (np.diff(trajectory.times) > 0).all()
    assert trajectory.positions[0] == pytest.approx(waypoints[0])
    assert trajectory.positions[-1] == pytest.approx(waypoints[-1], abs=1e-6)
    assert not trajectory.velocities[[0, -1]].any()
    assert (np.abs(trajectory.velocities) <= scaling * limits.velocity * (1 + 1e-6)).all()
    assert (np.abs(trajectory.accelerations) <= scaling * limits.acceleration * (1 + 1e-6)).all()
    if len(trajectory.times) > 1:  # the positions move as fast as the velocities say
        speeds = np.abs(np.diff(trajectory.positions, axis=0) / np.diff(trajectory.times)[:, None])
        assert (speeds <= scaling * limits.velocity * (1 + 1e-6)).all()
    if method == "time_optimal" and len(trajectory.times) > 3:
        steps = np.diff(trajectory.times[:-1])[:, None]
        accelerations = np.abs(np.diff(trajectory.velocities[:-1], axis=0) / steps)
        assert (accelerations <= scaling * limits.acceleration * (1 + 1e-3) + 1e-6).all()


def test_a_straight_line_takes_the_time_of_a_trapezoid() -> None:
    """1 rad at 0.5 rad/s and 1 rad/s²: 0.5 s up, 1.5 s along, 0.5 s down; a short one only up and down."""
    long = parameterize(np.array([[0.0], [1.0]]), _limits(0.5, 1.0, 1), resample_dt=0.01)
    short = parameterize(np.array([[0.0], [0.1]]), _limits(0.5, 1.0, 1), resample_dt=0.01)

    assert long.duration == pytest.approx(2.5, rel=0.01)
    assert short.duration == pytest.approx(2 * np.sqrt(0.1), rel=0.01)
    assert np.abs(long.velocities).max() == pytest.approx(0.5, rel=1e-3)


def test_corners_are_rounded_within_the_tolerance() -> None:
    corner = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])

    def durations(tolerance: float) -> tuple[float, float]:
        trajectory = parameterize(corner, _limits(1.0, 1.0, 2), path_tolerance=tolerance, resample_dt=0.01)
        return trajectory.duration, float(np.linalg.norm(trajectory.positions - corner[1], axis=1).min())

    (wide, far), (narrow, near), (none, zero) = durations(0.1), durations(0.01), durations(0.0)
    assert far == pytest.approx(0.1, abs=2e-3)
    assert near == pytest.approx(0.01, abs=2e-3)
    assert zero == pytest.approx(0.0, abs=1e-3)
    assert wide < narrow < none


def test_the_iterative_one_keeps_the_waypoints() -> None:
    waypoints = np.array([[0.0, 0.0], [0.3, 0.1], [0.5, 0.4], [0.1, 0.6]])

    trajectory = parameterize(waypoints, _limits(1.0, 2.0, 2), method="iterative_parabolic")

    assert np.array_equal(trajectory.positions, waypoints)


def test_half_the_velocity_takes_twice_the_time() -> None:
    waypoints = np.array([[0.0], [10.0]])
    limits = _limits(1.0, 100.0, 1)
    full, half = (parameterize(waypoints, limits, velocity_scaling=factor).duration for factor in (1.0, 0.5))

    assert half == pytest.approx(2 * full, rel=0.01)


def test_angles_that_turn_without_end_go_the_short_way() -> None:
    waypoints = np.array([[3.0], [-3.0]])
    trajectory = parameterize(waypoints, _limits(1.0, 1.0, 1), turns=np.array([True]))

    assert trajectory.positions[-1][0] == pytest.approx(2 * np.pi - 3.0)


@pytest.mark.parametrize("waypoints", [np.zeros((0, 2)), np.zeros((1, 2)), np.zeros((3, 2))])
def test_a_path_that_goes_nowhere_takes_no_time(waypoints: NDArray[np.float64]) -> None:
    assert parameterize(waypoints, _limits(1.0, 1.0, 2)).duration == 0.0


@pytest.mark.parametrize(
    ("waypoints", "velocity", "options", "message"),
    [
        ([[np.nan], [1.0]], 1.0, {}, "finite numbers"),
        ([[0.0], [1.0]], 0.0, {}, "a limit of velocity above zero"),
        ([[0.0], [1.0]], 1.0, {"resample_dt": 0.0}, "a time step at least 0.1 ms"),
    ],
)
def test_what_has_no_times_is_refused(
    waypoints: list[list[float]], velocity: float, options: dict[str, Any], message: str
) -> None:
    with pytest.raises(UsageError, match=message):
        parameterize(np.array(waypoints), _limits(velocity, 1.0, 1), **options)


def test_limits_of_a_model_are_those_of_its_files_or_one() -> None:
    limits = motion_limits(seven_axis(), seven_axis().group("arm").variables)

    assert limits.velocity[0] == 2.0
    assert limits.acceleration.tolist() == [1.0] * 7


@pytest.mark.parametrize(
    ("name", "method", "note"),
    [
        ("default_planner_request_adapters/AddTimeOptimalParameterization", "time_optimal", ""),
        ("default_planner_request_adapters/AddTimeParameterization", "iterative_parabolic", ""),
        ("iterative_time_parameterization", "iterative_parabolic", ""),
        ("time_optimal_trajectory_generation", "time_optimal", ""),
        ("default_planner_request_adapters/AddIterativeSplineParameterization", "iterative_parabolic", "there is no"),
        ("magic", "time_optimal", "no time parameterization 'magic'"),
    ],
)
def test_methods_by_the_names_of_moveit(name: str, method: str, note: str) -> None:
    found, sentence = find_method(name)

    assert found == method
    assert note in sentence if note else sentence == ""
