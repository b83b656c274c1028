"""Names and surfaces of a URDF's shapes, as libsdformat 12.3 converts them."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load_text, write_sdf, write_urdf, written_uri
from trundle.robots.model import Collision, Model, Surface
from trundle.robots.packages import Packages

HERE = Path(__file__).parent
BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
BALL = '<geometry><sphere radius="1"/></geometry>'
NESTED = f"""<robot name="r"><link name="base">{BODY}
<collision>{BALL}</collision><collision name="skid">{BALL}</collision><visual>{BALL}</visual></link>
<link name="lid"><collision name="rim">{BALL}</collision><collision>{BALL}</collision><visual>{BALL}</visual></link>
<link name="plate"><collision>{BALL}</collision></link><link name="base_mast"><collision>{BALL}</collision></link>
<joint name="z" type="fixed"><parent link="base"/><child link="plate"/></joint>
<joint name="y" type="fixed"><parent link="plate"/><child link="lid"/></joint>
<joint name="a" type="fixed"><parent link="base"/><child link="base_mast"/></joint>
<gazebo reference="base"><mu1>0.1</mu1></gazebo><gazebo reference="plate"><mu1>0.2</mu1></gazebo>
<gazebo reference="lid"><mu1>0.3</mu1></gazebo></robot>"""


def read(text: str, report: Diagnostics | None = None) -> Model:
    packages = Packages({"HOME": "/nobody"}, start=HERE)
    loaded = load_text(text, name="<stdin>", folder=HERE, packages=packages, report=report or Diagnostics(strict=True))
    return loaded.world.models[0]


def collision(blocks: str, report: Diagnostics | None = None) -> Collision:
    """The collision of a link `base` with its <gazebo> blocks."""
    return (
        read(f'<robot name="r"><link name="base">{BODY}<collision>{BALL}</collision></link>{blocks}</robot>', report)
        .links[0]
        .collisions[0]
    )


def test_shapes_are_numbered_over_the_whole_merged_link_in_the_order_of_its_joints() -> None:
    (link,) = read(NESTED).links

    assert [shape.name for shape in link.collisions] == [
        "base_collision",
        "base_fixed_joint_lump__skid_collision_1",
        "base_mast_collision_2",
        "base_fixed_joint_lump__plate_collision_3",
        "base_fixed_joint_lump__rim_collision_4",
        "base_fixed_joint_lump__lid_collision_5",
    ]
    assert [shape.name for shape in link.visuals] == ["base_visual", "base_fixed_joint_lump__lid_visual_1"]


def test_a_lumped_link_named_like_the_link_above_has_that_one_s_surface_too() -> None:
    """libsdformat gives the named skid and rim no surface at all; here they have their link's."""
    (link,) = read(NESTED).links

    assert [shape.surface.mu for shape in link.collisions] == [0.1, 0.1, 0.1, 0.2, 0.3, 0.3]


_BOUNCE = "<bounce><restitution_coefficient>0.3</restitution_coefficient><threshold>1000</threshold></bounce>"
_TAGS = "<mu1>0.2</mu1><mu2>0.3</mu2><kp>1e6</kp><kd>100</kd><minDepth>0.001</minDepth><maxVel>1.0</maxVel>"
_MERGED = Surface(
    restitution=0.3, bounce_threshold=1000.0, mu=0.2, mu2=0.3, kp=1e6, kd=100.0, min_depth=0.001, max_vel=1.0
)


@pytest.mark.parametrize("is_first", [True, False])
def test_the_tags_of_a_block_change_values_of_its_surface(is_first: bool) -> None:
    surface = f"<collision><surface>{_BOUNCE}</surface></collision>"
    tags = f"{_TAGS}<maxContacts>4</maxContacts><laserRetro>9</laserRetro>"
    report = Diagnostics()

    result = collision(
        f'<gazebo reference="base">{surface if is_first else ""}{tags}{"" if is_first else surface}</gazebo>', report
    )

    assert result.surface == _MERGED
    assert (result.max_contacts, result.laser_retro) == (4, 9.0)
    assert report.warnings == []


def test_a_surface_replaces_the_tags_of_earlier_blocks_and_keeps_those_of_later_ones() -> None:
    whole = "<collision><max_contacts>7</max_contacts><surface><friction><ode><mu>5</mu></ode></friction></surface>"
    result = collision(
        f'<gazebo reference="base"><mu1>1</mu1><mu2>2</mu2></gazebo>'
        f'<gazebo reference="base">{whole}<shine/></collision></gazebo>'
        f'<gazebo reference="base"><kp value="8"/><fdir1>0 1 0</fdir1></gazebo>',
        report := Diagnostics(),
    )

    assert result.surface == Surface(mu=5.0, mu2=1.0, kp=8.0, fdir1=(0.0, 1.0, 0.0))
    assert result.max_contacts == 7
    assert report.warnings == ["<stdin>:1: warning: <shine> in <collision> is not supported; it is ignored"]


def test_a_merged_surface_is_written_as_sdf() -> None:
    text = f"""<robot name="r"><link name="base">{BODY}<collision>{BALL}</collision></link><gazebo reference="base">
<collision><surface>{_BOUNCE}</surface></collision>{_TAGS}<maxContacts>4</maxContacts></gazebo></robot>"""
    packages = Packages({"HOME": "/nobody"}, start=HERE)
    loaded = load_text(text, name="<stdin>", folder=HERE, packages=packages, report=Diagnostics())

    again = read(write_sdf(loaded.world, is_world=False, uri_of=written_uri, report=Diagnostics(strict=True)))

    (shape,) = again.links[0].collisions
    assert (shape.surface, shape.max_contacts) == (_MERGED, 4)


def test_a_contact_sensor_written_as_urdf_names_the_collisions_of_its_conversion() -> None:
    ball = "<geometry><sphere><radius>1</radius></sphere></geometry>"
    plane = "<geometry><plane><normal>0 0 1</normal></plane></geometry>"
    sensor = '<sensor name="s" type="contact"><contact><collision>b</collision></contact></sensor>'
    model = read(
        f'<sdf version="1.7"><model name="m"><link name="l"><collision name="floor">{plane}</collision>'
        f'<collision name="a">{ball}</collision><collision name="b">{ball}</collision>{sensor}</link></model></sdf>'
    )

    (link,) = read(write_urdf(model, uri_of=written_uri, report=Diagnostics())).links

    assert link.sensors[0].contact_collisions == (link.collisions[1].name,)
    assert link.collisions[1].name == "l_fixed_joint_lump__b_collision_1"
