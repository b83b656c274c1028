"""Attributes without which Gazebo refuses a file; here their absence is a warning."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.packages import Packages

LINK = '<link name="l"/>'
BALL = "<geometry><sphere><radius>1</radius></sphere></geometry>"
BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def warnings(folder: Path, text: str, name: str = "x.sdf") -> list[str]:
    report = Diagnostics()
    (folder / name).write_text(text)
    load(str(folder / name), report, packages=Packages({}, start=folder))
    return [warning.partition("warning: ")[2] for warning in report.warnings]


@pytest.mark.parametrize(
    ("body", "tag", "attribute"),
    [
        (f"<world><model name='m'>{LINK}</model></world>", "world", "name"),
        (f"<model name='m'>{LINK}<plugin name='p'/></model>", "plugin", "filename"),
        (f"<model name='m'>{LINK}<plugin filename='p'/></model>", "plugin", "name"),
        (f"<model name='m'><link name='l'><collision>{BALL}</collision></link></model>", "collision", "name"),
        ("<model name='m'><link name='l'><sensor name='s'/></link></model>", "sensor", "type"),
        ("<world name='w'><physics/></world>", "physics", "type"),
        ("<world name='w'><light name='sun'/></world>", "light", "type"),
    ],
)
def test_a_missing_attribute_is_named(tmp_path: Path, body: str, tag: str, attribute: str) -> None:
    """Each case was compared with libsdformat 9.3."""
    messages = warnings(tmp_path, f'<sdf version="1.7">{body}</sdf>')

    assert messages == [f"<{tag}> without {attribute!r}; Gazebo refuses the whole file"]


@pytest.mark.parametrize(
    ("body", "tag", "attribute"),
    [
        ("<world name=''/>", "world", "name"),
        ("<world name='w'><plugin name='p' filename=' '/></world>", "plugin", "filename"),
        (f"<model name='m'><link name='l'><collision name=''>{BALL}</collision></link></model>", "collision", "name"),
    ],
)
def test_an_empty_attribute_is_named(tmp_path: Path, body: str, tag: str, attribute: str) -> None:
    """The rule is Param::SetFromString's of libsdformat 9.9.1: a required parameter must not be an empty string."""
    messages = warnings(tmp_path, f'<sdf version="1.7">{body}</sdf>')

    assert messages == [f"<{tag}> with an empty {attribute!r}; Gazebo refuses the whole file"]


def test_elements_without_required_attributes_are_not_reported(tmp_path: Path) -> None:
    """Cases: elements of the same name elsewhere, and plugins since SDF 1.10."""
    inside = '<plugin filename="p"><light/><plugin/></plugin>'
    contact = '<sensor name="s" type="contact"><contact><collision>c</collision></contact></sensor>'
    joint = (
        '<joint name="j" type="fixed"><parent>world</parent><child>l</child>'
        "<physics><provide_feedback>1</provide_feedback></physics></joint>"
    )

    text = f'<model name="m"><link name="l">{contact}</link>{joint}{inside}</model>'
    assert warnings(tmp_path, f'<sdf version="1.10">{text}</sdf>') == []


def test_included_files_and_gazebo_blocks_are_checked_too(tmp_path: Path) -> None:
    (tmp_path / "part.sdf").write_text(f'<sdf version="1.7"><model name="m">{LINK}<plugin name="p"/></model></sdf>')
    world = '<sdf version="1.7"><world name="w"><include><uri>part.sdf</uri></include></world></sdf>'
    urdf = f'<robot name="r"><link name="l">{BODY}</link><gazebo><plugin name="p"/></gazebo></robot>'

    expected = "<plugin> without 'filename'; Gazebo refuses the whole file"
    assert warnings(tmp_path, world) == [expected]
    assert warnings(tmp_path, urdf, "r.urdf") == [expected]


def test_the_root_element_of_sdf_1_2_is_reported_as_gazebo_refuses_it(tmp_path: Path) -> None:
    (messages,) = warnings(tmp_path, f'<gazebo version="1.2"><model name="m">{LINK}</model></gazebo>')

    assert messages == "<gazebo> was the root element until SDF 1.2; Gazebo refuses the file: it needs <sdf>"


def test_blank_lines_before_a_declaration_stop_xacro_and_not_gazebo(tmp_path: Path) -> None:
    urdf = f'\n<?xml version="1.0"?><robot name="r"><link name="l">{BODY}</link></robot>'

    assert warnings(tmp_path, urdf, "r.urdf") == []
    assert warnings(tmp_path, urdf, "r.urdf.xacro") == [
        "blank lines before <?xml …?>, for which xacro refuses the file"
    ]
