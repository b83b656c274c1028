"""One rule of a format at a time."""

import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import LoadedDescription, expand_xacro, load
from trundle.robots.model import Cylinder, MeshFile, Model
from trundle.robots.packages import Packages
from trundle.spatial import Pose

TURNED = '<link name="a"/><link name="b"><pose>0 0 0 0 0 1.5707963267948966</pose></link>'
HINGE = '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz{}>1 0 0</xyz>{}</axis></joint>'


def read(folder: Path, text: str, report: Diagnostics | None = None, *, name: str = "x.sdf") -> LoadedDescription:
    (folder / name).write_text(text)
    return load(str(folder / name), report or Diagnostics(), packages=Packages({}, start=folder))


def sdf(folder: Path, version: str, body: str, report: Diagnostics | None = None) -> Model:
    return read(folder, f'<sdf version="{version}"><model name="m">{body}</model></sdf>', report).world.models[0]


@pytest.mark.parametrize(
    ("version", "attribute", "extra", "axis"),
    [
        ("1.4", "", "", (1, 0, 0)),
        ("1.5", "", "", (0, 1, 0)),
        ("1.4", ' expressed_in="b"', "", (1, 0, 0)),
        ("1.5", ' expressed_in="__model__"', "", (1, 0, 0)),
        ("1.6", ' expressed_in="a"', "", (1, 0, 0)),
        ("1.6", "", "<use_parent_model_frame>1</use_parent_model_frame>", (1, 0, 0)),
        ("1.6", ' expressed_in="b"', "<use_parent_model_frame>1</use_parent_model_frame>", (1, 0, 0)),
        ("1.7", "", "<use_parent_model_frame>1</use_parent_model_frame>", (0, 1, 0)),
        ("1.7", "", "", (0, 1, 0)),
        ("1.7", ' expressed_in="__model__"', "", (1, 0, 0)),
        ("1.9", ' expressed_in="a"', "", (1, 0, 0)),
    ],
)
def test_the_sdf_version_determines_the_frame_of_an_axis(tmp_path, version, attribute, extra, axis) -> None:
    model = sdf(tmp_path, version, TURNED + HINGE.format(attribute, extra))

    read_axis = model.joints[0].axis
    assert read_axis is not None
    assert read_axis.direction == pytest.approx(axis, abs=1e-12)


def test_poses_are_resolved_through_relative_to(tmp_path: Path) -> None:
    body = (
        '<link name="a"><pose>1 0 0 0 0 1.5707963267948966</pose></link>'
        '<frame name="f" attached_to="a"><pose>1 0 0 0 0 0</pose></frame>'
        '<link name="b"><pose relative_to="f">1 0 0 0 0 0</pose></link>'
    )

    assert sdf(tmp_path, "1.9", body).link("b").model_from_link.position == pytest.approx((1, 2, 0))


def test_an_included_model_takes_the_name_and_pose_it_is_given(tmp_path: Path) -> None:
    text = (
        '<sdf version="1.6"><world name="w"><include><uri>model://ground_plane</uri><name>floor</name>'
        "<pose>0 0 1 0 0 0</pose></include></world></sdf>"
    )

    (model,) = read(tmp_path, text).world.models

    assert (model.name, model.static, model.world_from_model) == ("floor", True, Pose((0.0, 0.0, 1.0)))


def test_unsupported_elements_are_reported_with_their_line(tmp_path: Path) -> None:
    report = Diagnostics()

    sdf(tmp_path, "1.6", '<link name="a">\n<battery name="b"/></link>\n<gripper name="g"/>', report)

    assert [w.partition("x.sdf")[2] for w in report.warnings] == [
        ":2: warning: <battery> in <link> is not supported; it is ignored",
        ":3: warning: <gripper> in <model> is not supported; it is ignored",
    ]


def test_a_bad_number_is_replaced_by_the_default_with_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()

    model = sdf(tmp_path, "1.6", '<link name="a"><inertial><mass>heavy</mass></inertial></link>', report)

    assert model.link("a").inertial.mass == 1.0
    assert any("<mass> needs one number, got 'heavy'; 1 is used" in w for w in report.warnings)


def test_strict_makes_a_warning_an_error(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError, match="<mass> needs one number"):
        sdf(tmp_path, "1.6", '<link name="a"><inertial><mass>x</mass></inertial></link>', Diagnostics(strict=True))


def test_a_description_reads_nothing_outside_its_own_folders(tmp_path: Path) -> None:
    folder = tmp_path / "robot"
    folder.mkdir()
    (tmp_path / "secret.stl").write_text("solid")
    report = Diagnostics()
    mesh = "<visual name='v'><geometry><mesh><uri>../secret.stl</uri></mesh></geometry></visual>"

    model = sdf(folder, "1.6", f'<link name="a">{mesh}</link>', report)

    (visual,) = model.link("a").visuals
    assert visual.geometry == MeshFile(path=None, uri="../secret.stl")
    assert any("a description reads only below its own folders" in w for w in report.warnings)


URDF = """<robot name="r">
<link name="base"><inertial><mass value="2"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="arm"><inertial><origin xyz="1 0 0"/><mass value="2"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="weld" type="fixed"><parent link="base"/><child link="arm"/><origin xyz="1 0 0"/></joint>
{}</robot>"""


def test_a_fixed_joint_lumps_its_links_by_the_parallel_axis_theorem(tmp_path: Path) -> None:
    """Two 2 kg bodies 2 m apart: the middle at 1 m, and 2 · 2 kg · (1 m)² more about the axes across."""
    (model,) = read(tmp_path, URDF.format(""), name="r.urdf").world.models

    (link,) = model.links
    assert link.inertial.mass == 4.0
    assert link.inertial.link_from_com.position == (1.0, 0.0, 0.0)
    assert link.inertial.moments == pytest.approx((2.0, 6.0, 6.0))


def test_sensors_of_lumped_links_get_distinct_names_and_those_of_lumped_joints_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()
    eyes = "".join(
        f'<gazebo reference="{link}"><sensor name="eye" type="imu"><pose>0 0 1 0 0 0</pose></sensor></gazebo>'
        for link in ("base", "arm")
    )
    carried = '<provideFeedback>1</provideFeedback><sensor name="ft" type="force_torque"/>'
    text = URDF.format(f'{eyes}<gazebo reference="weld">{carried}</gazebo>')

    (model,) = read(tmp_path, text, report, name="r.urdf").world.models

    sensors = model.links[0].sensors
    assert [(s.name, s.link_from_sensor.position) for s in sensors] == [("eye", (0, 0, 1)), ("eye_2", (1, 0, 1))]
    twice, lumped = report.warnings
    assert twice.endswith("link 'base' has a second sensor 'eye'; it is renamed 'eye_2'")
    assert "<sensor> for 'weld' in <gazebo> is for a fixed joint that is lumped (<preserveFixedJoint>" in lumped


def test_cameras_with_the_same_name_get_distinct_names(tmp_path: Path) -> None:
    report = Diagnostics()
    both = '<camera name="c"/><camera name="c"/>'
    model = sdf(tmp_path, "1.6", f'<link name="l"><sensor name="s" type="multicamera">{both}</sensor></link>', report)

    assert [camera.name for camera in model.links[0].sensors[0].cameras] == ["c", "c_1"]
    (warning,) = report.warnings
    assert warning.endswith("a second camera 'c'; it is renamed 'c_1'")


def test_provide_feedback_of_a_joint_gives_no_warning(tmp_path: Path) -> None:
    """A <provideFeedback> changes nothing: every joint's load can be read."""
    report = Diagnostics()
    joint = HINGE.format("", "").replace(
        "</joint>", "<physics><provide_feedback>1</provide_feedback></physics></joint>"
    )
    sdf(tmp_path, "1.6", TURNED + joint, report)

    assert not [finding for finding in report.findings if "<physics>" in str(finding)]


def test_a_link_without_mass_is_left_out_with_its_child_links(tmp_path: Path) -> None:
    report = Diagnostics()
    more = (
        '<link name="ghost"/><link name="tip"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        '<joint name="j1" type="continuous"><parent link="base"/><child link="ghost"/></joint>'
        '<joint name="j2" type="continuous"><parent link="ghost"/><child link="tip"/></joint>'
    )

    (model,) = read(tmp_path, URDF.format(more), report, name="r.urdf").world.models

    assert ([link.name for link in model.links], model.joints) == (["base"], ())
    assert any("link 'ghost' has no mass" in w and "with 'tip' below it" in w for w in report.warnings)


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ('<link name="lost"/>', "more than one root link: 'base', 'lost'"),
        ('<link name="base"/>', "a second link 'base'"),
        (
            '<link name="l"/><joint name="j" type="revolute"><parent link="base"/><child link="l"/></joint>',
            "joint 'j': a revolute joint needs <limit effort= velocity=>",
        ),
        (
            '<joint name="j" type="fixed"><parent link="base"/><child link="x"/></joint>',
            "joint 'j': no child link 'x'; links here: 'base', 'arm'",
        ),
    ],
)
def test_a_urdf_that_is_not_a_tree_is_refused_with_the_reason(tmp_path, more, sentence) -> None:
    with pytest.raises(DescriptionError) as error:
        read(tmp_path, URDF.format(more), name="r.urdf")

    assert sentence in str(error.value)


XACRO = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{}</robot>'


def expand(folder: Path, body: str, report: Diagnostics | None = None, **arguments: str) -> str:
    path = folder / "r.urdf.xacro"
    path.write_text(XACRO.format(body))
    return expand_xacro(path, arguments, packages=Packages({}, start=path), report=report or Diagnostics())


def test_bare_macros_of_indigo_are_expanded_with_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()

    text = expand(tmp_path, '<macro name="wheel" params="n"><link name="${n}"/></macro><wheel n="left"/>', report)

    assert '<link name="left"/>' in text
    assert "wheel n=" not in text
    assert len(report.warnings) == 2


@pytest.mark.parametrize("prefix", ["", "xacro:"])
def test_a_property_that_cannot_be_named_is_left_out(tmp_path: Path, prefix: str) -> None:
    report = Diagnostics()

    text = expand(tmp_path, f'<{prefix}property name="" value="1"/><link name="a"/>', report)

    assert '<link name="a"/>' in text
    assert report.warnings[-1].endswith("a property named '' cannot be referenced; it is left out")


def test_plain_xml_of_a_core_tag_s_name_is_left_alone(tmp_path: Path) -> None:
    assert "<include><uri>x</uri></include>" in expand(tmp_path, "<include><uri>x</uri></include>").replace(
        "\n", ""
    ).replace(" ", "")


def test_a_length_may_be_read_by_dunder_len(tmp_path: Path) -> None:
    """xArm's description does this with its serial number; xacro allowed it until 1.13.13."""
    assert '<link name="3"/>' in expand(tmp_path, """<link name="${'abc'.__len__()}"/>""")
    with pytest.raises(DescriptionError, match="Use of invalid name"):
        expand(tmp_path, """<link name="${'abc'.__len__.__self__}"/>""")


def test_arguments_apply_to_one_file_only(tmp_path: Path) -> None:
    body = '<xacro:arg name="n" default="a"/><link name="$(arg n)"/>'

    assert 'name="b"' in expand(tmp_path, body, n="b")
    assert 'name="a"' in expand(tmp_path, body)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("<xacro:nothing/>", "unknown macro name: xacro:nothing"),
        ("${1 +}", "invalid syntax"),
        ("${__import__('os').getcwd()}", "Use of invalid name"),
        ("$(find no_such_package)", r"\$\(find no_such_package\): no package 'no_such_package'"),
        ('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', "infinite recursion"),
    ],
)
def test_faults_that_xacro_refuses_are_one_error(tmp_path, body, words) -> None:
    with pytest.raises(DescriptionError, match=words) as error:
        expand(tmp_path, body)

    assert error.value.at.file.endswith("r.urdf.xacro")
    assert str(error.value).count(": error: ") == 1


def test_sdf_1_0_writes_values_as_attributes(tmp_path: Path) -> None:
    text = (
        '<gazebo version="1.0"><world name="w" my::own="1"><my::own x:y="2"/>'
        '<physics type="ode"><gravity xyz="0 0 -5"/><ode><solver dt="0.002"/>'
        '</ode></physics><model name="m" static="false"><origin pose="1 2 3 0 0 0"/><link name="a"><inertial mass="7">'
        '<inertia ixx="2" iyy="3" izz="4"/></inertial><collision name="c"><geometry><cylinder radius="0.1" length="2"/>'
        '</geometry><surface><friction><ode mu="0.5"/></friction></surface></collision></link><joint name="j" '
        'type="revolute"><parent link="world"/><child link="a"/><axis xyz="0 1 0"><limit lower="-1" upper="2"/></axis>'
        "</joint></model></world></gazebo>"
    )

    world = read(tmp_path, text).world

    (model,) = world.models
    (joint,) = model.joints
    assert (world.physics.gravity, world.physics.max_step_size_s) == ((0.0, 0.0, -5.0), 0.002)
    assert (model.static, model.world_from_model.position) == (False, (1.0, 2.0, 3.0))
    assert (model.link("a").inertial.mass, model.link("a").inertial.moments) == (7.0, (2.0, 3.0, 4.0))
    assert model.link("a").collisions[0].geometry == Cylinder(0.1, 2.0)
    assert (model.link("a").collisions[0].surface.mu, model.link("a").collisions[0].surface.mu2) == (0.5, -1.0)
    assert joint.axis is not None
    assert (joint.parent, joint.axis.direction, joint.axis.lower, joint.axis.upper) == ("world", (0, 1, 0), -1, 2)


def test_gazebo_tags_may_have_a_value_attribute_in_place_of_text(tmp_path: Path) -> None:
    """The urdf tutorials write it so; sdformat reads both."""
    text = """<robot name="r"><link name="a"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="1"/></geometry></collision></link>
<gazebo reference="a"><mu1 value="200.0"/><fdir1 value="0 1 0"/><kp>7</kp>
<turnGravityOff value="true"/></gazebo><gazebo><self_collide>true</self_collide></gazebo></robot>"""
    report = Diagnostics()

    model = read(tmp_path, text, report, name="x.urdf").world.models[0]

    (link,) = model.links
    assert model.self_collide
    surface = link.collisions[0].surface
    assert (surface.mu, surface.fdir1, surface.kp, link.gravity) == (200.0, (0.0, 1.0, 0.0), 7.0, False)
    assert report.warnings == []


def test_a_plugin_of_a_lumped_link_gets_the_merged_link_and_an_offset(tmp_path: Path) -> None:
    text = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="imu_link"/>
<joint name="j" type="fixed"><parent link="base"/><child link="imu_link"/>
<origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/></joint>
<gazebo><plugin name="p" filename="libp.so"><bodyName>imu_link</bodyName><frameName>imu_link</frameName>
<xyzOffset>0.5 0 0</xyzOffset><robotBaseFrame>imu_link</robotBaseFrame></plugin></gazebo></robot>"""

    plugin = read(tmp_path, text, name="x.urdf").world.models[0].plugins[0].node

    assert (plugin.string("bodyName"), plugin.string("frameName")) == ("base", "base")
    assert plugin.string("robotBaseFrame") == "imu_link"
    assert plugin.vector("xyzOffset", default=(0, 0, 0)) == pytest.approx((1.0, 2.5, 3.0))
    assert plugin.vector("rpyOffset", default=(0, 0, 0)) == pytest.approx((0.0, 0.0, math.pi / 2))


BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def test_a_gazebo_block_of_a_lumped_link_applies_to_the_merged_link(tmp_path: Path) -> None:
    text = f"""<robot name="r"><link name="base">{BODY}</link><link name="eye"/>
<joint name="j" type="fixed"><parent link="base"/><child link="eye"/></joint>
<gazebo reference="base"><selfCollide>false</selfCollide><dampingFactor>0.1</dampingFactor></gazebo>
<gazebo reference="eye"><selfCollide>true</selfCollide><turnGravityOff>true</turnGravityOff>
<velocity_decay><angular>0.3</angular></velocity_decay></gazebo></robot>"""
    report = Diagnostics()

    (link,) = read(tmp_path, text, report, name="x.urdf").world.models[0].links

    assert (link.gravity, link.self_collide, link.linear_decay, link.angular_decay) == (False, True, 0.1, 0.3)
    assert report.warnings == []


def test_a_link_in_a_gazebo_block_of_the_robot_is_a_free_body(tmp_path: Path) -> None:
    """The PR2 closes the four-bar linkage of its gripper this way."""
    bar = "<inertial><mass>0.2</mass></inertial><pose>0 0 3 0 0 0</pose>"
    text = f"""<robot name="r"><link name="base">{BODY}</link><link name="palm"/>
<joint name="f" type="fixed"><parent link="base"/><child link="palm"/></joint>
<gazebo><link name="bar">{bar}</link><link name="base">{bar}</link>
<joint name="j" type="revolute"><parent>palm</parent><child>bar</child><axis><xyz>0 1 0</xyz></axis></joint>
</gazebo></robot>"""
    report = Diagnostics()

    model = read(tmp_path, text, report, name="x.urdf").world.models[0]

    assert [(link.name, link.inertial.mass) for link in model.links] == [("base", 1.0), ("bar", 0.2)]
    assert model.link("bar").model_from_link.position == (0.0, 0.0, 3.0)
    assert [(joint.parent, joint.parent_frame, joint.child) for joint in model.joints] == [("base", None, "bar")]
    assert [warning.partition("warning: ")[2] for warning in report.warnings] == [
        "a second link 'base'; it is left out"
    ]


@pytest.mark.parametrize(
    ("above", "carrier"),
    [
        ("", "base"),
        ('<link name="foot"/><joint name="f" type="fixed"><parent link="foot"/><child link="base"/></joint>', "foot"),
        ('<link name="world"/><joint name="f" type="fixed"><parent link="world"/><child link="base"/></joint>', "base"),
    ],
)
def test_the_canonical_link_is_the_one_nearest_the_root_in_any_order_of_the_file(
    above: str, carrier: str, tmp_path: Path
) -> None:
    """libsdformat orders the links of all URDFs of the corpus this way; Jackal's wheels are written before its base."""
    weight = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    links = "".join(f'<link name="{name}">{weight}</link>' for name in ("wheel", "arm", "base"))
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="base"/><child link="{child}"/></joint>'
        for name, child in (("b", "wheel"), ("a", "arm"))
    )

    (model,) = read(tmp_path, f'<robot name="r">{links}{above}{joints}</robot>', name="r.urdf").world.models

    assert model.canonical_link == carrier


def test_a_loop_of_links_detached_from_the_root_is_left_out(tmp_path: Path) -> None:
    ring = "".join(
        f'<joint name="{parent}{child}" type="fixed"><parent link="{parent}"/><child link="{child}"/></joint>'
        for parent, child in ("bc", "cb")
    )
    links = "".join(f'<link name="{name}">{BODY}</link>' for name in "abc")
    report = Diagnostics()

    robot = read(tmp_path, f'<robot name="r">{links}{ring}</robot>', report, name="x.urdf").robot

    assert robot is not None
    assert ([link.name for link in robot.links], robot.joints) == (["a"], ())
    assert "links 'b', 'c' form a loop" in report.warnings[0]


def test_a_gazebo_block_with_an_unknown_reference_is_reported(tmp_path: Path) -> None:
    report = Diagnostics()
    text = f'<robot name="r"><link name="a">{BODY}</link><gazebo reference="b"><mu1>1</mu1><x/></gazebo></robot>'

    read(tmp_path, text, report, name="x.urdf")

    assert [line.partition(": warning: ")[2] for line in report.warnings] == [
        "<mu1> for 'b' in <gazebo> names no known link or joint; it is ignored",
        "<x> for 'b' in <gazebo> names no known link or joint; it is ignored",
    ]


def test_slip_in_a_gazebo_block_is_ignored_as_in_gazebo_with_the_place_that_counts(tmp_path: Path) -> None:
    report = Diagnostics()
    block = "<collision><surface><friction><ode><slip2>0.2</slip2></ode></friction></surface></collision>"
    shape = '<collision><geometry><sphere radius="1"/></geometry></collision>'
    links = "".join(f'<link name="{name}">{BODY}{shape}</link>' for name in "ab")
    joint = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>'
    blocks = f'<gazebo reference="a"><slip1>0.1</slip1></gazebo><gazebo reference="b">{block}</gazebo>'
    text = f'<robot name="r">{links}{joint}{blocks}</robot>'

    world = read(tmp_path, text, report, name="x.urdf").world

    a, b = (link.collisions[0].surface for link in world.models[0].links)
    assert (a.slip1, b.slip2) == (0.0, 0.2)
    (message,) = (line.partition(": warning: ")[2] for line in report.warnings)
    read_instead = "<collision><surface><friction><ode><slip1> is not"
    assert message == f"<slip1> for 'a' in <gazebo> is ignored, as in Gazebo; {read_instead}"


@pytest.mark.parametrize("name", ["x.sdf", "x.urdf"])
def test_bytes_that_are_not_utf_8_are_read_as_latin_1(tmp_path: Path, name: str) -> None:
    """TinyXML accepted any bytes, and many files have German comments in Latin-1."""
    robot = f'<robot name="r"><!-- Räder --><link name="a">{BODY}</link></robot>'
    text = '<sdf version="1.6"><!-- Räder --><model name="r"><link name="a"/></model></sdf>'
    (tmp_path / name).write_bytes((robot if name == "x.urdf" else text).encode("latin-1"))
    report = Diagnostics()

    world = load(str(tmp_path / name), report, packages=Packages({}, start=tmp_path)).world

    assert [link.name for link in world.models[0].links] == ["a"]
    assert ["read as Latin-1" in line for line in report.warnings] == [True]
