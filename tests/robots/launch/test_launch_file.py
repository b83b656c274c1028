"""Launch files of ROS 2 are distinguished from those of ROS 1."""

import re
from pathlib import Path

import pytest
from tests.robots.launch.test_reader import Folders

from trundle.app.cli import main
from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import LaunchPlan, read_launch, read_launch_text


def read(file: Path, text: str) -> LaunchPlan:
    file.write_text(text)
    return read_launch(file, packages=Folders(), report=Diagnostics())


@pytest.mark.parametrize(("name", "language"), [("a.launch.py", "in Python"), ("a.launch.yaml", "in YAML")])
def test_launch_files_in_python_or_yaml_are_reported_as_ros_2(tmp_path: Path, name: str, language: str) -> None:
    pattern = f"{name}: error: a launch file {language} is one of ROS 2; only ROS 1 launch files are supported"
    with pytest.raises(DescriptionError, match=rf"{re.escape(pattern)} \[ros2-file\]$"):
        read(tmp_path / name, "def generate_launch_description(): ...")
    with pytest.raises(DescriptionError, match=f"{re.escape(pattern)}; included at .*top.launch:1 \\[ros2-file\\]$"):
        read(tmp_path / "top.launch", f'<launch><include file="$(dirname)/{name}"/></launch>')


@pytest.mark.parametrize(
    ("body", "shown"),
    [
        ('<node pkg="p" exec="t" name="n"/>', "<node exec>"),
        ('<group><let name="a" value="1"/><arg name="b" default="$(var a)"/></group>', "$(var …)"),
        ('<arg name="a" default="$(find-pkg-share p)/x"/>', "$(find-pkg-share …)"),
        ('<arg name="b" default="1"/><param name="a" value="$(var b)"/>', "$(var …)"),
    ],
)
def test_xml_of_ros_2_is_named(tmp_path: Path, body: str, shown: str) -> None:
    pattern = (
        rf"a.launch.xml:1: error: {re.escape(shown)}: this is a launch file of ROS 2; only ROS 1 launch files are "
    )
    pattern += r"supported \[ros2-file\]$"
    with pytest.raises(DescriptionError, match=pattern):
        read(tmp_path / "a.launch.xml", f"<launch>{body}</launch>")


@pytest.mark.parametrize("name", ["a.launch.py", "a_launch.py", "launch.yml"])
def test_commands_that_take_no_launch_file_print_the_same_error(
    tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / name
    file.write_text("launch: []")
    language = "in Python" if file.suffix == ".py" else "in YAML"
    message = (
        f"{file}: error: a launch file {language} is one of ROS 2; only ROS 1 launch files are supported [ros2-file]\n"
    )
    for command in (
        ["run", str(file), "--headless"],
        ["render", str(file), "-o", str(tmp_path / "a.png")],
        ["convert", str(file), "--to", "sdf"],
        ["xacro", str(file)],
    ):
        assert main(command) == 1
        assert capsys.readouterr().err == message
    assert main(["check", str(file)]) == 1
    assert capsys.readouterr().out.startswith(message)


def test_xml_of_ros_2_is_refused_by_run_and_from_a_pipe(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "a.launch.xml"
    file.write_text('<launch><node pkg="p" exec="t"/></launch>')
    assert main(["run", str(file), "--headless"]) == 1
    assert ":1: error: <node exec>: this is a launch file of ROS 2" in capsys.readouterr().err
    with pytest.raises(DescriptionError, match="<stdin>:1: error: <node exec>: this is a launch file of ROS 2"):
        read_launch_text(file.read_text(), name="<stdin>", packages=Folders(), report=Diagnostics())


def test_the_suffix_alone_does_not_mark_a_ros_2_file(tmp_path: Path) -> None:
    """ROS 1 has such files, too, meant for inclusion."""
    text = '<launch><arg name="exec" default="1"/><node pkg="p" type="t" name="n"/></launch>'
    assert read(tmp_path / "a.launch.xml", text).nodes[0].name == "n"
