"""Reading any file gives a model or one error."""

import contextlib
import json
import re
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from trundle.bringup.check.json_output import description_json
from trundle.description import load
from trundle.diagnostics import Diagnostics, TrundleError
from trundle.model import flattened
from trundle.packages import Packages
from trundle.physics import compile_world

SDF = """<sdf version="1.9"><world name="w"><gravity>0 0 -9.8</gravity>
<physics type="ode"><max_step_size>0.001</max_step_size></physics><frame name="f"><pose>1 0 0 0 0 0</pose></frame>
<light name="sun" type="directional"><pose>0 0 10 0 0 0</pose><direction>-0.5 0.1 -0.9</direction></light>
<model name="m"><pose relative_to="f">0 0 1 0 0 0</pose><link name="a"><inertial><mass>1</mass><pose>0 0 0 0 0 0</pose>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry><surface><friction><ode><mu>0.5</mu></ode>
</friction><contact><collide_bitmask>1</collide_bitmask></contact></surface></collision>
<visual name="v"><geometry><polyline><point>0 0</point><point>1 0</point><point>0 1</point><height>1</height></polyline>
</geometry><material><ambient>1 0 0 1</ambient></material></visual>
<sensor name="s" type="camera"><camera><horizontal_fov>1</horizontal_fov><image><width>8</width><height>8</height>
</image><clip><near>0.1</near><far>10</far></clip></camera></sensor></link>
<frame name="g" attached_to="a"><pose>0 0 0 0 0 0</pose></frame>
<model name="n"><link name="b"><pose relative_to="__model__">0 0 1 0 0 0</pose></link></model>
<joint name="j" type="revolute"><parent>a</parent><child>n::b</child><axis><xyz expressed_in="g">0 0 1</xyz>
<limit><lower>-1</lower><upper>1</upper></limit><dynamics><damping>0.1</damping></dynamics></axis></joint></model>
<state world_name="w"><model name="m"><pose>0 0 2 0 0 0</pose></model></state></world></sdf>"""

URDF = """<robot name="r"><material name="red"><color rgba="1 0 0 1"/></material>
<link name="base"><inertial><origin xyz="0 0 0" rpy="0 0 0"/><mass value="1"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
<visual><geometry><box size="1 1 1"/></geometry><material name="red"/></visual>
<collision><geometry><cylinder radius="1" length="1"/></geometry></collision></link>
<link name="arm"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
</link><link name="tip"/><joint name="hinge" type="revolute"><origin xyz="0 0 1" rpy="0 0 0"/><parent link="base"/>
<child link="arm"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="hinge"/>
</joint><joint name="glue" type="fixed"><parent link="arm"/><child link="tip"/></joint>
<gazebo reference="base"><mu1>0.5</mu1><material>Gazebo/Red</material></gazebo>
<gazebo><plugin name="p" filename="libp.so"/><static>false</static></gazebo></robot>"""

ODD = st.one_of(
    st.sampled_from(["nan", "inf", "-inf", "1e400", "-1e400", "1e308", "-1", "0", "1e-320"]),
    st.sampled_from(["", " ", "\t", "0 0", "1 2 3 4 5 6 7 8", "é", "&#27;", "&#x85;", "&amp;", "true"]),
    st.sampled_from(["a", "b", "m", "world", "__model__", "m::n::b", "n::b", "::", "model://m", "../../etc/passwd"]),
    st.sampled_from(["revolute", "ball", "gearbox", "floating", "planar", "1.4", "1.0"]),
    st.just("x" * 10_000),
    st.floats().map(repr),
    st.integers().map(str),
)
WORD = re.compile(r"(?<=[>\"])[^<>\"\n]+(?=[<\"])")
TAG = re.compile(r"</?[a-z_]+")


def mutated(text: str, edits: list[tuple[int, int, str]]) -> str:
    """A text with words replaced, tags renamed, or parts deleted or doubled."""
    for kind, where, odd in edits:
        pattern = TAG if kind == 1 else WORD
        places = list(pattern.finditer(text))
        if not places:
            return text
        place = places[where % len(places)]
        start, end = place.span()
        match kind:
            case 0:
                text = text[:start] + odd + text[end:]
            case 1:
                other = places[(where * 7 + len(odd)) % len(places)][0]
                text = text[:start] + other + text[end:]
            case 2:
                text = text[:start] + text[min(len(text), end + where % 200) :]
            case _:
                text = text[: start + where % 50] + text[start:]
    return text


EDITS = st.lists(st.tuples(st.integers(0, 3), st.integers(0, 10_000), ODD), min_size=1, max_size=4)


@pytest.mark.parametrize("original", [SDF, URDF], ids=["sdf", "urdf"])
@settings(max_examples=150)
@given(edits=EDITS)
@example(edits=[(0, 0, "1.0")])
def test_a_damaged_description_is_read_or_refused(
    tmp_path: Path, original: str, edits: list[tuple[int, int, str]]
) -> None:
    file = tmp_path / "x.sdf"
    file.write_text(mutated(original, edits))
    report = Diagnostics()

    with contextlib.suppress(TrundleError):
        loaded = load(str(file), report, packages=Packages({"HOME": str(tmp_path)}, start=tmp_path))
        json.dumps(description_json(loaded), allow_nan=False)
        compile_world(flattened(loaded.world), report)

    assert all("\n" not in str(finding) for finding in report.findings)
