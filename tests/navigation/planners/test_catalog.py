"""Planners by their plugins' names, and those that stand in for planners of other packages."""

import logging
from types import SimpleNamespace
from typing import Any

import pytest

from trundle.navigation.planners import find_global_planner, find_local_planner
from trundle.navigation.planners.dwa_planner import DwaSettings
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


@pytest.mark.parametrize("name", ["teb_local_planner/TebLocalPlannerROS", "eband_local_planner/EBandPlannerROS"])
def test_elastic_bands_are_planners_of_their_own(name: str, caplog: pytest.LogCaptureFixture) -> None:
    kind, space, _ = find_local_planner(_NODE, name, RosParameters({}, "/move_base"))

    assert (kind.__name__, space) == (space, name.partition("/")[2])
    assert not caplog.text


def test_planners_are_answered_by_dwa_with_their_limits(caplog: pytest.LogCaptureFixture) -> None:
    follower = {"max_vel_lin": 0.7, "min_in_place_vel_th": 0.2, "max_rotational_acceleration": 1.5}
    settings = _found("pose_follower/PoseFollower", PoseFollower=follower)[2]
    assert "DWAPlannerROS is used in place of pose_follower/PoseFollower" in caplog.text
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
