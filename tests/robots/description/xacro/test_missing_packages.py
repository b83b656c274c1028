"""Robots with missing includes, read without them."""

from pathlib import Path

import pytest

from trundle.app.cli.main import main
from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import expand_xacro, load
from trundle.robots.packages import LENIENT, Packages

ROBOT = """<?xml version="1.0"?>
<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find no_such_sensors)/urdf/laser.urdf.xacro"/>
  <xacro:include filename="parts.xacro"/>
  <link name="base_link"/>
  <xacro:laser name="front">
    <origin xyz="0 0 1"/>
  </xacro:laser>
  <xacro:mast name="mast"/>
</robot>
"""
PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="mast" params="name">
    <link name="${name}"/>
    <joint name="${name}_joint" type="fixed"><parent link="base_link"/><child link="${name}"/></joint>

    <xacro:laser name="${name}_laser"/>
  </xacro:macro>
</robot>
"""


def write(folder: Path, robot: str = ROBOT) -> Path:
    (folder / "parts.xacro").write_text(PARTS)
    file = folder / "robot.urdf.xacro"
    file.write_text(robot)
    return file


def packages(file: Path, *, is_lenient: bool = True) -> Packages:
    return Packages({"HOME": "/nobody", LENIENT: "1" if is_lenient else "0"}, start=file)


def test_an_include_of_a_missing_package_and_calls_of_its_macros_are_left_out_by_line(tmp_path: Path) -> None:
    file, report = write(tmp_path), Diagnostics()
    text = expand_xacro(file, {}, packages=packages(file), report=report)

    assert '<link name="mast"/>' in text
    assert "laser" not in text
    include, call, nested = report.warnings
    assert include.startswith(f"{file}:3: warning: $(find no_such_sensors): no package 'no_such_sensors'; ")
    assert include.endswith("; the include is left out")
    assert call == f"{file}:6: warning: {_unknown('laser')}"
    assert nested == f"{tmp_path}/parts.xacro:6: warning: {_unknown('laser')}"


def _unknown(name: str) -> str:
    return f"no macro <xacro:{name}>: the call is left out; it may come from an include left out"


def test_without_lenient_such_a_robot_is_refused(tmp_path: Path) -> None:
    file = write(tmp_path)
    with pytest.raises(DescriptionError, match="no package 'no_such_sensors'"):
        expand_xacro(file, {}, packages=packages(file, is_lenient=False), report=Diagnostics())


def test_a_misspelt_macro_is_still_an_error_where_nothing_was_left_out(tmp_path: Path) -> None:
    robot = ROBOT.replace('<xacro:include filename="$(find no_such_sensors)/urdf/laser.urdf.xacro"/>', "")
    file = write(tmp_path, robot)
    with pytest.raises(DescriptionError, match="unknown macro name: xacro:laser"):
        expand_xacro(file, {}, packages=packages(file), report=Diagnostics())


def test_a_mesh_of_a_missing_package_is_not_treated_as_an_include(tmp_path: Path) -> None:
    """The rule also holds within an included file that exists."""
    (tmp_path / "more.xacro").write_text('<robot><link name="$(find no_such_meshes)"/></robot>')
    file = write(tmp_path, ROBOT.replace("$(find no_such_sensors)/urdf/laser.urdf.xacro", "more.xacro"))
    with pytest.raises(DescriptionError, match="no package 'no_such_meshes'"):
        expand_xacro(file, {}, packages=packages(file), report=Diagnostics())


def test_a_file_missing_from_a_stand_in_is_left_out(tmp_path: Path) -> None:
    file = write(tmp_path, ROBOT.replace("no_such_sensors)/urdf/laser", "velodyne_description)/urdf/VLS-128"))
    report = Diagnostics()
    expand_xacro(file, {}, packages=packages(file), report=report)

    assert any(
        message.startswith(f"{file}:3: ") and "the include is left out" in message for message in report.warnings
    )


def test_joints_to_left_out_links_and_their_child_links_are_left_out(tmp_path: Path) -> None:
    """Links of a left-out macro are missing, and so are their joints and child links."""
    joints = "".join(
        f'<joint name="{parent}_{child}" type="fixed"><parent link="{parent}"/><child link="{child}"/></joint>'
        for parent, child in (("base_link", "front"), ("front", "lens"), ("lens", "cap"))
    )
    more = f'<link name="lens"/><link name="cap"/>{joints}</robot>'
    file, report = write(tmp_path, ROBOT.replace("</robot>", more)), Diagnostics()
    loaded = load(str(file), report, packages=packages(file))

    assert loaded.robot is not None
    assert [link.name for link in loaded.robot.links] == ["base_link", "mast"]
    message = "joint 'base_link_front' is left out: no link 'front'"
    assert any(message in warning for warning in report.warnings)


@pytest.mark.parametrize("command", [["check"], ["xacro"], ["convert", "--to", "urdf"]])
def test_commands_take_the_option(
    tmp_path: Path, command: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(LENIENT, "0")  # restored after the test
    file = write(tmp_path)

    assert main([command[0], str(file), *command[1:]]) == 1
    capsys.readouterr()
    assert main([command[0], str(file), *command[1:], "--lenient"]) == 0
    out, err = capsys.readouterr()
    assert f"{file}:3: warning: $(find no_such_sensors)" in out + err
