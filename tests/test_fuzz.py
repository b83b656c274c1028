"""Every reader of files, on damaged ones: it returns a result or one sentence.

Descriptions themselves are damaged in tests/description, bags in tests/ros; tests/launch and test_ogre make up files.
"""

import contextlib
import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from tests.meshes.test_parts import MTL, OBJ, collada
from tests.meshes.test_skins import BVH
from tests.skinned import bending_column

from trundle.description import expand_xacro
from trundle.diagnostics import Diagnostics, TrundleError
from trundle.launch import read_launch
from trundle.meshes import load_mesh, load_motion, load_skin, mean_colour, read_heights
from trundle.packages import Packages, model_file, run_dependencies
from trundle.render.textures import load_texture

XACRO = """<?xml version="1.0"?><robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:arg name="n" default="2"/><xacro:property name="l" value="${2 * 0.5}"/>
<xacro:property name="d" value="${dict(a=1, b=[1, 2])}"/>
<xacro:macro name="box" params="name size:=^|1 *origin"><link name="${name}"><xacro:insert_block name="origin"/>
<visual><geometry><box size="${size} ${l} ${sin(pi / 6)}"/></geometry></visual></link></xacro:macro>
<xacro:if value="${int('$(arg n)') > 1}"><xacro:box name="a"><origin xyz="0 0 ${d['b'][1]}"/></xacro:box></xacro:if>
<xacro:unless value="false"><xacro:box name="b_$(arg n)" size="2"><origin/></xacro:box></xacro:unless></robot>"""
MODEL_CONFIG = """<?xml version="1.0"?><model><name>m</name><version>1.0</version>
<sdf version="1.4">model.sdf</sdf><sdf version='1.6'>model.sdf</sdf><description>d</description></model>"""
PACKAGE = """<package format="2"><name>p</name><depend>roscpp</depend><exec_depend condition="$ROS_VERSION == 1">x
</exec_depend><export><gazebo_ros gazebo_model_path="${prefix}/models" plugin_path="lib"/></export></package>"""
ODD = st.one_of(
    st.sampled_from(
        [b"nan", b"1e400", b"-1", b"0", b"", b"\0", b"<", b"&", b'"', b"${", b"$(find x)", b"../../x", b"{"]
    ),
    st.sampled_from(
        [b"&a [*a, *a]", b"!!python/name:os", b"999999999999", b"\xff\xfe", b"\xff\xff\xff\xff", b"x" * 5000]
    ),
    st.binary(max_size=8),
)
EDITS = st.lists(st.tuples(st.integers(0, 100_000), st.integers(0, 12), ODD), min_size=1, max_size=4)


def _xacro(path: Path) -> None:
    expand_xacro(path, {}, packages=Packages({}, start=path), report=Diagnostics())


def _model_config(path: Path) -> None:
    model_file(path.parent, Diagnostics())


def _package(path: Path) -> None:
    run_dependencies(path.parent)
    packages = Packages({"ROS_PACKAGE_PATH": str(path.parent)}, start=path.parent)
    packages.find_package("p")
    packages.worlds()
    packages.material_folders()


def _collada(path: Path) -> bytes:
    return collada(path).read_bytes()


def _obj(path: Path) -> bytes:
    (path.parent / "car.mtl").write_text(MTL)
    return OBJ.encode()


def _exported(kind: str) -> Callable[[Path], bytes]:
    def write(_: Path) -> bytes:
        made = trimesh.creation.box().export(file_type=kind)
        return made if isinstance(made, bytes) else made.encode()

    return write


def _skin(path: Path) -> None:
    load_skin(path)
    load_motion(path)


LAUNCH = """<launch><arg name="a" default="$(eval 2 - 1)"/><group ns="g" if="$(arg a)"><node pkg="p" type="t" name="n"
args="$(anon x)"><param name="q" value="$(optenv HOME /)" type="str"/><remap from="a" to="b"/></node></group>
<rosparam subst_value="true">{k: deg(90), l: [1, !!float 2, rad(pi)]}</rosparam></launch>"""
YAML = """robot: &r {wheels: [1, 2.5, -.inf], turn: deg(90), lean: rad(pi / 2), on: yes}
again: {<<: *r, date: 2020-01-01, text: "a\\tb", none: ~}
"""


def _launch(path: Path) -> None:
    packages = Packages({}, start=path)
    read_launch(path, packages=packages, report=Diagnostics(), env={"HOME": "/"})


def _yaml(path: Path) -> None:
    (path.parent / "p.launch").write_text(f'<launch><rosparam file="{path}" subst_value="true"/></launch>')
    _launch(path.parent / "p.launch")


def _picture(kind: str) -> Callable[[Path], bytes]:
    def write(_: Path) -> bytes:
        buffer = io.BytesIO()
        Image.fromarray(np.arange(192, dtype=np.uint8).reshape(8, 8, 3)).save(buffer, kind)
        return buffer.getvalue()

    return write


def _texture(path: Path) -> None:
    mean_colour(path)
    load_texture(path.read_bytes())


def _heights(_: Path) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(np.arange(81, dtype=np.uint8).reshape(9, 9)).save(buffer, "PNG")
    return buffer.getvalue()


CASES: dict[str, tuple[Callable[[Path], bytes], Callable[[Path], object]]] = {
    "r.urdf.xacro": (lambda _: XACRO.encode(), _xacro),
    "model.config": (lambda _: MODEL_CONFIG.encode(), _model_config),
    "package.xml": (lambda _: PACKAGE.encode(), _package),
    "m.dae": (_collada, load_mesh),
    "m.obj": (_obj, load_mesh),
    "m.stl": (_exported("stl"), load_mesh),
    "m.glb": (_exported("glb"), load_mesh),
    "h.png": (_heights, read_heights),
    "s.dae": (lambda _: bending_column().encode(), _skin),
    "m.bvh": (lambda _: BVH.encode(), load_motion),
    "t.png": (_picture("PNG"), _texture),
    "t.jpg": (_picture("JPEG"), _texture),
    "l.launch": (lambda _: LAUNCH.encode(), _launch),
    "p.yaml": (lambda _: YAML.encode(), _yaml),
}
"""File → function that writes it, and its reader."""


def _damaged(whole: bytes, edits: list[tuple[int, int, bytes]]) -> bytes:
    for where, length, odd in edits:
        start = where % (len(whole) + 1)
        whole = whole[:start] + odd + whole[start + length :]
    return whole


@pytest.mark.parametrize("name", CASES)
@settings(max_examples=80)
@given(edits=EDITS)
def test_a_damaged_file_is_read_or_refused_in_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, edits: list[tuple[int, int, bytes]]
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    write, read = CASES[name]
    file = tmp_path / name
    (tmp_path / "model.sdf").touch()
    file.write_bytes(_damaged(write(file), edits))

    with contextlib.suppress(TrundleError):
        read(file)


@pytest.mark.parametrize("name", CASES)
def test_the_same_file_is_read_while_it_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    write, read = CASES[name]
    file = tmp_path / name
    (tmp_path / "model.sdf").touch()
    file.write_bytes(write(file))

    read(file)
