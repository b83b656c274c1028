"""Robots of three kinds drive through the house, turn around in a lane, and park."""

import math
from typing import Any

import numpy as np
import pytest
from tests.navigation.house import house_cells
from tests.navigation.planners.elastic_bands.closed_loop import drive

from trundle.navigation.costmap.footprint import circle
from trundle.navigation.planners.elastic_bands import EBandPlannerROS, TebLocalPlannerROS

_START, _GOAL = (0.6, 1.0, 0.0), (5.0, 1.0, math.pi / 2)
"""In two rooms; the way leads around a pillar and through a door of 1 m."""
_ROUND = circle(0.2)
_TEB = {
    "footprint_model": {"type": "circular", "radius": 0.2},
    "min_obstacle_dist": 0.15,
    "inflation_dist": 0.35,
    "max_vel_theta": 1.0,
}
_CAR = np.array([[0.35, 0.18], [-0.25, 0.18], [-0.25, -0.18], [0.35, -0.18]])
_CAR_TEB = {
    "footprint_model": {"type": "polygon", "vertices": _CAR.tolist()},
    "min_obstacle_dist": 0.1,
    "inflation_dist": 0.25,
    "max_vel_theta": 1.0,
    "min_turning_radius": 0.5,
    "max_vel_x_backwards": 0.3,
    "penalty_epsilon": 0.05,
    "xy_goal_tolerance": 0.12,
    "yaw_goal_tolerance": 0.15,
}


def _lane() -> np.ndarray:
    """Return 8 m × 3 m with two parked cars beside the southern wall, 1.4 m apart."""
    cells = np.zeros((60, 160), np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[2:14, 40:64] = cells[2:14, 92:116] = 100
    return cells


@pytest.mark.parametrize(
    ("kind", "own", "limits"),
    [
        ("differential", {}, (0.4, 0.0, 1.0)),
        ("holonomic", {"max_vel_y": 0.3}, (0.4, 0.3, 1.0)),
        ("car", {"min_turning_radius": 0.4}, (0.4, 0.0, 1.0)),
    ],
)
def test_teb_drives_robots_of_three_kinds_through_a_door(
    kind: str, own: dict[str, Any], limits: tuple[float, float, float]
) -> None:
    driven = drive(TebLocalPlannerROS, house_cells(), _ROUND, {**_TEB, **own}, _START, _GOAL)

    assert driven.is_reached
    assert driven.is_free
    assert np.hypot(*(driven.poses[-1, :2] - _GOAL[:2])) < 0.2
    assert (np.abs(driven.velocities).max(axis=0) <= np.array(limits) + 1e-9).all()
    if kind == "car":
        assert driven.tightest_m >= 0.4 - 1e-9
    elif kind == "holonomic":
        assert np.abs(driven.velocities[:, 1]).max() > 0.1


def test_a_car_parks_between_two_others() -> None:
    driven = drive(TebLocalPlannerROS, _lane(), _CAR, _CAR_TEB, (1.2, 1.5, 0.0), (3.85, 0.5, 0.0))

    assert driven.is_reached
    assert driven.is_free
    assert driven.tightest_m >= 0.5 - 1e-9


def test_a_car_turns_around_by_driving_backwards() -> None:
    driven = drive(TebLocalPlannerROS, _lane(), _CAR, _CAR_TEB, (1.2, 1.5, 0.0), (6.8, 1.5, math.pi))

    assert driven.is_reached
    assert driven.is_free
    assert driven.tightest_m >= 0.5 - 1e-9
    assert driven.velocities[:, 0].min() < -0.05


def test_a_steering_angle_replaces_the_turning_speed() -> None:
    """Of a bicycle: tan(angle) = wheelbase / radius."""
    own = {**_CAR_TEB, "cmd_angle_instead_rotvel": True, "wheelbase": 0.4}
    angles = drive(TebLocalPlannerROS, _lane(), _CAR, own, (1.2, 1.5, 0.0), (3.85, 0.5, 0.0), limit_s=3.0)

    assert np.abs(angles.velocities[:, 2]).max() <= math.atan(0.4 / 0.5) + 1e-9
    assert np.abs(angles.velocities[:, 2]).max() > 0.05


@pytest.mark.parametrize(
    ("planner", "name", "without_effect"),
    [
        (TebLocalPlannerROS, "teb_local_planner", "oscillation_recovery"),
        (EBandPlannerROS, "eband_local_planner", "k_damp"),
    ],
)
def test_parameters_that_a_planner_does_not_have_are_named(
    planner: type[Any], name: str, without_effect: str, caplog: pytest.LogCaptureFixture
) -> None:
    own = {"xy_goal_tolerance": 0.1, "max_vel_xx": 1.0, without_effect: 1.0, "odom_topic": "odom"}
    drive(planner, house_cells(), _ROUND, own, _START, _GOAL, limit_s=0.1)

    warnings = [record.getMessage() for record in caplog.records]
    assert f"/move_base/Planner: {name} has no parameters max_vel_xx" in warnings
    assert f"/move_base/Planner: parameters without effect: {without_effect}" in warnings


@pytest.mark.parametrize("is_differential", [True, False])
def test_an_elastic_band_leads_through_a_door(is_differential: bool) -> None:
    own = {"differential_drive": is_differential}
    driven = drive(EBandPlannerROS, house_cells(), _ROUND, own, _START, _GOAL)

    assert driven.is_reached
    assert driven.is_free
    assert np.hypot(*(driven.poses[-1, :2] - _GOAL[:2])) < 0.1
    assert np.abs(driven.velocities[:, 0]).max() <= 0.75 + 1e-9
    assert (np.abs(driven.velocities[:, 1]).max() > 0.05) is not is_differential
