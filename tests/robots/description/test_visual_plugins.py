"""Plugins of visuals: from SDF, from URDF's <gazebo> blocks, and through both writers."""

from pathlib import Path

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import LoadedDescription, load_text, write_sdf, write_urdf, written_uri
from trundle.robots.model import Visual
from trundle.robots.packages import Packages

HERE = Path(__file__).parent
DRAW = '<plugin name="draw" filename="libdraw.so"><topicName>t</topicName></plugin>'
BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
LABEL = '<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>7</label></plugin>'
SDF = f"""<sdf version="1.7"><model name="m"><link name="l"><visual name="v">{BOX}{DRAW}{LABEL}</visual>
<visual name="bare">{BOX}</visual></link></model></sdf>"""

BODY = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
SHAPE = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
URDF = f"""<robot name="r"><link name="calf">{BODY}{SHAPE}</link><link name="foot">{BODY}{SHAPE}{SHAPE}</link>
<joint name="weld" type="fixed"><parent link="calf"/><child link="foot"/></joint>
<gazebo reference="foot"><visual>{DRAW}<cast_shadows>0</cast_shadows><shine>1</shine></visual></gazebo>
<gazebo reference="foot"><visual><transparency>0.5</transparency></visual></gazebo></robot>"""


def read(text: str, report: Diagnostics | None = None) -> LoadedDescription:
    packages = Packages({"HOME": "/nobody"}, start=HERE)
    return load_text(text, name="<stdin>", folder=HERE, packages=packages, report=report or Diagnostics(strict=True))


def visuals(loaded: LoadedDescription) -> tuple[Visual, ...]:
    return loaded.world.models[0].links[0].visuals


def plugins(loaded: LoadedDescription) -> dict[str, list[str]]:
    return {visual.name: [plugin.node.xml() for plugin in visual.plugins] for visual in visuals(loaded)}


def test_an_sdf_visual_keeps_its_plugins_and_its_label() -> None:
    loaded = read(SDF)
    assert plugins(loaded) == {"v": [DRAW], "bare": []}
    assert visuals(loaded)[0].label == 7

    again = read(write_sdf(loaded.world, is_world=False, uri_of=written_uri, report=Diagnostics(strict=True)))
    assert plugins(again) == plugins(loaded)
    assert visuals(again)[0].label == 7


def test_a_link_s_visual_block_applies_to_each_of_its_own_visuals() -> None:
    """libsdformat merges it this way, lumped or not; the calf's visual gets none of the foot's."""
    report = Diagnostics()
    loaded = read(URDF, report)

    first, *lumped = visuals(loaded)
    assert [first.plugins, first.cast_shadows, first.transparency] == [(), True, 0.0]
    assert plugins(loaded) == {
        "calf_visual": [],
        "calf_fixed_joint_lump__foot_visual_1": [DRAW],
        "calf_fixed_joint_lump__foot_visual_2": [DRAW],
    }
    assert [(visual.cast_shadows, visual.transparency) for visual in lumped] == [(False, 0.5), (False, 0.5)]
    assert report.warnings == ["<stdin>:3: warning: <shine> in <visual> is not supported; it is ignored"]


def test_a_written_urdf_has_the_plugins_of_a_link_once() -> None:
    report = Diagnostics()
    (model,) = read(SDF).world.models

    again = read(write_urdf(model, uri_of=written_uri, report=report))
    lumped = "l_fixed_joint_lump__"
    assert plugins(again) == {f"{lumped}v_visual": [DRAW], f"{lumped}bare_visual_1": [DRAW]}
    assert report.warnings == ["<stdin>:1: warning: link 'l': in a URDF all its visuals get the plugins of any"]
