"""Poses in frames, nested and included models."""

import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import load
from trundle.robots.model import Model, World, flattened, model_from_joint
from trundle.robots.packages import Packages
from trundle.spatial import Pose

QUARTER = "1.5707963267948966"
ARM = """<sdf version="1.9"><model name="arm">
  <pose>9 9 9 0 0 0</pose>
  <link name="upper"><pose>0 0 1 0 0 0</pose></link>
  <link name="lower"><pose relative_to="upper">1 0 0 0 0 0</pose></link>
  <frame name="tip" attached_to="lower"><pose>1 0 0 0 0 0</pose></frame>
  <joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child><axis><xyz>1 0 0</xyz></axis></joint>
</model></sdf>"""


def read(folder: Path, body: str, report: Diagnostics | None = None, *, version: str = "1.9") -> World:
    for name in ("arm", "self"):
        (folder / name).mkdir(exist_ok=True)
        (folder / name / "model.config").write_text('<model><sdf version="1.9">model.sdf</sdf></model>')
    (folder / "arm" / "model.sdf").write_text(ARM)
    include = "<include><uri>model://self</uri></include>"
    (folder / "self" / "model.sdf").write_text(f'<sdf version="1.9"><model name="self">{include}</model></sdf>')
    (folder / "x.sdf").write_text(f'<sdf version="{version}">{body}</sdf>')
    packages = Packages({"GAZEBO_MODEL_PATH": str(folder)}, start=folder)
    return load(str(folder / "x.sdf"), report or Diagnostics(), packages=packages).world


def model(folder: Path, body: str, report: Diagnostics | None = None) -> Model:
    return read(folder, f'<model name="m">{body}</model>', report).models[0]


@pytest.mark.parametrize(
    ("body", "warning"),
    [
        (
            '<link name="a"><pose relative_to="b"/></link><link name="b"><pose relative_to="a"/></link>',
            "itself, through a → b",
        ),
        ('<link name="a"/><frame name="f" attached_to="f"/>', "itself, through f → f"),
        ('<link name="a"><pose relative_to="zzz">1 0 0 0 0 0</pose></link>', "no frame 'zzz'; frames here: 'a'"),
        ('<link name="a"/><frame name="f" attached_to="zzz"/>', "no frame 'zzz'"),
        ('<link name="a"/><link name="a"/>', "a second link 'a', after line 1; it is left out"),
        (
            '<link name="a"/><joint name="j" type="fixed"><parent>a</parent><child>x::y</child></joint>',
            "no link 'x::y'",
        ),
        (
            '<link name="a"/><link name="b"/><joint name="j" type="planar"><parent>a</parent><child>b</child></joint>',
            "no type 'planar'; types: continuous, revolute, prismatic, fixed, ball",
        ),
    ],
)
def test_faults_that_gazebo_accepts_are_accepted_with_a_warning(tmp_path: Path, body: str, warning: str) -> None:
    report = Diagnostics()

    result = model(tmp_path, body, report)

    assert result.link("a").model_from_link.position in ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert any(warning in warning_text for warning_text in report.warnings), report.warnings


def test_an_included_model_is_nested_and_its_frames_can_be_named(tmp_path: Path) -> None:
    body = (
        '<link name="base"/><include><uri>model://arm</uri><name>left</name><pose>0 2 0 0 0 0</pose></include>'
        '<joint name="grip" type="fixed"><parent>base</parent><child>left::tip</child></joint>'
        '<link name="hand"><pose relative_to="left::tip">0 0 1 0 0 0</pose></link>'
    )

    result = model(tmp_path, body)

    (left,) = result.models
    assert (left.name, left.world_from_model.position, left.canonical_link) == ("left", (0.0, 2.0, 0.0), "upper")
    assert result.link("hand").model_from_link.position == pytest.approx((2, 2, 2))
    grip = result.joint("grip")
    assert (grip.child, grip.child_frame) == ("left::lower", "left::tip")
    assert model_from_joint(result, grip).position == pytest.approx((2, 2, 1))


def test_flattening_moves_nested_links_and_joints_to_the_outer_model(tmp_path: Path) -> None:
    body = (
        f'<model name="in"><pose>0 0 5 0 0 {QUARTER}</pose><link name="a"/><link name="b"/>'
        '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis></joint>'
        "</model>"
    )

    (flat,) = flattened(read(tmp_path, f'<model name="m">{body}</model>')).models

    assert [link.name for link in flat.links] == ["in::a", "in::b"]
    assert flat.canonical_link == "in::a"
    (joint,) = flat.joints
    assert (joint.name, joint.parent, joint.child) == ("in::j", "in::a", "in::b")
    assert joint.axis is not None
    assert joint.axis.direction == pytest.approx((0, 1, 0), abs=1e-12)
    assert model_from_joint(flat, joint).position == (0.0, 0.0, 5.0)


def test_a_placement_frame_is_put_at_the_pose(tmp_path: Path) -> None:
    include = "<include><uri>model://arm</uri><placement_frame>tip</placement_frame>"
    include += f"<pose>0 0 0 0 0 {QUARTER}</pose></include>"

    (arm,) = read(tmp_path, f'<world name="w">{include}</world>').models

    assert arm.world_from_model.position == pytest.approx((0, -2, -1))


def test_a_merged_include_becomes_part_of_its_model(tmp_path: Path) -> None:
    body = (
        '<link name="base"/>'
        f'<include merge="true"><uri>model://arm</uri><pose>0 0 0 0 0 {QUARTER}</pose></include>'
        '<joint name="fix" type="fixed"><parent>base</parent><child>upper</child></joint>'
    )

    result = model(tmp_path, body)

    assert [link.name for link in result.links] == ["base", "upper", "lower"]
    assert result.link("lower").model_from_link.position == pytest.approx((0, 1, 1))
    assert [(f.name, f.attached_to) for f in result.frames] == [("_merged__arm__model__", "upper"), ("tip", "lower")]
    axis = result.joint("elbow").axis
    assert axis is not None
    assert axis.direction == pytest.approx((0, 1, 0), abs=1e-12)


STAND = """<sdf version="1.10"><model name="stand"><frame name="top"><pose>0 0 2 0 0 0</pose></frame>
<model name="left"><pose>1 0 0 0 0 0</pose><link name="l"/></model><model name="right"><link name="l"/></model>
<joint name="bar" type="revolute"><parent>right::l</parent><child>left::l</child><axis><xyz>1 0 0</xyz></axis></joint>
{}<plugin name="p" filename="libp.so"/></model></sdf>"""


def merged_world(tmp_path: Path, more: str = "", around: str = "") -> tuple[World, Diagnostics]:
    (tmp_path / "stand.sdf").write_text(STAND.format(more))
    include = f'<include merge="true"><uri>stand.sdf</uri><pose>0 5 0 0 0 {QUARTER}</pose></include>'
    lamp = '<model name="lamp"><pose relative_to="top"/><link name="l"/></model>'
    report = Diagnostics()
    return read(tmp_path, f'<world name="w">{around}{include}{lamp}</world>', report, version="1.10"), report


def test_a_model_is_merged_into_a_world(tmp_path: Path) -> None:
    world, report = merged_world(tmp_path)

    positions = {model.name: model.world_from_model.position for model in world.models}
    assert positions == {
        "lamp": pytest.approx((0, 5, 2)),
        "left": pytest.approx((0, 6, 0)),
        "right": pytest.approx((0, 5, 0)),
    }
    (bar,) = world.joints
    assert (bar.parent, bar.child) == ("right::l", "left::l")
    assert bar.axis is not None
    assert bar.axis.direction == pytest.approx((0, 1, 0), abs=1e-12)
    assert {frame.name: frame.attached_to for frame in world.frames} == {
        "_merged__stand__model__": "left::l",
        "top": "_merged__stand__model__",
    }
    assert [plugin.name for plugin in world.plugins] == ["p"]
    assert report.findings == []


@pytest.mark.parametrize(
    ("more", "around", "why"),
    [
        ('<link name="own"/>', "", "links of its own, which a world cannot have"),
        ("", '<model name="left"><link name="l"/></model>', "a model 'left', whose name is taken"),
    ],
)
def test_a_model_that_cannot_be_merged_into_a_world_stays_a_model(
    tmp_path: Path, more: str, around: str, why: str
) -> None:
    world, report = merged_world(tmp_path, more, around)

    assert "stand" in [model.name for model in world.models]
    assert any(f"model 'stand' has {why}; it is not merged" in warning for warning in report.warnings)


ROBOT = """<?xml version="1.0"?>
<robot name="cart"><link name="base"><inertial><mass value="2"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="arm"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="continuous"><origin xyz="0 0 3"/><parent link="base"/><child link="arm"/></joint>
<link name="bad"><visual/></link><joint name="glue" type="fixed"><parent link="arm"/><child link="bad"/></joint></robot>
"""


def test_a_urdf_can_be_included(tmp_path: Path) -> None:
    (tmp_path / "cart.urdf").write_text(ROBOT)
    include = "<include><uri>cart.urdf</uri><name>{}</name><pose>1 0 0 0 0 0</pose></include>"
    tip = '<model name="tip"><pose relative_to="one::hinge"/><link name="l"/></model>'
    report = Diagnostics()

    world = read(tmp_path, f'<world name="w">{include.format("one")}{include.format("two")}{tip}</world>', report)

    one, two, tip_model = world.models
    assert (one.name, two.name) == ("one", "two")
    assert [link.name for link in one.links] == ["base", "arm"]
    assert tip_model.world_from_model.position == pytest.approx((1, 0, 3))
    assert any("cart.urdf:6: warning: <visual> without a shape" in warning for warning in report.warnings)


def test_a_xacro_file_cannot_be_included(tmp_path: Path) -> None:
    declared = ROBOT.replace("<robot", "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'")
    (tmp_path / "cart.urdf").write_text(declared.replace("</robot>", "<xacro:arm/></robot>"))
    report = Diagnostics()

    world = read(tmp_path, '<world name="w"><include><uri>cart.urdf</uri></include></world>', report)

    assert world.models == ()
    assert "a xacro file cannot be included; `trundle xacro` expands it" in report.warnings[0]


def test_models_and_frames_of_a_world_are_placed_relative_to_one_another(tmp_path: Path) -> None:
    body = (
        '<world name="w"><frame name="dock"><pose>5 0 0 0 0 0</pose></frame>'
        '<model name="a"><pose relative_to="dock">1 0 0 0 0 0</pose><link name="l"/></model>'
        '<model name="b"><pose relative_to="a">0 1 0 0 0 0</pose><link name="l"/></model>'
        '<joint name="tie" type="fixed"><parent>a::l</parent><child>b</child></joint></world>'
    )

    world = read(tmp_path, body)

    assert [m.world_from_model.position for m in world.models] == [(6.0, 0.0, 0.0), (6.0, 1.0, 0.0)]
    (tie,) = world.joints
    assert (tie.parent, tie.child, tie.child_frame) == ("a::l", "b::l", "b")


def test_a_saved_state_places_models(tmp_path: Path) -> None:
    state = (
        '<state world_name="w"><sim_time>1 0</sim_time><deletions><name>gone</name></deletions>'
        '<model name="m"><pose>1 2 3 0 0 0</pose><link name="l"><pose>1 2 3 0 0 0</pose></link></model>'
        '<light name="sun"><pose>0 0 9 0 0 0</pose></light>'
        '<model name="nobody"><pose>0 0 0 0 0 0</pose></model></state>'
    )
    models = '<model name="m"><link name="l"/></model><model name="gone"><link name="l"/></model>'
    report = Diagnostics()

    world = read(
        tmp_path, f'<world name="w"><light name="sun" type="point"/>{models}{state}</world>', report, version="1.6"
    )

    assert [(m.name, m.world_from_model) for m in world.models] == [("m", Pose((1.0, 2.0, 3.0)))]
    assert world.lights[0].world_from_light == Pose((0.0, 0.0, 9.0))
    assert any("<state> of unknown model 'nobody'" in warning_text for warning_text in report.warnings)


def test_a_model_that_includes_itself_is_refused(tmp_path: Path) -> None:
    report = Diagnostics()

    read(tmp_path, '<world name="w"><include><uri>model://self</uri></include></world>', report)

    assert any("includes itself" in warning_text for warning_text in report.warnings)


@pytest.mark.slow
def test_exponentially_nested_includes_are_stopped(tmp_path: Path) -> None:
    parts = "".join(f"<include><name>part{i}</name><uri>model://{{}}</uri></include>" for i in range(10))
    for i in range(12):
        folder = tmp_path / f"size{i}"
        folder.mkdir()
        (folder / "model.config").write_text("<model><sdf version='1.9'>model.sdf</sdf></model>")
        inside = parts.format(*[f"size{i + 1}"] * 10) if i < 11 else "<link name='l'/>"
        (folder / "model.sdf").write_text(f"<sdf version='1.9'><model name='m'>{inside}</model></sdf>")

    with pytest.raises(DescriptionError, match=r"model\.sdf:1: error: .* takes more than (5000 files|the time)"):
        read(tmp_path, '<world name="w"><include><uri>model://size0</uri></include></world>')


def test_models_nested_too_deeply_are_refused(tmp_path: Path) -> None:
    deep = '<model name="m">' * 240 + '<link name="a"/>' + "</model>" * 240

    with pytest.raises(DescriptionError, match="nested more than"):
        read(tmp_path, deep)


def test_deeply_nested_elements_are_skipped_as_in_gazebo(tmp_path: Path) -> None:
    report = Diagnostics()
    deep = "<a>" * 1000 + "</a>" * 1000

    result = model(tmp_path, f'<link name="l"/><plugin name="p" filename="libp.so">{deep}</plugin>{deep}', report)

    assert [link.name for link in result.links] == ["l"]
    assert result.plugins[0].node.xml().count("<a>") == 999
    assert report.warnings == [f"{tmp_path}/x.sdf:1: warning: <a> in <model> is not supported; it is ignored"]


@pytest.mark.parametrize("body", ["<a>" * 100_000, "<a>" * 3000 + "</a>" * 3000])
def test_elements_nested_too_deeply_are_one_error(tmp_path: Path, body: str) -> None:
    with pytest.raises(DescriptionError, match=r"x\.sdf:1: error: elements nested more than 2000 deep"):
        model(tmp_path, body)


def test_a_deep_file_that_defines_entities_is_refused(tmp_path: Path) -> None:
    bomb = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 12))
    deep = "<a>" * 300 + "&e11;" + "</a>" * 300
    (tmp_path / "x.sdf").write_text(f'<!DOCTYPE sdf [<!ENTITY e0 "x">{bomb}]><sdf version="1.6">{deep}</sdf>')
    with pytest.raises(DescriptionError):
        load(str(tmp_path / "x.sdf"), Diagnostics(), packages=Packages({}, start=tmp_path))


def test_automatic_inertia_is_computed_from_the_collisions(tmp_path: Path) -> None:
    """A 1 m cube of water beside a 2 m one: 9 t, centred 8/9 of the way."""
    cubes = "".join(
        f'<collision name="c{size}"><pose>{x} 0 0 0 0 0</pose><geometry><box><size>{size} {size} {size}</size></box>'
        "</geometry></collision>"
        for x, size in ((0, 1), (9, 2))
    )

    inertial = model(tmp_path, f'<link name="a"><inertial auto="true"/>{cubes}</link>').link("a").inertial

    assert inertial.mass == pytest.approx(9000)
    assert inertial.link_from_com.position == pytest.approx((8, 0, 0))
    assert inertial.moments[0] == pytest.approx(1000 / 6 + 8000 * 4 / 6)
    assert inertial.moments[1] == pytest.approx(1000 / 6 + 8000 * 4 / 6 + 1000 * 64 + 8000 * 1)


@pytest.mark.parametrize(
    ("parent", "child", "resolved", "origin"),
    [
        ("world", "__model__", ("world", "a"), (0, 0, 0)),
        ("__model__", "b", ("a", "b"), (0, 3, 0)),
        ("world", "f", ("world", "a"), (5, 0, 0)),
    ],
)
def test_a_joint_to_the_model_itself_is_one_to_its_canonical_link(tmp_path, parent, child, resolved, origin) -> None:
    """Compare libsdformat 12; when it was taken for the world, the joint was off by the model's pose."""
    links = '<link name="a"><pose>0 0 1 0 0 0</pose></link><link name="b"><pose>0 3 0 0 0 0</pose></link>'
    ends = f'<joint name="j" type="fixed"><parent>{parent}</parent><child>{child}</child></joint>'
    report = Diagnostics()

    frame = '<frame name="f"><pose>5 0 0 0 0 0</pose></frame>'
    built = model(tmp_path, f"<pose>1 2 3 0 0 0</pose>{links}{frame}{ends}", report)

    (joint,) = built.joints
    assert (joint.parent, joint.child) == resolved
    assert model_from_joint(built, joint).position == pytest.approx(origin)
    assert report.warnings == []


def test_a_joint_between_a_model_and_its_canonical_link_is_left_out(tmp_path: Path) -> None:
    report = Diagnostics()
    ends = '<joint name="j" type="fixed"><parent>a</parent><child>__model__</child></joint>'

    assert model(tmp_path, f'<link name="a"/>{ends}', report).joints == ()
    assert "joint 'j' connects 'a' to itself; the joint is left out" in report.warnings[0]


@pytest.mark.parametrize(
    ("version", "x", "message"), [("1.6", 3.0, ""), ("1.7", 1.0, "<pose frame='a'> is ignored: SDF 1.7 calls it")]
)
def test_the_frame_attribute_of_a_pose_is_read_until_sdf_1_6(
    tmp_path: Path, version: str, x: float, message: str
) -> None:
    links = '<link name="a"><pose>2 0 0 0 0 0</pose></link><link name="b"><pose frame="a">1 0 0 0 0 0</pose></link>'
    report = Diagnostics()

    (built,) = read(tmp_path, f'<model name="m">{links}</model>', report, version=version).models

    assert built.link("b").model_from_link.position[0] == x
    assert message in "".join(report.warnings)
    assert bool(message) == bool(report.warnings)


def test_the_offset_of_a_mimic_does_not_move_links_of_a_converted_urdf(tmp_path: Path) -> None:
    """libsdformat 9's conversion ignores mimics; there, limits of 1e16 and of −1 mean unlimited."""
    body = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    links = "".join(f'<link name="{name}">{body}</link>' for name in "abc")
    limit = '<limit lower="-1e16" upper="1e16" effort="-1" velocity="-1"/><axis xyz="1 0 0"/>'
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r">{links}<joint name="j" type="prismatic"><parent link="a"/><child link="b"/>{limit}</joint>'
        f'<joint name="k" type="prismatic"><parent link="b"/><child link="c"/>{limit}<origin xyz="1 0 0"/>'
        '<mimic joint="j" offset="0.5"/></joint></robot>'
    )

    (built,) = load(str(tmp_path / "r.urdf"), Diagnostics(), packages=Packages({}, start=tmp_path)).world.models

    assert built.link("c").model_from_link.position == (1.0, 0.0, 0.0)
    axis = built.joints[1].axis
    assert axis is not None
    assert (axis.lower, axis.upper, axis.effort, axis.velocity) == (-math.inf, math.inf, math.inf, math.inf)
    assert axis.mimic is not None
    assert axis.mimic.offset == 0.5


def test_an_include_in_a_gazebo_block_nests_a_model_in_a_urdf(tmp_path: Path) -> None:
    """libsdformat 9 keeps the <include>, and joints can name its links; rovers mount lamps this way."""
    read(tmp_path, '<model name="m"/>')
    body = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    include = "<include><uri>model://arm</uri><name>lamp</name><pose>1 0 0 0 0 0</pose></include>"
    joint = '<joint name="j" type="fixed"><parent>base</parent><child>lamp::upper</child></joint>'
    box = '<model name="box"><link name="l"/></model>'
    (tmp_path / "r.urdf").write_text(
        f'<robot name="r"><link name="base">{body}</link><gazebo>{include}{joint}{box}</gazebo></robot>'
    )
    report = Diagnostics()
    packages = Packages({"GAZEBO_MODEL_PATH": str(tmp_path)}, start=tmp_path)

    (built,) = load(str(tmp_path / "r.urdf"), report, packages=packages).world.models

    base_model, lamp = built.models
    assert [link.name for link in base_model.links] == ["l"]
    assert (lamp.name, lamp.world_from_model.position) == ("lamp", (1.0, 0.0, 0.0))
    assert [(warning_text.parent, warning_text.child) for warning_text in built.joints] == [("base", "lamp::upper")]
    assert report.warnings == []
