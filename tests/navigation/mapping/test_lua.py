"""Configurations in Lua."""

import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import UsageError
from trundle.navigation.mapping.cartographer_settings import read_configuration
from trundle.navigation.mapping.lua import LuaError, LuaReader, LuaValue

ROBOT = """
include "map_builder.lua"
include "trajectory_builder.lua"

options = {
  map_builder = MAP_BUILDER,
  trajectory_builder = TRAJECTORY_BUILDER,
  map_frame = "map",
  tracking_frame = "imu_link",
  published_frame = "odom",
  odom_frame = "odom",
  provide_odom_frame = false,
  publish_frame_projected_to_2d = false,
  use_odometry = true,
  num_laser_scans = 1,
  pose_publish_period_sec = 5e-3,
}

MAP_BUILDER.use_trajectory_builder_2d = true
TRAJECTORY_BUILDER_2D.min_range = 0.12 -- the laser's
TRAJECTORY_BUILDER_2D.max_range = 3.5
TRAJECTORY_BUILDER_2D.missing_data_ray_length = TRAJECTORY_BUILDER_2D.max_range - 0.5
TRAJECTORY_BUILDER_2D.motion_filter.max_angle_radians = math.rad(0.1)
TRAJECTORY_BUILDER_2D.ceres_scan_matcher.translation_weight = 10.
POSE_GRAPH.constraint_builder.min_score = 0.65
return options
"""


def run(text: str) -> LuaValue:
    def refuse(_reader: LuaReader, name: str) -> None:
        raise LuaError(f"no {name}")

    return LuaReader(refuse).run(text, "robot.lua")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("return 1 + 2 * 3 ^ 2 - 4 / 2", 17.0),
        ("return -2 ^ 2 + (1 - 3)", -6.0),
        ("return 2 ^ 3 ^ 2", 512.0),
        ("return 10 - 4 - 3", 3.0),
        ("return 0x10 + 1e-1 + .5", 16.6),
        ("return math.rad(180.) / math.pi", 1.0),
        ('return \'a\' .. "b\\"\\n"', 'ab"\n'),
        ("--[[ long\ncomment ]] return true -- end", True),
        ("return nil", None),
        ("x = 4", None),
        (
            "return {1, 2; a = {b = false}, ['c d'] = 3, [7] = 'x',}",
            {1: 1.0, 2: 2.0, "a": {"b": False}, "c d": 3.0, 7: "x"},
        ),
        ("A = {}; A.b.c = 3; local d = A; d['e'] = A.b.c; return A", {"b": {"c": 3.0}, "e": 3.0}),
    ],
)
def test_values_are_lua_s(text: str, value: LuaValue) -> None:
    result = run(text)

    assert result == (pytest.approx(value) if isinstance(value, float) else value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = 1\nfor i = 1, 9 do end", "robot.lua:2: only assignments, include and return are read here, not 'for'"),
        ("x = os.execute('rm')", "robot.lua:1: os is no table"),
        ("x = f(1)", "robot.lua:1: the function f is not known; known: math.rad"),
        ("x = {1, 2", "expected , or ; or }, got the end of the file"),
        ("x = 1 / 0", "1 / 0 is no number"),
        ("x = 10 ^ 400", "is no number"),
        ("x = 0x" + "f" * 400, "a number is too large"),
        ("x = 'a' + 1", "arithmetic needs numbers"),
        ("x = " + "{" * 60, "nested deeper than 50 times"),
        ("x = " + "-" * 60 + "1", "nested deeper|got"),
        ("x = 'open", "is not understood"),
        ("x = \x00", "is not understood"),
        ("x = 1 x.y = 2", "x is no table"),
        ("include 5", "expected a file's name in quotes, got 5"),
    ],
)
def test_what_is_not_read_is_told_with_its_line(text: str, message: str) -> None:
    with pytest.raises(LuaError, match=message):
        run(text)


def test_a_robot_s_configuration_is_read_on_the_originals_defaults(tmp_path: Path) -> None:
    (tmp_path / "robot.lua").write_text(ROBOT)

    settings, unused = read_configuration(tmp_path, "robot.lua")

    assert (settings.tracking_frame, settings.published_frame) == ("imu_link", "odom")
    assert (settings.provide_odom_frame, settings.use_odometry, settings.num_laser_scans) == (False, True, 1)
    assert (settings.min_range, settings.max_range, settings.missing_data_ray_length) == (0.12, 3.5, 3.0)
    assert settings.max_angle_radians == pytest.approx(math.radians(0.1))
    assert (settings.min_score, settings.num_range_data, settings.resolution) == (0.65, 90, 0.05)
    assert unused == ("options without effect here: TRAJECTORY_BUILDER_2D.ceres_scan_matcher.translation_weight")


def test_a_file_beside_the_configuration_is_included(tmp_path: Path) -> None:
    (tmp_path / "base.lua").write_text(ROBOT)
    (tmp_path / "robot.lua").write_text('include "base.lua"\noptions.num_laser_scans = 2\nreturn options')

    assert read_configuration(tmp_path, "robot.lua")[0].num_laser_scans == 2


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("options.num_laser_scans = 'one'", "robot.lua: num_laser_scans"),
        ("options.num_laser_scans = -1", "num_laser_scans must be ≥ 0"),
        ("TRAJECTORY_BUILDER_2D.max_range = {}", "max_range"),
        ("POSE_GRAPH.constraint_builder.fast_correlative_scan_matcher.linear_search_window = 1e9", "must be ≤ 20"),
        ("MAP_BUILDER.use_trajectory_builder_3d = true", "only 2D is built in"),
        ('include "robot.lua"', "includes itself"),
        ('include "none.lua"', "none.lua"),
        ("options = nil", "it returns no table of options"),
    ],
)
def test_an_invalid_configuration_is_refused_in_a_sentence(tmp_path: Path, change: str, message: str) -> None:
    (tmp_path / "robot.lua").write_text(ROBOT.replace("return options", f"{change}\nreturn options"))

    with pytest.raises(UsageError, match=message):
        read_configuration(tmp_path, "robot.lua")
