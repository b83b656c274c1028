"""Planners and a layer in Python, of a package and of an installed distribution."""

from importlib.metadata import EntryPoint, EntryPoints
from pathlib import Path
from typing import Any

import pytest
from tests.navigation.move_base.test_move_base import stamped_pose, start

from trundle.navigation.planners import GlobalPlannerPlugin

_STRAIGHT_LINE = '''
"""A straight line, whatever stands there."""
import numpy as np
from trundle.navigation.planners import GlobalPlannerPlugin


class StraightLine(GlobalPlannerPlugin):
    def find_path(self, costmap, start, goal, tolerance_m):
        count = self.settings.integer("poses", default=11)
        return np.linspace(start, goal, count)
'''
_BACKWARDS = """
from trundle.navigation.planners import LocalPlannerPlugin


class Backwards(LocalPlannerPlugin):
    def choose_velocity(self, pose, path, goal):
        return -self.settings.number("speed"), 0.0, 0.0
"""
_CORNER = """
from trundle.navigation.costmap import LETHAL, LayerPlugin


class Corner(LayerPlugin):
    def add_costs(self, costs, window):
        costs[:4, :4] = LETHAL
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of a package `mine` on ROS_PACKAGE_PATH."""
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "package.xml").write_text("<package><name>mine</name></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    return folder


def test_a_global_planner_of_a_package_plans(graph: Any, package: Path) -> None:
    (package / "plugins").mkdir()
    (package / "plugins/straight_line.py").write_text(_STRAIGHT_LINE)
    start(graph, base_global_planner="mine/StraightLine", StraightLine={"poses": 5})

    plan = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(2.05, 1.05)).plan

    assert [pose.pose.position.x for pose in plan.poses] == pytest.approx([1.05, 1.3, 1.55, 1.8, 2.05])


def test_a_local_planner_of_a_package_drives(graph: Any, package: Path) -> None:
    (package / "backwards.py").write_text(_BACKWARDS)
    start(graph, base_local_planner="mine::Backwards", Backwards={"speed": 0.3})
    commands = graph.listen("/cmd_vel", "geometry_msgs/Twist")
    goals = graph.advertise("/move_base_simple/goal", "geometry_msgs/PoseStamped")
    graph.until(lambda: graph.connected("/cmd_vel"))

    goals.publish(stamped_pose(2.0, 1.0))

    graph.until(lambda: any(command.linear.x == -0.3 for command in commands))


def test_a_layer_of_a_package_marks_cells(graph: Any, package: Path) -> None:
    (package / "src/mine").mkdir(parents=True)
    (package / "src/mine/corner.py").write_text(_CORNER)
    layers = [{"name": "static", "type": "costmap_2d::StaticLayer"}, {"name": "corner", "type": "mine::Corner"}]
    common = {"robot_radius": 0.2, "transform_tolerance": 5.0, "publish_frequency": 20.0, "update_frequency": 20.0}
    start(graph, global_costmap={**common, "plugins": layers})
    grids = graph.listen("/move_base/global_costmap/costmap", "nav_msgs/OccupancyGrid")

    graph.until(lambda: grids and grids[-1].data[0] == 100)
    cells = grids[-1].data.reshape(40, 40)
    assert (cells[:4, :4] == 100).all()
    assert cells[10, 10] == 0


def test_an_installed_planner_is_found_by_its_entry_point(graph: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    entry = EntryPoint("theirs/Direct", f"{__name__}:Direct", "trundle.navigation.global_planners")
    monkeypatch.setattr(
        "importlib.metadata.entry_points", lambda *, group: EntryPoints([entry] if group == entry.group else [])
    )
    start(graph, base_global_planner="theirs/Direct")

    plan = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(2.05, 1.05)).plan

    assert [pose.pose.position.x for pose in plan.poses] == pytest.approx([1.05, 2.05])


class Direct(GlobalPlannerPlugin):
    """Two poses."""

    def find_path(self, costmap: Any, start: Any, goal: Any, tolerance_m: float) -> Any:
        del costmap, tolerance_m
        return [start, goal]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("class StraightLine(:", "straight_line.py:1: "),
        ("1 / 0", "straight_line.py:1: ZeroDivisionError"),
        ("class Other: pass", "there is no class 'StraightLine'"),
        ("class StraightLine: pass", "is no subclass of trundle.navigation.planners"),
    ],
)
def test_a_damaged_planner_ends_move_base_in_a_sentence(
    graph: Any, package: Path, text: str, error: str, capfd: pytest.CaptureFixture[str]
) -> None:
    (package / "straight_line.py").write_text(text)

    assert start(graph, base_global_planner="mine/StraightLine", ends=True).result(30.0) == 1
    assert error in capfd.readouterr().err


def test_an_exception_in_a_planner_is_no_plan(graph: Any, package: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (package / "straight_line.py").write_text(_STRAIGHT_LINE.replace("np.linspace(start, goal, count)", "[1 / 0]"))
    start(graph, base_global_planner="mine/StraightLine")

    plan = graph.call("/move_base/make_plan", "nav_msgs/GetPlan", goal=stamped_pose(2.05, 1.05)).plan

    assert len(plan.poses) == 0
    assert "straight_line.py:10: ZeroDivisionError" in capfd.readouterr().err
