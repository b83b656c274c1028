"""Launch files of ROS 2 are told from those of ROS 1."""

import re
from pathlib import Path

import pytest
from tests.launch.test_reader import Folders

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.launch import LaunchPlan, read_launch


def read(file: Path, text: str) -> LaunchPlan:
    file.write_text(text)
    return read_launch(file, packages=Folders(), report=Diagnostics())


@pytest.mark.parametrize(("name", "language"), [("a.launch.py", "in Python"), ("a.launch.yaml", "in YAML")])
def test_a_file_in_another_language_is_one_of_ros_2(tmp_path: Path, name: str, language: str) -> None:
    what = f"{name}: error: a launch file {language} is one of ROS 2; those of ROS 1 are read here"
    with pytest.raises(DescriptionError, match=f"{re.escape(what)}$"):
        read(tmp_path / name, "def generate_launch_description(): ...")
    with pytest.raises(DescriptionError, match=f"{re.escape(what)}; included at .*top.launch:1$"):
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
    what = rf"a.launch.xml:1: error: {re.escape(shown)}: this is a launch file of ROS 2; those of ROS 1 are read here$"
    with pytest.raises(DescriptionError, match=what):
        read(tmp_path / "a.launch.xml", f"<launch>{body}</launch>")


def test_the_ending_alone_says_nothing(tmp_path: Path) -> None:
    """ROS 1 has such files, too: those that others include."""
    text = '<launch><arg name="exec" default="1"/><node pkg="p" type="t" name="n"/></launch>'
    assert read(tmp_path / "a.launch.xml", text).nodes[0].name == "n"
