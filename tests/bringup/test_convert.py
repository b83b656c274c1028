"""`trundle convert`: files in, files and streams out."""

import contextlib
import io
import json
import sys
from pathlib import Path

import mujoco
import pytest
import trimesh
from PIL import Image

from trundle.cli import main
from trundle.description import load
from trundle.diagnostics import Diagnostics
from trundle.model import MeshFile
from trundle.packages import Packages
from trundle.physics import compile_world

MESH = "<visual name='v'><geometry><mesh><uri>{uri}</uri></mesh></geometry></visual>"
MODEL = """<sdf version='1.6'><model name='cart'><link name='base'>{visuals}
<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link>
<link name='wheel'><pose>0 1 0 0 0 0</pose></link>
<joint name='axle' type='revolute'><parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></sdf>"""


@pytest.fixture
def cart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model with two meshes of one name, one of them painted."""
    folder = tmp_path / "cart"
    for sub in ("a", "b"):
        (folder / sub).mkdir(parents=True)
        (folder / sub / "part.obj").write_text(trimesh.creation.box().export(file_type="obj"))
    (folder / "a/part.obj").write_text(
        "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    )
    (folder / "a/part.mtl").write_text("newmtl m\nmap_Kd paint.png\n")
    Image.new("RGB", (1, 1)).save(folder / "a/paint.png")
    path = folder / "model.sdf"
    path.write_text(MODEL.format(visuals=MESH.format(uri="a/part.obj") + MESH.format(uri="b/part.obj")))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    return path


def run(*words: str, stdin: str = "") -> tuple[int, str]:
    out = io.StringIO()
    kept, sys.stdin = sys.stdin, io.StringIO(stdin)
    try:
        with contextlib.redirect_stdout(out):
            return main(words), out.getvalue()
    finally:
        sys.stdin = kept


def test_what_is_converted_can_be_piped_into_check(cart: Path) -> None:
    code, text = run("convert", str(cart), "--to", "sdf")
    assert code == 0
    before = json.loads(run("check", str(cart), "--json")[1])

    code, printed = run("check", "-", "--json", stdin=text)

    after = json.loads(printed)
    assert code == 0
    assert after["models"] == before["models"]
    assert after["sdf_version"] == "1.11"


def test_meshes_are_copied_beside_with_what_they_name(cart: Path, tmp_path: Path) -> None:
    out = tmp_path / "out/cart.sdf"
    out.parent.mkdir()

    assert run("convert", str(cart), "--to", "sdf", "-o", str(out)) == (0, "")

    files = {str(path.relative_to(out.parent)) for path in out.parent.rglob("*") if path.is_file()}
    assert files == {"cart.sdf", "meshes/part.obj", "meshes/part_2.obj", "meshes/part.mtl", "meshes/paint.png"}
    (again,) = load(str(out), Diagnostics(strict=True), packages=Packages({}, start=out)).world.models
    shapes = [visual.geometry for visual in again.links[0].visuals]
    assert [shape.uri for shape in shapes if isinstance(shape, MeshFile)] == ["meshes/part.obj", "meshes/part_2.obj"]


def test_a_scripts_texture_is_copied_too(cart: Path, tmp_path: Path) -> None:
    (cart.parent / "paint.material").write_text(
        "material Paint { technique { pass { texture_unit { texture a/paint.png } } } }"
    )
    script = "<script><uri>paint.material</uri><name>Paint</name></script>"
    box = f"<visual name='v'><geometry><box/></geometry><material>{script}</material></visual>"
    cart.write_text(MODEL.format(visuals=box))

    assert run("convert", str(cart), "--to", "sdf", "-o", "cart.sdf")[0] == 0

    assert "<albedo_map>textures/paint.png</albedo_map>" in (tmp_path / "cart.sdf").read_text()
    assert (tmp_path / "textures/paint.png").is_file()


def test_a_description_is_converted_from_standard_input() -> None:
    code, text = run("convert", "-", "--to", "urdf", stdin=MODEL.format(visuals=""))
    assert code == 0
    assert '<robot name="cart">' in text


def test_an_sdf_model_becomes_a_urdf(cart: Path, tmp_path: Path) -> None:
    code, text = run("convert", str(cart), "--to", "urdf")

    assert code == 0
    described = json.loads(run("check", "-", "--json", stdin=text)[1])
    assert [link["name"] for link in described["urdf"]["links"]] == ["base", "wheel"]
    assert described["urdf"]["joints"][0]["type"] == "continuous"


def test_a_xacro_becomes_the_urdf_it_expands_to(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf.xacro"
    named = "<xacro:property name='n' value='base'/><link name='${n}'/>"
    path.write_text(f"<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>{named}</robot>")
    code, text = run("convert", str(path), "--to", "urdf")
    assert code == 0
    assert '<link name="base"/>' in text


def test_mjcf_is_the_engine_s_own_model(cart: Path, tmp_path: Path) -> None:
    out = tmp_path / "cart.xml"

    assert run("convert", str(cart), "--to", "mjcf", "-o", str(out))[0] == 0

    theirs = mujoco.MjModel.from_xml_path(str(out))
    ours = compile_world(load(str(cart), Diagnostics(), packages=Packages({}, start=cart)).world, Diagnostics()).model
    assert (theirs.nq, theirs.nv, theirs.ngeom) == (ours.nq, ours.nv, ours.ngeom)
    assert theirs.body_mass == pytest.approx(ours.body_mass)
    assert theirs.qpos0 == pytest.approx(ours.qpos0)


def test_two_robots_are_no_urdf(cart: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cart.write_text("<sdf version='1.6'><world name='w'><model name='a'/><model name='b'/></world></sdf>")
    assert main(["convert", str(cart), "--to", "urdf"]) == 1
    assert "a URDF is one robot; here are 2 models" in capsys.readouterr().err


def test_an_output_that_cannot_be_written_is_one_sentence_and_no_file(cart: Path, tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    assert main(["convert", str(cart), "--to", "mjcf", "-o", str(tmp_path / "there")]) == 1
    assert main(["convert", str(cart), "--to", "mjcf", "-o", str(tmp_path / "lost/cart.xml")]) == 1
    assert not list(tmp_path.rglob("*.part"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "<stdin>:1: error: the file is empty"),
        ("<sdf", "<stdin>:1: error: not well-formed XML"),
        ("<robot name='r' xmlns:xacro='x'/>", "read from a file only, by its name"),
    ],
)
def test_standard_input_that_makes_no_sense(text: str, said: str) -> None:
    code, printed = run("check", "-", stdin=text)
    assert code == 1
    assert said in printed
