"""Every element and attribute that any SDF version has is in the model, or named at file and line."""

import re
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as Xml

import pytest
from tests.robots.description.plain import plain

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.packages import Packages

_HERE = "here"
_NOISE = "<noise here=''><stddev>1</stddev></noise>"
_LAYERS = "<blend/><texture/><texture/>"
_BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
_WORLD = "<world name='w'>{}<model name='only'><link name='x'/></model></world>"
_TURNED = "<pose>0 0 1 0.3 0 0</pose>"
_MODEL = f"<model name='m'><link name='l'/><link name='k'>{_TURNED}</link><link name='o'/>{{}}</model>"
_LINK = _MODEL.format("<link name='own'>{}</link>")
_VISUAL = _LINK.format(f"<visual name='v'>{_BOX}{{}}</visual>")
_COLLISION = _LINK.format(f"<collision name='c'>{_BOX}{{}}</collision>")
_SHAPE = _LINK.format("<visual name='v'><geometry>{}</geometry></visual>")
_JOINT = "<joint name='j' type='{}' {}><parent>l</parent><child>k</child>{}</joint>"
_STATE = _WORLD.format(_MODEL.replace("{}", "") + "<light name='sun' type='point'/><state world_name='w'>{}</state>")
_PLAIN_MODEL = "<model name='each'><link name='l'/></model>"
_FILLED = "<box><size>9 9 9</size></box>"
_POPULATION = _WORLD.format("<population name='p' here=''>{}</population>")
_ACTOR = "<actor name='a' here=''><skin><filename>skin.dae</filename></skin><script/></actor>"


def _sensor(type_: str, inside: str) -> str:
    return _LINK.format(f"<sensor name='s' type='{type_}'>{inside}</sensor>")


HOSTS = {
    "root": "",
    "gazebo": "",
    "world": _WORLD.replace("'w'>{}", "'w' here=''>"),
    "model": _MODEL.replace("'m'>", "'m' here=''>").format(_TURNED),
    "link": _LINK.replace("'own'>{}", "'own' here=''>"),
    "inertial": _LINK.format("<inertial here=''/>"),
    "collision": _COLLISION.replace("'c'>", "'c' here=''>").format(""),
    "surface": _COLLISION.format("<surface here=''/>"),
    "visual": _VISUAL.replace("'v'>", "'v' here=''>").format(""),
    "material": _VISUAL.format("<material here=''/>"),
    "geometry": _LINK.format("<visual name='v'><geometry here=''/></visual>"),
    "box": _SHAPE.format("<box here=''/>"),
    "sphere": _SHAPE.format("<sphere here=''/>"),
    "cylinder": _SHAPE.format("<cylinder here=''/>"),
    "capsule": _SHAPE.format("<capsule here=''/>"),
    "ellipsoid": _SHAPE.format("<ellipsoid here=''/>"),
    "cone": _SHAPE.format("<cone here=''/>"),
    "plane": _SHAPE.format("<plane here=''/>"),
    "mesh": _SHAPE.format("<mesh here=''><uri>mesh.stl</uri></mesh>"),
    "heightmap": _SHAPE.format(f"<heightmap here=''><uri>image.png</uri>{_LAYERS}</heightmap>"),
    "polyline": _SHAPE.format("<polyline here=''/>"),
    "image": _SHAPE.format("<image here=''/>"),
    "joint": _MODEL.format(_JOINT.format("revolute", "here=''", "")),
    "mimic": _MODEL.format(_JOINT.format("revolute", "", "<axis><mimic joint='i' here=''/></axis>")),
    "frame": _MODEL.format("<frame name='f' here=''/>"),
    "pose": _MODEL.format(f"<frame name='g'>{_TURNED}</frame><frame name='f'><pose here=''>1 0 0 0 0 1</pose></frame>"),
    "gripper": _MODEL.format("<gripper name='g' here=''/>"),
    "plugin": _MODEL.format("<plugin name='p' filename='libp.so' here=''/>"),
    "physics": _WORLD.format("<physics type='ode' here=''/>"),
    "atmosphere": _WORLD.format("<atmosphere type='adiabatic' here=''/>"),
    "scene": _WORLD.format("<scene here=''/>"),
    "light": _WORLD.format("<light name='s' type='spot' here=''/>"),
    "gui": _WORLD.format("<gui here=''/>"),
    "spherical_coordinates": _WORLD.format("<spherical_coordinates here=''/>"),
    "road": _WORLD.format("<road name='r' here=''><point>0 0 0</point><point>9 0 0</point></road>"),
    "population": _POPULATION.format(_PLAIN_MODEL + _FILLED),
    "actor": _WORLD.format(_ACTOR),
    "projector": _LINK.format("<projector name='p' here=''/>"),
    "particle_emitter": _LINK.format("<particle_emitter name='p' type='point' here=''/>"),
    "battery": _LINK.format("<battery name='b' here=''/>"),
    "audio_sink": _LINK.format("<audio_sink here=''/>"),
    "audio_source": _LINK.format("<audio_source here=''/>"),
    "sensor": _sensor("camera", "").replace("'camera'>", "'camera' here=''>"),
    "camera": _sensor("camera", "<camera here=''/>"),
    "ray": _sensor("ray", "<ray here=''><range><max>9</max></range></ray>"),
    "lidar": _sensor("lidar", "<lidar here=''><range><max>9</max></range></lidar>"),
    "contact": _sensor("contact", "<contact here=''/>"),
    "imu": _sensor("imu", "<imu here=''/>"),
    "gps": _sensor("gps", "<gps here=''/>"),
    "navsat": _sensor("navsat", "<navsat here=''/>"),
    "altimeter": _sensor("altimeter", "<altimeter here=''/>"),
    "magnetometer": _sensor("magnetometer", "<magnetometer here=''/>"),
    "air_pressure": _sensor("air_pressure", "<air_pressure here=''/>"),
    "air_speed": _sensor("air_speed", "<air_speed here=''/>"),
    "forcetorque": _sensor("force_torque", "<force_torque here=''/>"),
    "logical_camera": _sensor("logical_camera", "<logical_camera here=''/>"),
    "sonar": _sensor("sonar", "<sonar here=''/>"),
    "rfid": _sensor("rfid", "<rfid here=''/>"),
    "rfidtag": _sensor("rfidtag", "<rfidtag here=''/>"),
    "transceiver": _sensor("wireless_receiver", "<transceiver here=''/>"),
    "noise": _sensor("imu", f"<imu><angular_velocity><x>{_NOISE}</x></angular_velocity></imu>"),
    "state": _STATE.format("").replace("'w'></state>", "'w' here=''></state>"),
    "model_state": _STATE.format("<model name='m' here=''/>"),
    "link_state": _STATE.format("<model name='m'><pose>0 0 1 0 0 0</pose><link name='l' here=''/></model>"),
    "joint_state": _STATE.format("<joint_state name='j' here=''/>"),
    "light_state": _STATE.format("<light name='sun' here=''/>"),
}
"""Document for each kind of element; the tested one goes into the element with the attribute `here`."""

SPECIAL_HOSTS = {
    "population/box@box": _POPULATION.format(_PLAIN_MODEL),
    "population/cylinder@cylinder": _POPULATION.format(_PLAIN_MODEL),
    "population/model@model": _POPULATION.format(_FILLED),
    "population/distribution/step": _POPULATION.format(
        _PLAIN_MODEL + "<distribution><type>grid</type><rows>2</rows><cols>2</cols></distribution>"
    ),
    "population/distribution/rows": _POPULATION.format(_PLAIN_MODEL + "<distribution><type>grid</type></distribution>"),
    "population/distribution/cols": _POPULATION.format(_PLAIN_MODEL + "<distribution><type>grid</type></distribution>"),
    "actor/joint@joint": _WORLD.format("<actor name='a' here=''><link name='l'/><link name='k'/></actor>"),
    "model/pose@pose": _WORLD.format("<model name='m' here=''><link name='l'/></model>"),
    "camera@name": _sensor("multicamera", "<camera here=''/>"),
    "camera/lens/custom_function": _sensor(
        "wideanglecamera", "<camera here=''><lens><type>custom</type><custom_function/></lens></camera>"
    ),
    "camera/lens/intrinsics": _sensor("camera", "<camera here=''/>"),
    "camera/lens/projection": _sensor("camera", "<camera here=''/>"),
    "camera/lens": _sensor("wideanglecamera", "<camera here=''/>"),
    "camera/save/path": _sensor("camera", "<camera here=''><save enabled='true'/></camera>"),
    "camera/save@enabled": _sensor("camera", "<camera here=''><save><path>shots</path></save></camera>"),
    "imu/noise/type": _sensor("imu", "<imu here=''><noise><rate><stddev>1</stddev></rate></noise></imu>"),
    "joint/axis2": _MODEL.format(_JOINT.format("universal", "here=''", "")),
    "inertial/density": _LINK.format(f"<inertial auto='true' here=''/><collision name='c'>{_BOX}</collision>"),
    "collision/density": _LINK.format(f"<inertial auto='true'/><collision name='c' here=''>{_BOX}</collision>"),
    "physics@default": _WORLD.format("<physics/><physics here=''><max_step_size>0.004</max_step_size></physics>"),
    "surface/friction/torsional/use_patch_radius": _COLLISION.format(
        "<surface here=''><friction><torsional><patch_radius>1</patch_radius></torsional></friction></surface>"
    ),
    "surface/friction/torsional/surface_radius": _COLLISION.format(
        "<surface here=''><friction><torsional><use_patch_radius>0</use_patch_radius></torsional></friction></surface>"
    ),
}
"""Start of a path → document, for elements that matter only beside others."""

UNREACHED = {
    "collision_engine": "no version of <world> or <physics> takes it in",
    "urdf": "a name that the specification keeps for URDF in SDF; no element takes it in",
}

TEXTS = {
    "material/script/name": "Gazebo/Red",
    "model/include/uri": "model://lost",
    "joint@type": "prismatic",
    "joint/parent": "o",
    "joint/child": "o",
    "physics@type": "bullet",
    "state/deletions/name": "m",
    "joint/axis/xyz@expressed_in": "__model__",
    "mimic@axis": "axis2",
    "frame@attached_to": "k",
    "light@type": "directional",
    "model@canonical_link": "k",
    "model@placement_frame": "k",
    "pose@relative_to": "g",
    "pose@frame": "g",
    "pose@rotation_format": "quat_xyzw",
    "inertial/pose@rotation_format": "quat_xyzw",
    "population/distribution/type": "linear-x",
    "forcetorque/frame": "sensor",
    "forcetorque/measure_direction": "parent_to_child",
    "noise@type": "none",
    "imu/noise/type": "none",
    "sensor@type": "imu",
    "contact/collision": "c",
    "scene/fog/type": "linear",
    "camera/lens/type": "equidistant",
    "camera/lens/custom_function/fun": "sin",
}
"""Path → valid value, for elements that do not take any word."""

SNIPPETS = {
    "pose": "<pose>1 2 3 0 0 0</pose>",
    "frame": "<frame name='f'/>",
    "plugin": "<plugin name='p' filename='libp.so'/>",
    "noise": "<noise type='gaussian'><stddev>0.5</stddev></noise>",
    "material": "<material><diffuse>0.1 0.2 0.3 1</diffuse></material>",
    "light": "<light name='lamp' type='point'/>",
    "model": "<model name='inner'><link name='x'/></model>",
    "joint": "<joint name='more' type='fixed'><parent>l</parent><child>k</child></joint>",
    "world/joint": "<joint name='more' type='fixed'><parent>world</parent><child>only</child></joint>",
    "model_state": "<model_state name='m'><pose>1 2 3 0 0 0</pose></model_state>",
    "link_state": "<link_state name='l'><pose>1 2 3 0 0 0</pose></link_state>",
    "light_state": "<light_state name='sun'><pose>1 2 3 0 0 0</pose></light_state>",
    "joint_state": "<joint_state name='j'><angle axis='0'>1</angle></joint_state>",
    "box": "<box><size>4 4 4</size></box>",
    "cylinder": "<cylinder><radius>2</radius></cylinder>",
    "mimic": "<mimic joint='i'><multiplier>2</multiplier></mimic>",
}
"""An element of each kind that stands in many others."""


class Entry(NamedTuple):
    """A line of the inventory."""

    path: str
    type: str
    default: str
    first: str
    last: str

    @property
    def value(self) -> str:
        """A value unlike the default."""
        if self.path in TEXTS:
            return TEXTS[self.path]
        match self.type:
            case "double" | "float":
                number = 0.0 if "inf" in self.default or self.default == "-" else float(self.default)
                return repr(number + 0.25 if abs(number) < 1e6 else number / 2)
            case "int" | "unsigned int":
                return str(int(self.default) // 2 + 2)
            case "bool":
                return "false" if self.default == "true" else "true"
            case "string" | "-":
                return "other"
            case _:
                return {
                    "vector3": "0.1 0.2 0.3",
                    "vector2d": "0.1 0.2",
                    "color": "0.1 0.2 0.3 0.4",
                    "pose": "1 2 3 0 0 0",
                    "time": "1 2",
                }[self.type]


def inventory() -> list[Entry]:
    """All lines but those of pure containers."""
    text = (Path(__file__).parents[2] / "data/sdf_elements.tsv").read_text()
    entries = [Entry(*line.split("\t")) for line in text.splitlines() if not line.startswith("#")]
    holders = {re.split(r"[/@](?=[^/@]*$)", entry.path)[0] for entry in entries}
    return [
        entry
        for entry in entries
        if not (entry.type == "-" and (entry.path in holders or "/" not in entry.path))
        and not (entry.type.startswith("@") and entry.type[1:] not in SNIPPETS)
        and entry.path.split("/")[0].split("@")[0] not in UNREACHED
    ]


def documents(entry: Entry) -> tuple[str, str]:
    """A document without the entry, and the same with it."""
    steps, _, attribute = entry.path.partition("@")
    kind, *below = steps.split("/")
    texts: list[str] = []
    for present in (False, True):
        tag = "gazebo" if kind == "gazebo" else "sdf"
        special = (host for start, host in SPECIAL_HOSTS.items() if f"{entry.path}{entry.type}".startswith(start))
        root = Xml.fromstring(f"<{tag} version='{entry.last}'>{next(special, HOSTS[kind])}</{tag}>")
        if kind in ("root", "gazebo"):
            root.set(_HERE, "")
            if below != ["world"]:
                root.append(Xml.fromstring(HOSTS["model"].replace("here=''", "")))
        (home,) = [element for element in root.iter() if _HERE in element.attrib]
        del home.attrib[_HERE]
        _put(home, below, attribute, entry, present=present)
        texts.append(Xml.tostring(root, encoding="unicode"))
    return texts[0], texts[1]


def _put(home: Any, below: list[str], attribute: str, entry: Entry, *, present: bool) -> None:
    holders = below if attribute else below[:-1]
    for tag in holders:
        child = home.find(tag)
        home = Xml.SubElement(home, tag, NAMED.get(tag, {})) if child is None else child
        if tag == "include" and home.find("uri") is None:
            Xml.SubElement(home, "uri").text = "included.sdf"
        if home.tag in FILLED and not home.text:
            home.text = FILLED[home.tag]
    if not present:
        return
    if attribute:
        home.set(attribute, entry.value)
        if entry.value == "quat_xyzw":
            home.text = "1 0 0 0 0 0 1"
    elif not below:
        home.text = entry.value
    elif entry.type.startswith("@"):
        home.append(Xml.fromstring(SNIPPETS.get(entry.path, SNIPPETS[entry.type[1:]])))
    else:
        child = home.find(below[-1])
        child = Xml.SubElement(home, below[-1], NAMED.get(below[-1], {})) if child is None else child
        child.text = entry.value if entry.type != "-" else None


NAMED = {tag: {"name": "n"} for tag in ("model", "light", "camera", "animation", "collision_state")} | {
    "link": {"name": "l"},
    "joint": {"name": "j"},
    "trajectory": {"id": "0", "type": "walk"},
    "mimic": {"joint": "i"},
}
FILLED = {"xyz": "0 1 0", "pose": "1 0 0 0 0 1", "angle": "1"}
INCLUDED = (
    f"<sdf version='1.9'><model name='included'><link name='x'/><frame name='other'>{_TURNED}</frame></model></sdf>"
)


_LEFT_OUT = re.compile("ignored|not supported|not drawn|not used|not simulated|left out|has no shape")
_TAG = re.compile(r"<(\w+)>")


def understood(folder: Path, text: str) -> tuple[Any, set[str]]:
    """Model and warnings of a document, without source positions."""
    (folder / "x.sdf").write_text(text)
    (folder / "included.sdf").write_text(INCLUDED)
    report = Diagnostics()
    loaded = load(str(folder / "x.sdf"), report, packages=Packages({}, start=folder))
    assert all(finding.at.line is not None for finding in report.findings)
    return plain(loaded.world), {finding.what for finding in report.findings}


@pytest.mark.parametrize("entry", inventory(), ids=lambda entry: entry.path + entry.type * entry.type.startswith("@"))
def test_an_element_is_in_the_model_or_named(entry: Entry, tmp_path: Path) -> None:
    without, with_it = documents(entry)
    assert without != with_it
    model, warnings_without = understood(tmp_path, without)

    changed, warnings_with = understood(tmp_path, with_it)

    more = {
        warning
        for warning in warnings_with ^ warnings_without
        if " wants " not in warning and "neither true nor false" not in warning
    }
    left_out = {
        tag for warning in warnings_with if _LEFT_OUT.search(warning) for tag in _TAG.findall(warning.split(" in <")[0])
    }
    assert changed != model or more or left_out & set(re.split("[/@]", entry.path)), with_it
