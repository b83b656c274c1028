"""Writing and reading keeps the model through SDF, poses and axes through URDF."""

import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, strategies as st
from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.check.json_output import description_json
from trundle.robots.description import LoadedDescription, load_text, write_sdf, write_urdf, written_uri
from trundle.robots.description.writing.tag import Tag
from trundle.robots.model import Joint, Link, Model, PhysicsSettings, Surface, model_from_joint
from trundle.robots.packages import Packages
from trundle.spatial import Pose, quaternion_from_rpy

HERE = Path(__file__).parent
PACKAGES = Packages({"HOME": "/nobody"}, start=HERE)


def read(text: str) -> LoadedDescription:
    return load_text(text, name="<stdin>", folder=HERE, packages=PACKAGES, report=Diagnostics())


def sdf_of(loaded: LoadedDescription, report: Diagnostics | None = None) -> str:
    is_world = loaded.kind == "world"
    return write_sdf(loaded.world, is_world=is_world, uri_of=written_uri, report=report or Diagnostics())


def same(a: Any, b: Any, key: str = "") -> bool:
    """Equal within 1e-9; poses are compared by quaternions, since roll and yaw are ambiguous at pitch ±90°."""
    if key in ("pose", "inertial_pose"):
        turns = [quaternion_from_rpy(*collision[3:]) for collision in (a, b)]
        turned = min(math.dist(turns[0], turns[1]), math.dist(turns[0], [-v for v in turns[1]]))
        return turned < 1e-9 and math.dist(a[:3], b[:3]) <= 1e-9 * max(1.0, *map(abs, a[:3]))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k], k) for k in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9)
    return bool(a == b)


def comparable(loaded: LoadedDescription) -> dict[str, object]:
    return {k: v for k, v in description_json(loaded).items() if k not in ("sdf_version", "urdf")}


RICH = """<sdf version="1.9"><world name="w">
<gravity>0 0 -1.6</gravity><wind><linear_velocity>1 2 3</linear_velocity></wind>
<physics type="ode"><max_step_size>0.002</max_step_size><real_time_update_rate>0</real_time_update_rate></physics>
<physics name="earth" type="ode"><max_step_size>0.0005</max_step_size><gravity>0 0 -9.8</gravity></physics>
<scene><ambient>0.1 0.2 0.3 1</ambient><sky/><shadows>0</shadows><fog><type>linear</type><end>9</end></fog></scene>
<spherical_coordinates><latitude_deg>47.5</latitude_deg></spherical_coordinates>
<light name="lamp" type="spot"><pose>0 0 3 0 0.1 0</pose><spot><inner_angle>0.1</inner_angle>
 <outer_angle>0.5</outer_angle><falloff>1</falloff></spot><attenuation><range>5</range></attenuation></light>
<frame name="dock"><pose>1 0 0 0 0 1.5</pose></frame>
<plugin name="p" filename="libp.so"><a b="1 &lt; 2"/></plugin>
<model name="cart" canonical_link="b"><pose relative_to="dock">0 2 0 0 1.5707963267948966 0.3</pose>
 <self_collide>1</self_collide>
 <link name="a"><pose>0 0 1 0.1 0.2 0.3</pose><inertial><mass>2.5</mass><pose>0 0 0.1 0 0 0.7</pose>
   <inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz><ixy>0.01</ixy></inertia></inertial>
  <gravity>0</gravity><velocity_decay><linear>0.1</linear></velocity_decay>
  <visual name="v"><geometry><ellipsoid><radii>1 2 3</radii></ellipsoid></geometry><transparency>0.5</transparency>
   <material><diffuse>1 0 0 1</diffuse></material></visual>
  <visual name="line"><geometry><polyline><point>0 0</point><point>1 0</point><point>0 1</point><height>2</height>
   </polyline></geometry></visual>
  <collision name="c"><pose>1 0 0 0 0 0</pose><geometry><capsule><radius>0.1</radius><length>2</length></capsule>
   </geometry><surface><friction><ode><mu>0.3</mu></ode></friction><contact><collide_bitmask>3</collide_bitmask>
   <ode><kp>1e5</kp></ode></contact><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce></surface>
  </collision>
  <sensor name="eye" type="camera"><pose>0 0 1 0 0 0</pose><update_rate>20</update_rate><camera>
   <horizontal_fov>1.2</horizontal_fov><image><width>64</width><height>48</height></image></camera></sensor></link>
 <link name="b"><pose relative_to="j">0 0 0.5 0 0 0</pose></link>
 <frame name="tool" attached_to="b"><pose>0.1 0 0 0 0 0</pose></frame>
 <joint name="j" type="revolute"><pose relative_to="a">0 0.3 0 0.2 0 0</pose><parent>a</parent><child>b</child>
  <axis><xyz expressed_in="a">0 1 1</xyz><limit><lower>-1</lower><upper>2</upper><effort>5</effort></limit>
   <dynamics><damping>0.1</damping><spring_stiffness>3</spring_stiffness></dynamics></axis></joint>
 <joint name="s" type="screw"><parent>tool</parent><child>arm::hand</child><axis><xyz>1 0 0</xyz></axis>
  <thread_pitch>-3</thread_pitch></joint>
 <joint name="u" type="universal"><parent>world</parent><child>a</child><axis><xyz>1 0 0</xyz></axis>
  <axis2><xyz>0 1 0</xyz><limit><upper>1</upper></limit></axis2></joint>
 <model name="arm"><pose>0 0 2 0 0 0</pose><link name="hand"/><frame name="grip"><pose>0 0 1 0 0 0</pose></frame>
 </model>
</model>
<model name="box"><static>true</static><link name="l"/></model>
<joint name="between" type="fixed"><parent>cart::arm::grip</parent><child>box</child></joint>
</world></sdf>"""


def test_a_world_with_every_element_round_trips() -> None:
    first = read(RICH)
    report = Diagnostics()
    text = sdf_of(first, report)
    second = read(text)

    assert same(comparable(first), comparable(second))
    assert report.findings == []
    assert len(sdf_of(second).splitlines()) == len(text.splitlines())
    earth = PhysicsSettings(name="earth", max_step_size_s=0.0005, gravity=(0.0, 0.0, -9.8))
    assert (first.world.physics.gravity, first.world.other_physics) == ((0.0, 0.0, -1.6), (earth,))
    for name in ("physics", "other_physics", "scene", "spherical_coordinates", "wind", "magnetic_field", "atmosphere"):
        assert getattr(second.world, name) == getattr(first.world, name)
    (lamp,) = second.world.lights
    assert (lamp.name, lamp.inner_angle_rad, lamp.outer_angle_rad, lamp.range_m) == ("lamp", 0.1, 0.5, 5.0)
    a, b = (loaded.world.models[0].link("a") for loaded in (first, second))
    assert a.collisions[0].surface == b.collisions[0].surface
    assert [v.geometry for v in a.visuals] == [v.geometry for v in b.visuals]
    assert a.visuals[0].material == b.visuals[0].material
    assert a.sensors[0].cameras == b.sensors[0].cameras
    assert '<a b="1 &lt; 2"/>' in second.world.plugins[0].node.xml()


@given(st.lists(st.floats(-4, 4), min_size=6, max_size=6), st.sampled_from([None, math.pi / 2, -math.pi / 2]))
def test_any_pose_round_trips(numbers: list[float], pitch: float | None) -> None:
    if pitch is not None:
        numbers[4] = pitch
    pose = Pose.from_rpy(*numbers)
    tag = Tag("link", {"name": "l"})
    tag.add_pose(pose)
    model = f"<sdf version='1.11'><model name='m'>{''.join(tag.lines())}</model></sdf>"

    again = read(model).world.models[0].links[0].model_from_link

    assert again.position == pytest.approx(pose.position, abs=1e-12)
    signs = [math.dist(pose.quaternion, [s * v for v in again.quaternion]) for s in (1, -1)]
    assert min(signs) < 1e-9


@given(st.text(alphabet=st.characters(min_codepoint=0x20, max_codepoint=0x2FF), min_size=1))
def test_any_name_round_trips(name: str) -> None:
    tag = Tag("robot", {"name": name})
    tag.add("x", name)

    again = parse_xml(tag.document(), name="x.xml")

    assert again.attribute("name") == name
    assert again.string("x") == name.strip()


def test_settings_that_the_model_does_not_hold_are_named() -> None:
    report = Diagnostics()
    sensor = "<sensor name='s' type='smell'><smell><radius>1</radius></smell></sensor>"
    sdf_of(read(f"<sdf version='1.6'><model name='m'><link name='l'>{sensor}</link></model></sdf>"), report)

    assert report.warnings == ["<stdin>:1: warning: sensor 's': the settings of a smell sensor are not written yet"]


def test_names_that_sdf_1_8_refuses_are_written_as_1_7() -> None:
    text = sdf_of(read("<sdf version='1.6'><model name='m'><link name='a::b'/></model></sdf>"))
    assert '<sdf version="1.7">' in text
    assert read(text).world.models[0].links[0].name == "a::b"


CART = """<sdf version="1.6"><model name="cart">
<link name="base"><pose>0 0 1 0 0 0.5</pose><inertial><mass>3</mass></inertial>
 <collision name="c"><geometry><box><size>1 2 3</size></box></geometry>
  <surface><friction><ode><mu>0.2</mu></ode></friction></surface></collision></link>
<link name="wheel"><pose>1 0 1 0 1.2 0</pose><inertial><mass>1</mass><pose>0.1 0 0 0 0 1</pose>
  <inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz></inertia></inertial>
 <visual name="v"><pose>0 0 0.2 0 0 0</pose><geometry><sphere><radius>0.5</radius></sphere></geometry>
  <material><diffuse>1 0 0 1</diffuse></material></visual>
 <sensor name="eye" type="camera"><pose>0 1 0 0 0 0</pose><camera><horizontal_fov>1</horizontal_fov></camera></sensor>
</link>
<link name="plate"><pose>1 2 1 0 0 0</pose></link>
<joint name="axle" type="revolute"><pose>0 0.3 0 0.4 0 0</pose><parent>base</parent><child>wheel</child>
 <axis><xyz>0 1 0</xyz><dynamics><damping>0.5</damping></dynamics></axis></joint>
<joint name="weld" type="fixed"><parent>wheel</parent><child>plate</child></joint>
</model></sdf>"""


def com(model: Model, link: Link) -> Pose:
    return model.links[0].model_from_link.inverse() @ link.model_from_link @ link.inertial.link_from_com


def axis(model: Model, joint: Joint) -> tuple[float, ...]:
    assert joint.axis is not None
    root_from_model = model.links[0].model_from_link.inverse()
    anchor = root_from_model.transform_point(model_from_joint(model, joint).position)
    return (*anchor, *root_from_model.transform_vector(joint.axis.direction))


def urdf_of(model: Model, report: Diagnostics | None = None) -> str:
    return write_urdf(model, uri_of=written_uri, report=report or Diagnostics())


def test_poses_are_kept_in_a_urdf() -> None:
    before = read(CART).world.models[0]
    loaded = read(urdf_of(before))
    after = loaded.world.models[0]

    assert [link.name for link in after.links] == ["base", "wheel", "plate"]
    for link in before.links:
        again = after.link(link.name)
        assert com(after, again).as_list() == pytest.approx(com(before, link).as_list(), abs=1e-9)
        assert again.inertial.moments == pytest.approx(link.inertial.moments)
    assert axis(after, after.joint("axle")) == pytest.approx(axis(before, before.joint("axle")), abs=1e-9)
    axle_axis = after.joint("axle").axis
    assert axle_axis is not None
    assert axle_axis.damping == 0.5
    assert loaded.robot is not None
    assert [joint.type for joint in loaded.robot.joints] == ["continuous", "fixed"]
    assert after.link("base").collisions[0].surface.mu == 0.2
    wheel, was = after.link("wheel"), before.link("wheel")
    for on_wheel, on_was in (
        (wheel.visuals[0].link_from_visual, was.visuals[0].link_from_visual),
        (wheel.sensors[0].link_from_sensor, was.sensors[0].link_from_sensor),
    ):
        now = after.links[0].model_from_link.inverse() @ wheel.model_from_link @ on_wheel
        then = before.links[0].model_from_link.inverse() @ was.model_from_link @ on_was
        assert now.as_list() == pytest.approx(then.as_list(), abs=1e-9)
    assert wheel.visuals[0].material.diffuse == pytest.approx((1.0, 0.0, 0.0, 1.0))


def test_a_surface_with_more_than_urdf_expresses_is_kept_in_a_urdf() -> None:
    model = read(CART).world.models[0]
    surface = Surface(mu=0.2, kp=3e4, slip1=0.1, torsional_coefficient=0.5, patch_radius=0.02, restitution=0.7)
    base = model.link("base")
    collisions = tuple(replace(collision, surface=surface) for collision in base.collisions)
    changed = replace(model, links=tuple(replace(x, collisions=collisions) if x is base else x for x in model.links))

    after = read(urdf_of(changed)).world.models[0].link("base")

    assert [collision.surface for collision in after.collisions] == [surface]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (('type="fixed"', 'type="ball"'), r"<stdin>:\d+: error: joint 'weld': URDF has no ball joints; --to sdf has"),
        (("<parent>wheel</parent>", "<parent>world</parent>"), "one root link; here: 'base', 'world'"),
        (("<child>plate</child>", "<child>base</child>"), "link 'base' is its own ancestor; URDF is a tree"),
        (("<parent>wheel</parent>", "<parent>base</parent><child>wheel</child>"), "link 'wheel' has 2 parents"),
    ],
)
def test_models_that_urdf_cannot_express_are_refused_with_the_reason(change: tuple[str, str], message: str) -> None:
    with pytest.raises(DescriptionError, match=message):
        urdf_of(read(CART.replace(*change)).world.models[0])


def test_a_shape_that_urdf_does_not_support_is_reported() -> None:
    report = Diagnostics()
    urdf_of(read(CART.replace("<sphere><radius>0.5</radius></sphere>", "<capsule/>")).world.models[0], report)
    (warning,) = report.warnings
    assert warning.endswith("visual 'v': URDF has no capsule; it is left out")


def test_imus_and_ray_sensors_are_written_with_their_settings() -> None:
    noise = "<noise type='gaussian'><mean>0.1</mean><stddev>0.2</stddev><bias_mean>0.3</bias_mean></noise>"
    scan = "<horizontal><samples>9</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>"
    text = (
        '<sdf version="1.6"><model name="m"><link name="a"><sensor name="r" type="gpu_ray"><ray>'
        f"<scan>{scan}</scan><range><min>0.1</min><max>8</max></range>{noise}</ray></sensor>"
        f'<sensor name="i" type="imu"><imu><angular_velocity><y>{noise}</y></angular_velocity></imu></sensor>'
        "</link></model></sdf>"
    )

    before = read(text).world.models[0].links[0].sensors
    report = Diagnostics()
    after = read(sdf_of(read(text), report)).world.models[0].links[0].sensors

    assert report.warnings == []
    assert [(s.scan, s.imu) for s in after] == [(s.scan, s.imu) for s in before]
    assert before[0].scan is not None
    assert before[0].scan.noise.bias_mean == 0.3
