"""Planners by their plugins' names, and those that stand in for planners of other packages."""

import logging
from types import SimpleNamespace
from typing import Any

import pytest

from trundle.navigation.planners import find_global_planner, find_local_planner
from trundle.navigation.planners.dwa_planner import DWAPlannerROS, DwaSettings
from trundle.navigation.planners.navfn import NavfnROS
from trundle.navigation.planners.trajectory_planner import TrajectoryPlannerROS
from trundle.navigation.settings import read_settings
from trundle.robots.parameters import ParamError, RosParameters

_NODE: Any = SimpleNamespace(log=SimpleNamespace(warn=logging.getLogger("planners").warning))


def _found(name: str, **sections: Any) -> tuple[Any, str, DwaSettings]:
    kind, space, section = find_local_planner(_NODE, name, RosParameters(sections, "/move_base"))
    return kind, space, read_settings(DwaSettings, section)


def test_planners_are_found_with_and_without_their_package() -> None:
    root = RosParameters({"NavfnROS": {"default_tolerance": 0.5}}, "/move_base")
    kind, space, section = find_global_planner(_NODE, "NavfnROS", root)
    assert (kind, space, section.number("default_tolerance")) == (NavfnROS, "NavfnROS", 0.5)
    name = "base_local_planner/TrajectoryPlannerROS"
    assert find_local_planner(_NODE, name, root)[:2] == (TrajectoryPlannerROS, "TrajectoryPlannerROS")


def test_unknown_planners_are_refused_with_those_that_exist() -> None:
    empty = RosParameters({}, "/move_base")
    with pytest.raises(
        ParamError, match=r"no local planner 'mine/Own'; there are: .*DWAPlannerROS.*TebLocalPlannerROS"
    ):
        find_local_planner(_NODE, "mine/Own", empty)
    with pytest.raises(ParamError, match=r"no global planner 'mine/Own'; there are: .*NavfnROS"):
        find_global_planner(_NODE, "mine/Own", empty)


def test_teb_is_answered_by_dwa_with_its_limits(caplog: pytest.LogCaptureFixture) -> None:
    teb = {"max_vel_x": 0.8, "max_vel_x_backwards": 0.2, "acc_lim_theta": 2.0, "yaw_goal_tolerance": 0.08}
    kind, space, settings = _found("teb_local_planner/TebLocalPlannerROS", TebLocalPlannerROS=teb)

    assert (kind, space) == (DWAPlannerROS, "TebLocalPlannerROS")
    assert (settings.max_vel_x, settings.max_vel_trans, settings.min_vel_x) == (0.8, 0.8, 0.0)
    assert (settings.max_vel_y, settings.acc_lim_theta, settings.yaw_goal_tolerance) == (0.0, 2.0, 0.08)
    assert settings.xy_goal_tolerance == 0.2  # TEB's default
    assert "DWAPlannerROS is used in place of teb_local_planner/TebLocalPlannerROS" in caplog.text


def test_tebs_cars_drive_backwards_and_its_holonomic_robots_sideways() -> None:
    name = "teb_local_planner/TebLocalPlannerROS"
    car = _found(name, TebLocalPlannerROS={"min_turning_radius": 0.5, "max_vel_x_backwards": 0.3})[2]
    assert car.min_vel_x == -0.3
    omni = _found(name, TebLocalPlannerROS={"max_vel_y": 0.3})[2]
    assert (omni.min_vel_y, omni.max_vel_y, omni.vy_samples) == (-0.3, 0.3, 10)


def test_limits_of_elastic_bands_and_of_dwb_have_other_names() -> None:
    bands = {"max_vel_lin": 0.7, "min_in_place_vel_th": 0.2, "max_rotational_acceleration": 1.5}
    settings = _found("eband_local_planner/EBandPlannerROS", EBandPlannerROS=bands)[2]
    assert (settings.max_vel_x, settings.max_vel_trans) == (0.7, 0.7)
    assert (settings.min_vel_theta, settings.acc_lim_theta) == (0.2, 1.5)

    adapter = {"planner_name": "dwb_local_planner::DWBLocalPlanner"}
    dwb = {"max_vel_x": 0.6, "max_speed_xy": 0.5, "vtheta_samples": 15}
    sections = {"LocalPlannerAdapter": adapter, "DWBLocalPlanner": dwb}
    _, space, settings = _found("nav_core_adapter::LocalPlannerAdapter", **sections)
    assert (space, settings.max_vel_trans, settings.vth_samples) == ("DWBLocalPlanner", 0.5, 15)


def test_lattices_are_answered_by_navfn(caplog: pytest.LogCaptureFixture) -> None:
    kind = find_global_planner(_NODE, "SBPLLatticePlanner", RosParameters({}, "/move_base"))[0]
    assert kind is NavfnROS
    assert "navfn/NavfnROS is used in place of SBPLLatticePlanner" in caplog.text
