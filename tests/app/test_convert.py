"""`trundle convert` with files and streams."""

import contextlib
import io
import json
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from PIL import Image

from trundle.app.cli import main
from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.model import MeshFile, flattened
from trundle.robots.packages import Packages
from trundle.sim.physics import compile_mjcf, compile_world
from trundle.sim.physics.compile.inertia import possible_moments
from trundle.sim.physics.compile.law_tables import find_table
from trundle.sim.render import scene_from_world

MESH = "<visual name='v'><geometry><mesh><uri>{uri}</uri></mesh></geometry></visual>"
MODEL = """<sdf version='1.6'><model name='cart'><link name='base'>{visuals}
<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link>
<link name='wheel'><pose>0 1 0 0 0 0</pose></link>
<joint name='axle' type='revolute'><parent>base</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></sdf>"""


XACRO = "xmlns:xacro='http://www.ros.org/wiki/xacro'"


@pytest.fixture
def cart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model with two meshes of the same file name, one of them textured."""
    folder = tmp_path / "cart"
    obj = trimesh.creation.box().export(file_type="obj")
    assert isinstance(obj, str)
    for sub in ("a", "b"):
        (folder / sub).mkdir(parents=True)
        (folder / sub / "part.obj").write_text(obj)
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
    with tempfile.TemporaryFile("w+") as file, contextlib.redirect_stdout(out), pytest.MonkeyPatch.context() as patch:
        file.write(stdin)
        file.seek(0)
        patch.setattr(sys, "stdin", file)
        return main(words), out.getvalue()


def test_the_output_can_be_piped_into_check(cart: Path) -> None:
    code, text = run("convert", str(cart), "--to", "sdf")
    assert code == 0
    before = json.loads(run("check", str(cart), "--json")[1])

    code, printed = run("check", "-", "--json", stdin=text)

    after = json.loads(printed)
    assert code == 0
    assert after["models"] == before["models"]
    assert after["sdf_version"] == "1.11"


def test_meshes_are_copied_with_their_materials_and_textures(cart: Path, tmp_path: Path) -> None:
    out = tmp_path / "out/cart.sdf"
    out.parent.mkdir()

    assert run("convert", str(cart), "--to", "sdf", "-o", str(out)) == (0, "")

    files = {str(path.relative_to(out.parent)) for path in out.parent.rglob("*") if path.is_file()}
    assert files == {"cart.sdf", "meshes/part.obj", "meshes/part_2.obj", "meshes/part.mtl", "meshes/paint.png"}
    (model,) = load(str(out), Diagnostics(strict=True), packages=Packages({}, start=out)).world.models
    shapes = [visual.geometry for visual in model.links[0].visuals]
    assert [shape.uri for shape in shapes if isinstance(shape, MeshFile)] == ["meshes/part.obj", "meshes/part_2.obj"]


def test_the_texture_of_a_material_script_is_copied(cart: Path, tmp_path: Path) -> None:
    (cart.parent / "paint.material").write_text(
        "material Paint { technique { pass { texture_unit { texture a/paint.png } } } }"
    )
    script = "<script><uri>paint.material</uri><name>Paint</name></script>"
    visual = f"<visual name='v'><geometry><box/></geometry><material>{script}</material></visual>"
    cart.write_text(MODEL.format(visuals=visual))

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


def test_a_xacro_file_is_expanded_to_urdf(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf.xacro"
    content = "<xacro:property name='n' value='base'/><link name='${n}'/>"
    path.write_text(f"<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>{content}</robot>")
    code, text = run("convert", str(path), "--to", "urdf")
    assert code == 0
    assert '<link name="base"/>' in text


def test_mjcf_compiles_to_the_simulated_model(cart: Path, tmp_path: Path) -> None:
    out = tmp_path / "cart.xml"

    assert run("convert", str(cart), "--to", "mjcf", "-o", str(out))[0] == 0

    converted = mujoco.MjModel.from_xml_path(str(out))
    simulated = compile_world(
        load(str(cart), Diagnostics(), packages=Packages({}, start=cart)).world, Diagnostics()
    ).model
    assert (converted.nq, converted.nv, converted.ngeom) == (simulated.nq, simulated.nv, simulated.ngeom + 2)
    assert converted.body_mass == pytest.approx(simulated.body_mass)
    assert converted.qpos0 == pytest.approx(simulated.qpos0)


VISUALS = """<visual name='v'><pose>0.1234567890123 0 0 0 0 0.3</pose><geometry><sphere><radius>0.3</radius></sphere>
</geometry><material><diffuse>1 0.5 0 1</diffuse><specular>0.2 0.2 0.2 1</specular></material><transparency>0.5
</transparency></visual><visual name='flat'><geometry><mesh><uri>a/part.obj</uri></mesh></geometry></visual>
<visual name='v'><geometry><cone><radius>1</radius><length>2</length></cone></geometry></visual>
<light name='lamp' type='spot'><pose>0 0 1 0 0 0</pose><spot><outer_angle>1</outer_angle></spot></light>"""


def test_mjcf_has_visuals_without_contacts(cart: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cart.write_text(MODEL.format(visuals=VISUALS))

    code, text = run("convert", str(cart), "--to", "mjcf")

    model = mujoco.MjModel.from_xml_string(text)
    visuals = np.flatnonzero(model.geom_group == 2)
    assert code == 0
    assert len(visuals) == 3
    ball, flat, cone = visuals
    assert model.geom_rgba[ball] == pytest.approx([0.5, 0.5, 0.5, 1.0])  # MuJoCo's default: the material has the color
    assert model.mat_rgba[model.geom_matid[ball]] == pytest.approx([1.0, 0.5, 0.0, 0.5])
    assert model.mat_specular[model.geom_matid[ball]] == pytest.approx(0.2)
    assert model.geom_type[flat] == model.geom_type[cone] == mujoco.mjtGeom.mjGEOM_MESH
    assert model.geom_pos[ball][0] == 0.1234567890123
    assert not model.geom_contype[visuals].any()
    assert model.light_cutoff[0] == pytest.approx(np.degrees(0.5))
    assert "textures are written to MJCF with -o only" in capsys.readouterr().err


def test_mjcf_has_the_texture_of_the_mesh(cart: Path, tmp_path: Path) -> None:
    """A triangle with corners at (0, 0), (1, 0) and (0, 1) of an image, v up; MuJoCo's v points down."""
    Image.new("RGB", (3, 2), (250, 10, 30)).save(cart.parent / "a/paint.png")
    out = tmp_path / "out/cart.xml"
    out.parent.mkdir()

    code, printed = run("convert", str(cart), "--to", "mjcf", "-o", str(out))

    model = mujoco.MjModel.from_xml_path(str(out))
    textured, plain = np.flatnonzero(model.geom_group == 2)
    material = model.geom_matid[textured]
    assert (code, "textures" in printed) == (0, False)
    assert model.mat_texid[material].max() == 0
    assert model.mat_texid[model.geom_matid[plain]].max() == -1
    assert (model.ntex, model.tex_width[0], model.tex_height[0]) == (1, 3, 2)
    assert list(model.tex_data[:3]) == [250, 10, 30]
    assert model.mat_rgba[material] == pytest.approx([1.0, 1.0, 1.0, 1.0])
    mesh = model.geom_dataid[textured]
    first = model.mesh_texcoordadr[mesh]
    assert model.mesh_texcoord[first : first + 3].tolist() == [[0, 1], [1, 1], [0, 0]]


def test_mjcf_keeps_all_digits(cart: Path) -> None:
    """MuJoCo's writer keeps six digits."""
    mass = "<inertial><mass>0.1234567890123</mass><pose>0.3333333333333 0 0 0 0 0</pose></inertial>"
    rotated = MODEL.replace("0 1 0 0 0 0", "0.7777777777777 0 0 0.1 0.2 0.3").replace("<xyz>0 1 0", "<xyz>1 2 3")
    limits = "<limit><lower>-1.1111111111111</lower></limit><dynamics><damping>0.123456789</damping></dynamics></axis>"
    cart.write_text(rotated.format(visuals=mass).replace("</axis>", limits))

    simulated = compile_world(
        load(str(cart), Diagnostics(), packages=Packages({}, start=cart)).world, Diagnostics()
    ).model
    converted = mujoco.MjModel.from_xml_string(run("convert", str(cart), "--to", "mjcf")[1])

    for name in ("body_mass", "body_ipos", "body_pos", "body_quat", "jnt_axis", "jnt_range"):
        assert getattr(converted, name) == pytest.approx(getattr(simulated, name), rel=1e-14, abs=1e-15), name
    assert converted.dof_damping == pytest.approx(_damping(simulated), rel=1e-14, abs=1e-15)


def _simulated(file: Path) -> mujoco.MjModel:
    """Return the model that the simulation compiles from a file."""
    world = load(str(file), Diagnostics(), packages=Packages({}, start=file)).world
    return compile_world(world, Diagnostics()).model


def _damping(model: mujoco.MjModel) -> NDArray[np.float64]:
    """Return the damping of each degree of freedom, including the contact laws' part."""
    damping = model.dof_damping.copy()
    for dof, *_, part in find_table(model, "springs"):
        damping[int(dof)] += part
    return damping


@pytest.mark.slow
def test_mjcf_of_every_published_model_has_equal_bodies_and_joints(shared: Path) -> None:
    """Movable models of the database: equal bodies, joints and masses to 1e-9."""
    count = 0
    for path in sorted((shared / "corpus/repos/osrf+gazebo_models").glob("*/model.sdf")):
        packages = Packages({"GAZEBO_MODEL_PATH": str(path.parents[1])}, start=path)
        world = load(str(path), Diagnostics(), packages=packages).world
        simulated = compile_world(world, Diagnostics()).model
        if not simulated.nv:
            continue
        converted = mujoco.MjModel.from_xml_string(
            compile_mjcf(world, scene_from_world(flattened(world), Diagnostics()), Diagnostics())
        )
        moments = np.array([possible_moments((a, b, c)) for a, b, c in simulated.body_inertia])
        assert converted.body_inertia == pytest.approx(moments, rel=1e-9, abs=1e-11), path
        for name in ("body_mass", "body_pos", "body_quat", "jnt_axis", "jnt_range"):
            assert getattr(converted, name) == pytest.approx(getattr(simulated, name), rel=1e-9, abs=1e-11), (
                path,
                name,
            )
        assert converted.dof_damping == pytest.approx(_damping(simulated), rel=1e-9, abs=1e-11), path
        count += 1
    assert count > 100


def test_two_models_cannot_be_converted_to_urdf(cart: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cart.write_text("<sdf version='1.6'><world name='w'><model name='a'/><model name='b'/></world></sdf>")
    assert main(["convert", str(cart), "--to", "urdf"]) == 1
    assert "a URDF describes one robot, not 2 models" in capsys.readouterr().err


def test_an_unwritable_output_leaves_no_partial_file(cart: Path, tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    assert main(["convert", str(cart), "--to", "mjcf", "-o", str(tmp_path / "folder")]) == 1
    assert main(["convert", str(cart), "--to", "mjcf", "-o", str(tmp_path / "lost/cart.xml")]) == 1
    assert not list(tmp_path.rglob("*.part"))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "<stdin>:1: error: the file is empty"),
        ("<sdf", "<stdin>:1: error: not well-formed XML"),
        (f"<robot name='r' {XACRO}><xacro:arm/></robot>", "<stdin>:1: error: unknown macro name: xacro:arm"),
        ("<launch><node pkg='p' exec='e'/></launch>", "<stdin>:1: error: <node exec>: this is a launch file of ROS 2"),
    ],
)
def test_invalid_standard_input_is_an_error(text: str, message: str) -> None:
    code, printed = run("check", "-", stdin=text)
    assert code == 1
    assert message in printed


def test_a_launch_file_is_recognized_by_its_root(cart: Path) -> None:
    node = "<node pkg='topic_tools' type='relay' name='n'/>"
    text = f"\ufeff<?xml version='1.0'?>\n<!-- <robot> -->\n<launch>{node}</launch>"
    file = cart.parent / "robot.xml"
    file.write_text(text)
    summary = "a launch of 1 nodes with 0 parameters; no findings\n"

    assert run("check", "-", stdin=text) == (0, f"-: {summary}")
    assert run("check", str(file)) == (0, f"{file}: {summary}")


def test_xacro_from_standard_input_is_expanded_in_the_working_directory(cart: Path, tmp_path: Path) -> None:
    """Includes are found by both `check` and `convert`."""
    (tmp_path / "mass.xacro").write_text(f"<robot {XACRO}><xacro:property name='mass' value='2'/></robot>")
    link = "<link name='l'><inertial><mass value='${mass}'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>"
    text = f"<robot name='r' {XACRO}><xacro:include filename='mass.xacro'/>{link}</robot>"

    (model,) = json.loads(run("check", "-", "--json", stdin=text)[1])["models"]
    assert model["links"][0]["mass"] == 2.0
    assert '<mass value="2"' in run("convert", "-", "--to", "urdf", stdin=text)[1]


def test_a_glb_has_the_links_of_the_model_and_the_mesh_s_image(cart: Path, tmp_path: Path) -> None:
    assert run("convert", str(cart), "--to", "glb", "-o", "cart.glb") == (0, "")

    scene = trimesh.load_scene(tmp_path / "cart.glb")
    assert {"cart::base", "cart::wheel"} <= set(scene.graph.nodes)
    assert scene.graph["cart::wheel"][0][:3, 3] == pytest.approx([0.0, 0.0, -1.0])  # y up
    images = [geometry.visual.material.baseColorTexture for geometry in scene.geometry.values()]
    assert [image.size for image in images if image is not None] == [(1, 1)]


def test_a_glb_of_a_world_without_lights_has_default_lights(tmp_path: Path, cart: Path) -> None:
    (tmp_path / "w.world").write_text("<sdf version='1.6'><world name='w'/></sdf>")
    for file in ("w.world", str(cart)):
        run("convert", file, "--to", "glb", "-o", f"{Path(file).stem}.glb")

    assert b"KHR_lights_punctual" in (tmp_path / "w.glb").read_bytes()
    assert b"KHR_lights_punctual" not in (tmp_path / "model.glb").read_bytes()


def test_a_glb_is_written_to_a_pipe_but_not_to_a_terminal(
    cart: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    assert main(["convert", str(cart), "--to", "glb"]) == 0
    assert capfdbinary.readouterr().out[:4] == b"glTF"

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.stdout.isatty", lambda: True)
        assert main(["convert", str(cart), "--to", "glb"]) != 0

    out, err = capfdbinary.readouterr()
    assert (out, b"standard output is a terminal; name a file with -o" in err) == (b"", True)
