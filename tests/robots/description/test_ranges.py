"""Numbers beyond their range are named with file and line, in every reader; nothing overflows later."""

import struct
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.check.check_file import check
from trundle.robots.description import expand_xacro
from trundle.robots.launch import read_launch_text
from trundle.robots.meshes import MeshError, load_mesh
from trundle.robots.packages import Packages
from trundle.robots.parameters import TagParameters

_BEYOND = ["3e38", "-3e38", "1e300", "1e19"]
_SDF = """<sdf version="1.7"><model name="m"><link name="l">
<pose>{pose} 0 0 0 0 0</pose>
<inertial><mass>{mass}</mass><inertia><ixx>{ixx}</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
<collision name="c"><geometry><box><size>{size} 1 1</size></box></geometry></collision>
<visual name="v"><geometry><sphere><radius>{radius}</radius></sphere></geometry></visual>
</link></model></sdf>"""
_URDF = """<robot name="r"><link name="l">
<inertial><origin xyz="{pose} 0 0"/><mass value="{mass}"/>
<inertia ixx="{ixx}" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<collision><geometry><box size="{size} 1 1"/></geometry></collision>
<visual><geometry><sphere radius="{radius}"/></geometry></visual></link></robot>"""
_NAMES = ("pose", "mass", "ixx", "size", "radius")


@pytest.mark.parametrize("value", _BEYOND)
@pytest.mark.parametrize("name", _NAMES)
@pytest.mark.parametrize(("document", "file"), [(_SDF, "m.sdf"), (_URDF, "r.urdf")], ids=["sdf", "urdf"])
def test_a_number_beyond_its_range_is_named_by_line(
    tmp_path: Path, document: str, file: str, name: str, value: str
) -> None:
    path = tmp_path / file
    path.write_text(document.format(**{finding: value if finding == name else "1" for finding in _NAMES}))

    result = check(str(path), {"HOME": "/nobody"}, start=tmp_path)

    findings = [finding for finding in result.report.worst_first() if "within ±" in finding and value in finding]
    line = 1 + next(n for n, text in enumerate(path.read_text().splitlines()) if value in text)
    assert len(findings) == 1, result.text()
    assert findings[0].startswith(f"{path}:{line}: ")


def test_unlimited_as_sdformat_writes_it_is_accepted(tmp_path: Path) -> None:
    path = tmp_path / "m.sdf"
    limit = "<limit><lower>-1.79769e+308</lower><upper>1.79769e+308</upper><effort>1e16</effort></limit>"
    ends = "<parent>world</parent><child>l</child>"
    joint = f'<joint name="j" type="revolute">{ends}<axis><xyz>0 0 1</xyz>{limit}</axis></joint>'
    path.write_text(f'<sdf version="1.7"><model name="m"><link name="l"/>{joint}</model></sdf>')
    assert "within" not in check(str(path), {"HOME": "/nobody"}, start=tmp_path).text()


def _stl(x: float) -> bytes:
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, x)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
    rows = [struct.pack("<12fH", 0, 0, 0, *(c for i in face for c in corners[i]), 0) for face in faces]
    return b"\0" * 80 + struct.pack("<I", len(rows)) + b"".join(rows)


def _obj(x: float) -> bytes:
    return f"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 {x}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n".encode()


_MESHES = {"a.stl": _stl, "a.obj": _obj}


@pytest.mark.parametrize("x", [3e38, -3e38, 1.1e38, 1e12, float("nan"), float("inf")])
@pytest.mark.parametrize("name", _MESHES)
def test_a_damaged_mesh_is_refused_by_its_vertex(tmp_path: Path, name: str, x: float) -> None:
    path = tmp_path / name
    path.write_bytes(_MESHES[name](x))
    with pytest.raises(MeshError, match=r"a\.(stl|obj): vertex \d+ is at .*, which is not within ±1e\+09"):
        load_mesh(path)


@pytest.mark.parametrize("scale", ["1e9", "1e30"])
def test_a_mesh_scaled_beyond_the_range_is_named(tmp_path: Path, scale: str) -> None:
    (tmp_path / "a.stl").write_bytes(_stl(1e6))
    mesh = f"<mesh><uri>a.stl</uri><scale>{scale} {scale} {scale}</scale></mesh>"
    path = tmp_path / "m.sdf"
    path.write_text(
        f'<sdf version="1.7"><model name="m"><link name="l"><collision name="c"><geometry>{mesh}</geometry>'
        "</collision></link></model></sdf>"
    )
    assert "not within ±1e+09" in check(str(path), {"HOME": "/nobody"}, start=tmp_path).text()


def test_a_parameter_of_a_plugin_has_a_range() -> None:
    report = Diagnostics()
    tag = parse_xml('<plugin name="p">\n<update_rate>1e30</update_rate></plugin>', name="m.sdf", report=report)
    assert TagParameters(tag, report).number("update_rate", 10.0) == 10.0
    assert len(report.warnings) == 1
    assert report.warnings[0].startswith("m.sdf:2: ")
    assert "'1e30' is not within ±1e+18" in report.warnings[0]


@pytest.mark.parametrize("character", [r"\x00", r"\x01", r"\x1f", r"\ufffe", r"\uffff"])
def test_a_character_that_xml_forbids_is_an_error_of_its_expression(tmp_path: Path, character: str) -> None:
    path = tmp_path / "a.xacro"
    path.write_text(
        f'<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">\n<link name="${{\'a{character}\'}}"/></robot>'
    )
    with pytest.raises(DescriptionError, match=r"a\.xacro:2: error: a text with the character .*, which XML forbids"):
        expand_xacro(path, {}, packages=Packages({}, start=path), report=Diagnostics())
    text = f'<launch>\n<param name="a" value="$(eval \'a{character}\')"/></launch>'
    with pytest.raises(DescriptionError, match=r"a\.launch:2: error: .* the character .*, which XML forbids"):
        read_launch_text(text, name="a.launch", packages=Packages({}, start=path), report=Diagnostics())
