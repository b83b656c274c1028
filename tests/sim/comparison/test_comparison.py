"""Differences of a run from a reference."""

import math

import numpy as np
import pytest

from trundle.sim.comparison import Comparison, Trajectory, velocities
from trundle.sim.simulation import StateLog
from trundle.spatial import quaternion_from_rpy

TIMES = np.arange(0.0, 2.01, 0.02)


def log(times: np.ndarray = TIMES, *, x: float = 0.0, yaw: float = 0.0, hinge: float = 0.0) -> StateLog:
    """A box that drives along x at 1 m/s from x, turned by yaw, on a floor; its hinge turns at 1 rad/s."""
    poses = np.zeros((len(times), 3, 7))
    poses[..., 3] = 1.0
    poses[:, 1, 0] = x + times - times[0]
    poses[:, 1, 3:] = quaternion_from_rpy(0.0, 0.0, yaw)
    poses[:, 2] = poses[:, 1] + [0, 0, 1, 0, 0, 0, 0]
    return StateLog(
        links=("floor::link", "box::base", "box::mast"),
        joints=("box::hinge",),
        sdf="",
        times_s=times,
        poses=poses,
        positions=(hinge + times - times[0])[:, None],
    )


def compared(run: StateLog, reference: StateLog, *, offset: float = 0.0) -> Comparison:
    one = Trajectory.of_log(run)
    comparison = Comparison(Trajectory.of_log(reference), start=one.start)
    comparison.offset = offset
    comparison.add_run(one)
    return comparison


def values(comparison: Comparison, time: float) -> dict[tuple[str, str], tuple[float | None, ...]]:
    return {
        (row.name, row.quantity): (row.now, row.maximum, row.maximum_time, row.rms)
        for row in comparison.differences(time)
    }


def test_a_known_offset_is_found_in_each_quantity() -> None:
    found = values(compared(log(x=3.0, yaw=0.4, hinge=-0.5), log()), 1.0)

    assert found["box", "distance"] == pytest.approx((3.0, 3.0, 0.0, 3.0))
    assert found["box", "angle"] == pytest.approx((0.4, 0.4, 0.0, 0.4))
    assert found["box::hinge", "position"] == pytest.approx((0.5, 0.5, 0.0, 0.5))
    assert found["floor", "distance"] == (0.0, 0.0, 0.0, 0.0)


def test_the_starts_coincide_and_times_between_samples_are_interpolated() -> None:
    """The reference was recorded from 7 s on, a third as often."""
    reference = log(np.arange(7.0, 9.01, 0.06))

    found = values(compared(log(), reference), 2.0)

    assert found["box", "distance"][1] == pytest.approx(0.0, abs=1e-9)


def test_an_offset_delays_the_reference() -> None:
    """Half a second later, a reference at 1 m/s is 0.5 m behind; before its start there is nothing to compare."""
    comparison = compared(log(), log(), offset=0.5)

    assert values(comparison, 0.4)["box", "distance"] == (None, None, None, None)
    assert values(comparison, 2.0)["box", "distance"] == pytest.approx((0.5, 0.5, 0.5, 0.5))


def test_after_the_end_of_the_reference_nothing_is_compared() -> None:
    found = values(compared(log(x=1.0), log(TIMES[:51])), 2.0)

    now, maximum, _, rms = found["box", "distance"]
    assert now is None
    assert (maximum, rms) == pytest.approx((1.0, 1.0))


def test_maximum_and_rms_cover_the_samples_so_far() -> None:
    """A run at rest is left behind at 1 m/s: RMS of 0 … t is t/√3 for many samples."""
    run = log()
    run.poses[:, :, 0] = 0.0
    comparison = compared(run, log())

    for time in (2.0, 1.0, 1.5):  # back, and forward again
        now, maximum, at, rms = values(comparison, time)["box", "distance"]
        assert (now, maximum, at) == pytest.approx((time, time, time))
        assert rms == pytest.approx(time / math.sqrt(3), rel=0.02)


def test_samples_are_replaced_when_the_run_goes_on_from_an_earlier_time() -> None:
    comparison = compared(log(x=5.0), log())
    poses, positions = Trajectory.of_log(log(x=0.0)).at(TIMES)
    assert values(comparison, 2.0)["box", "distance"][1] == pytest.approx(5.0)

    for at in range(25, 51):
        comparison.add(TIMES[at], comparison.row(poses[at], positions[at]))

    assert values(comparison, 1.0)["box", "distance"][:3] == pytest.approx((0.0, 5.0, 0.0))
    assert values(comparison, 1.0)["box", "distance"][3] == pytest.approx(5.0 * math.sqrt(25 / 51))


def test_a_model_that_is_missing_has_no_difference() -> None:
    comparison = compared(log(), log())
    row = comparison.row(np.full((2, 7), np.nan), np.zeros(1))

    found = {(one.name, one.quantity): one.now for one in comparison.differences(1.0, row)}

    assert found["box", "distance"] is None
    assert found["box", "angle"] is None
    assert found["box::hinge", "position"] == pytest.approx(1.0)


def test_velocities_of_recorded_runs_are_compared() -> None:
    """The run drives along x at 1 m/s, the reference along y at 2 m/s while it turns about z at 0.5 rad/s."""
    reference = log()
    reference.poses[:, 1, 0] = 0.0
    reference.poses[:, 1, 1] = 2.0 * TIMES
    reference.poses[:, 1, 3:] = [quaternion_from_rpy(0.0, 0.0, 0.5 * time) for time in TIMES]
    one = Trajectory.of_log(log())
    comparison = Comparison(Trajectory.of_log(reference), start=one.start, has_velocities=True)
    comparison.add_run(one)

    found = values(comparison, 1.01)

    for quantity, expected in (("velocity", math.sqrt(5)), ("angular velocity", 0.5)):
        now, maximum, _, rms = found["box", quantity]
        assert (now, maximum, rms) == pytest.approx((expected, expected, expected))
    assert found["box", "distance"][0] == pytest.approx(math.sqrt(5))
    assert found["floor", "velocity"] == (0.0, 0.0, 0.0, 0.0)


def test_velocities_of_a_run_that_goes_on_are_compared() -> None:
    """The run's are measured, the reference's are differences of its poses: here 1 m/s along x."""
    comparison = Comparison(Trajectory.of_log(log()), start=10.0, has_velocities=True)
    twists = np.zeros((2, 6))
    twists[1] = [1.0, 0.5, 0.0, 0.0, 0.0, 0.25]

    row = comparison.row(np.full((2, 7), np.nan), np.zeros(1), twists)
    found = {(one.name, one.quantity): one.now for one in comparison.differences(11.0, row)}

    assert found["box", "velocity"] == pytest.approx(0.5)
    assert found["box", "angular velocity"] == pytest.approx(0.25)


def test_velocities_are_those_of_uniform_acceleration() -> None:
    """Differences of both neighbors are exact for it, but for the ends; one sample is at rest."""
    poses = np.zeros((len(TIMES), 1, 7))
    poses[:, 0, 2] = -0.5 * 9.8 * TIMES**2
    poses[:, 0, 3:] = [quaternion_from_rpy(-3.0 * time, 0.0, 0.0) for time in TIMES]
    poses[50:, 0, 3:] *= -1.0  # the same orientation

    found = velocities(TIMES, poses)

    assert found[1:-1, 0, 2] == pytest.approx(-9.8 * TIMES[1:-1])
    assert found[:, 0, 3] == pytest.approx(-3.0)
    assert velocities(TIMES[:1], poses[:1]).tolist() == [[[0.0] * 6]]


def test_small_angles_are_exact() -> None:
    found = values(compared(log(yaw=1e-9), log()), 1.0)

    assert found["box", "angle"][0] == pytest.approx(1e-9, rel=1e-6)


def test_rows_before_a_reset_do_not_count() -> None:
    times = np.concatenate([TIMES[:30], TIMES])
    run = log(times)
    run.poses[:30, :, 0] = 99.0

    found = values(compared(run, log()), 2.0)

    assert found["box", "distance"][1] == pytest.approx(0.0, abs=1e-9)
