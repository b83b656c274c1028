"""URDFs with a fault, read as urdfdom 3 and the conversion of libsdformat 9 read them."""

import re
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import load
from trundle.robots.model import MeshFile, Model
from trundle.robots.packages import Packages

BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def robot(folder: Path, text: str, report: Diagnostics) -> Model:
    (folder / "r.urdf").write_text(text)
    return load(str(folder / "r.urdf"), report, packages=Packages({}, start=folder)).world.models[0]


def test_child_links_of_a_lumped_link_without_mass_are_left_out(tmp_path: Path) -> None:
    """libsdformat 9 and 12 do not descend below such a link; its shapes became part of the parent body."""
    report = Diagnostics()
    text = f"""<robot name="r"><link name="base">{BODY}</link><link name="mount"/><link name="arm">{BODY}</link>
<link name="heavy"><inertial><mass value="2"/></inertial></link><link name="hand">{BODY}</link>
<joint name="j1" type="fixed"><parent link="base"/><child link="mount"/></joint>
<joint name="j2" type="continuous"><parent link="mount"/><child link="arm"/></joint>
<joint name="j3" type="fixed"><parent link="base"/><child link="heavy"/></joint>
<joint name="j4" type="continuous"><parent link="heavy"/><child link="hand"/></joint></robot>"""

    model = robot(tmp_path, text, report)

    assert ([link.name for link in model.links], [joint.name for joint in model.joints]) == (["base", "hand"], ["j4"])
    assert report.warnings[-1].endswith(
        "link 'mount' has no mass; as in Gazebo its subtree is left out of the simulation: 'arm'; give it an <inertial>"
    )


@pytest.mark.parametrize(("mass", "links"), [("1e-6", 1), ("2e-6", 2), ("0", 1), ("-1", 1)])
def test_a_millionth_of_a_kilogram_counts_as_no_mass(tmp_path: Path, mass: str, links: int) -> None:
    """ignition::math::equal counts it as zero."""
    tip = BODY.replace('mass value="1"', f'mass value="{mass}"')
    text = f"""<robot name="r"><link name="base">{BODY}</link><link name="tip">{tip}</link>
<joint name="j" type="continuous"><parent link="base"/><child link="tip"/></joint></robot>"""

    assert len(robot(tmp_path, text, Diagnostics()).links) == links


def test_a_faulty_link_is_read_up_to_its_fault_as_by_urdfdom(tmp_path: Path) -> None:
    """A mass without <inertia> is kept; the rest of the link is not read, nor is anything after an invalid shape."""
    report = Diagnostics()
    ball, none = ("<geometry><sphere radius='1'/></geometry>", "<geometry><cone/></geometry>")
    text = f"""<robot name="r"><link name="base"><visual>{ball}</visual>
<inertial><origin xyz="1 0 0"/><mass value="2"/></inertial></link>
<link name="tip">{BODY}<collision>{ball}</collision><visual>{ball}</visual><visual>{none}</visual></link>
<joint name="j" type="continuous"><parent link="base"/><child link="tip"/></joint></robot>"""

    model = robot(tmp_path, text, report)

    base, tip = model.links
    assert (base.inertial.mass, base.inertial.moments) == (2.0, (0.0, 0.0, 0.0))
    assert base.inertial.link_from_com.position == (1.0, 0.0, 0.0)
    assert [(len(link.visuals), len(link.collisions)) for link in (base, tip)] == [(0, 0), (1, 0)]
    assert [warning.partition("warning: ")[2] for warning in report.warnings] == [
        "link 'base': <inertial> without a whole <inertia>; as by urdfdom, its mass of 2 kg is kept "
        "and its inertia is zero",
        "link 'base': as by urdfdom, <visual> after a fault is not read",
        "<cone> is not a URDF shape; this <visual> is left out",
        "link 'tip': as by urdfdom, <collision> after a fault is not read",
    ]


@pytest.mark.parametrize(
    ("attributes", "inside", "warning"),
    [
        ('version="2.0"', "", "version '2.0': urdfdom 3 refuses any but 1.0; it is read as that"),
        ("", "<dynamics/>", "joint 'j': <dynamics> with neither damping nor friction, for which urdfdom refuses"),
        (
            "",
            "<safety_controller soft_upper_limit='1'/>",
            "joint 'j': <safety_controller> without k_velocity, for which",
        ),
    ],
)
def test_faults_that_urdfdom_refuses_are_read_with_a_warning(
    tmp_path: Path, attributes: str, inside: str, warning: str
) -> None:
    report = Diagnostics()
    text = f"""<robot name="r" {attributes}><link name="base">{BODY}</link><link name="tip">{BODY}</link>
<joint name="j" type="continuous"><parent link="base"/><child link="tip"/>{inside}</joint></robot>"""

    assert len(robot(tmp_path, text, report).links) == 2
    (message,) = report.warnings
    assert warning in message


def test_a_material_without_a_name_is_a_fault_as_to_urdfdom(tmp_path: Path) -> None:
    report = Diagnostics()
    ball = "<geometry><sphere radius='1'/></geometry>"
    first, second = (f"<visual>{ball}<material{name}/></visual>" for name in (" name=''", ""))
    text = f'<robot name="r"><link name="base">{BODY}{first}{second}<collision>{ball}</collision></link></robot>'

    (link,) = robot(tmp_path, text, report).links

    assert (len(link.visuals), len(link.collisions)) == (1, 0)
    assert [warning.partition("warning: ")[2] for warning in report.warnings][-2:] == [
        "<material> without a name, a fault to urdfdom; as in Gazebo its <visual> is left out",
        "link 'base': as by urdfdom, <collision> after a fault is not read",
    ]


def test_shapes_of_the_world_link_are_left_out_with_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()
    text = f"""<robot name="r"><link name="world"><visual><geometry><sphere radius="1"/></geometry></visual></link>
<link name="base">{BODY}</link>
<joint name="j" type="fixed"><parent link="world"/><child link="base"/></joint></robot>"""

    assert [link.name for link in robot(tmp_path, text, report).links] == ["base"]
    (message,) = report.warnings
    assert "link 'world' is the world itself: as in Gazebo its shapes are left out" in message


def test_missing_meshes_of_links_without_mass_are_named(tmp_path: Path) -> None:
    report = Diagnostics()
    mesh = '<geometry><mesh filename="package://absent/arm.dae"/></geometry>'
    text = f'<robot name="r"><link name="base"><visual>{mesh}</visual></link></robot>'

    assert robot(tmp_path, text, report).links == ()
    assert any("package://absent/arm.dae: no package 'absent'" in warning for warning in report.warnings)


def test_ros2_control_is_named_as_ros_2_s(tmp_path: Path) -> None:
    report = Diagnostics()
    control = '<ros2_control name="c" type="system"><joint name="j"/></ros2_control>'
    robot(tmp_path, f'<robot name="r"><link name="base">{BODY}</link>{control}</robot>', report)

    (message,) = report.warnings
    assert "<ros2_control> is ROS 2's: nothing drives its joints; ROS 1 has <transmission>" in message


def test_a_file_of_macros_alone_is_a_part_to_include(tmp_path: Path) -> None:
    macro = '<xacro:macro name="wheel" params="x"><link/></xacro:macro>'
    text = f'<robot xmlns:xacro="http://ros.org/wiki/xacro">{macro}</robot>'
    with pytest.raises(DescriptionError, match="no links; is it a part to include, or was a xacro macro never called"):
        robot(tmp_path, text, Diagnostics())


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("arm.urdf", '<robot><link name="arm"/></robot>'),
        ("arm.gazebo", '<gazebo reference="arm"><mu1>1</mu1></gazebo>'),
        ("arm.xacro", '<robot xmlns:xacro="http://ros.org/wiki/xacro" name="a"><link name="${prefix}arm"/></robot>'),
    ],
)
def test_a_file_that_another_includes_is_a_part_to_include(
    name: str, text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / name).write_text(text)

    assert main(["check", str(tmp_path / name)]) == 1

    printed = capsys.readouterr().out
    assert re.search(rf"{name}:1: error: .*\ba part (of a URDF )?to include, not a robot", printed), printed


def test_meshes_of_sdf_1_0_are_named_by_an_attribute(tmp_path: Path) -> None:
    report = Diagnostics()
    mesh = '<geometry><mesh filename="arm.stl" scale="2 2 3"/></geometry>'
    text = (
        f'<gazebo version="1.0"><model name="m"><link name="l"><visual name="v">{mesh}</visual></link></model></gazebo>'
    )
    (tmp_path / "m.sdf").write_text(text)
    (tmp_path / "arm.stl").write_text("solid arm\nendsolid\n")

    (model,) = load(str(tmp_path / "m.sdf"), report, packages=Packages({}, start=tmp_path)).world.models

    (visual,) = model.links[0].visuals
    assert isinstance(visual.geometry, MeshFile)
    assert (visual.geometry.path, visual.geometry.scale) == (tmp_path / "arm.stl", (2.0, 2.0, 3.0))
