"""rviz configurations: supported displays are read, the rest is named once."""

from pathlib import Path

import pytest

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.viewer import RvizConfig, RvizDisplay, choose_fixed_frame, read_rviz_config

_TYPICAL = """\
Panels:
  - Class: rviz/Displays
Visualization Manager:
  Class: ""
  Displays:
    - Class: rviz/Grid
      Name: Grid
      Value: true
    - Class: rviz/RobotModel
      Collision Enabled: true
      Name: The robot
      Robot Description: robot_description
    - Class: rviz/TF
      Enabled: false
      Show Names: false
    - Class: rviz/Map
      Enabled: true
      Topic: /map
    - Class: rviz/Map
      Topic: /costmap
    - Class: rviz/LaserScan
      Enabled: false
    - Class: rviz/Group
      Enabled: false
      Displays:
        - Class: rviz/Image
          Image Topic: /camera/image_raw
    - Class: rviz_default_plugins/Odometry
      Topic:
        Depth: 5
        Value: /odom
  Global Options:
    Background Color: 0; 51; 255
    Fixed Frame: /base_link
"""


def _read(text: str, tmp_path: Path) -> tuple[RvizConfig, Diagnostics]:
    path = tmp_path / "robot.rviz"
    path.write_text(text)
    report = Diagnostics()
    return read_rviz_config(path, report), report


def test_displays_frame_and_background_are_read(tmp_path: Path) -> None:
    config, _ = _read(_TYPICAL, tmp_path)

    assert config.fixed_frame == "base_link"
    assert config.background == pytest.approx((0.0, 0.2, 1.0, 1.0))
    assert config.displays == (
        RvizDisplay(kind="Grid", name="Grid"),
        RvizDisplay(kind="RobotModel", name="The robot", source="robot_description", collisions=True),
        RvizDisplay(kind="TF", name="TF", enabled=False, show_names=False),
        RvizDisplay(kind="Image", name="Image", enabled=False, source="/camera/image_raw"),
        RvizDisplay(kind="Odometry", name="Odometry", source="/odom"),
    )
    assert [display.name for display in config.enabled("RobotModel")] == ["The robot"]


def test_a_display_the_page_cannot_show_is_named_once_and_only_if_switched_on(tmp_path: Path) -> None:
    _, report = _read(_TYPICAL, tmp_path)

    assert report.warnings == [
        f"{tmp_path}/robot.rviz:16: warning: rviz display 'rviz/Map' is not supported yet; the page leaves it out"
    ]


def test_a_missing_file_means_the_robot_its_frames_and_its_path(tmp_path: Path) -> None:
    report = Diagnostics()

    config = read_rviz_config(tmp_path / "urdf.rviz", report)

    assert [display.kind for display in config.displays] == ["Grid", "RobotModel", "TF", "Odometry"]
    assert config.fixed_frame is None
    assert report.warnings == [
        f"{tmp_path}/urdf.rviz: warning: no such rviz configuration; showing the robot, its frames and its path"
    ]


def test_without_a_configuration_the_frame_is_one_in_which_the_car_drives() -> None:
    assert choose_fixed_frame(RvizConfig(), ["base_link", "left_wheel", "odom"]) == "odom"
    assert choose_fixed_frame(RvizConfig(), ["left_wheel", "base_link"]) == "base_link"
    assert choose_fixed_frame(RvizConfig(), ["chassis"]) == "chassis"
    assert choose_fixed_frame(RvizConfig(), []) == "base_link"
    assert choose_fixed_frame(RvizConfig(fixed_frame="map"), ["odom"]) == "map"


def test_an_old_configuration_is_named_and_replaced(tmp_path: Path) -> None:
    path = tmp_path / "urdf.vcg"
    path.write_text("Fixed\\ Frame=/base_link\n")
    report = Diagnostics()

    assert read_rviz_config(path, report).enabled("TF")
    assert "before Groovy" in report.warnings[0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Displays: [", "robot.rviz:1: error: not YAML: "),
        ("a: 1\nb: \t- x\n", "robot.rviz:2: error: not YAML: "),
        ("Panels: []\n", "robot.rviz: error: not an rviz configuration"),
        ("", "robot.rviz: error: not an rviz configuration"),
        ("\x00", "robot.rviz: error: not YAML: "),
    ],
)
def test_a_file_that_is_no_configuration_is_refused_at_its_line(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(DescriptionError) as refused:
        _read(text, tmp_path)

    assert message in str(refused.value)


def test_odd_values_fall_back_to_the_defaults_of_rviz(tmp_path: Path) -> None:
    text = "Visualization Manager:\n  Displays: none\n  Global Options: {Background Color: dark, Fixed Frame: [1]}\n"
    config, report = _read(text, tmp_path)

    assert config == RvizConfig()
    assert report.warnings == []


def test_every_published_configuration_is_read(shared: Path) -> None:
    paths = sorted((shared / "corpus").rglob("*.rviz"))
    for path in paths:
        read_rviz_config(path, Diagnostics())

    assert len(paths) > 20
