"""Ogre material scripts: published and malformed ones."""

from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import load
from trundle.robots.description.ogre.script import parse_script
from trundle.robots.description.ogre.surface import OgreSurface, name_of, parent_of, read_surface
from trundle.robots.model import GREY, Material
from trundle.robots.packages import Packages

PLAIN = """
// the plain one
material Box/Plain
{
  receive_shadows on
  technique {
    pass
    {
      ambient 0.1 0.2 0.3
      diffuse 0.4 0.5 0.6 0.7
      specular 0.8 0.9 1.0 64   // shininess, not opacity
      texture_unit { texture wood.png
        scale 5 5 }
    }
  }
}
material "Box/Two words" : Box/Plain { technique { pass { diffuse 2 0 0  } } } /* technique
of
its own */
abstract material Box/Never { }
"""


def surfaces(text: str) -> dict[str, OgreSurface]:
    blocks = {name_of(b): b for b in parse_script(text, name="a.material").blocks if b.header[0] == "material"}
    return {name: read_surface(name, blocks) for name in blocks}


def sdf(tmp_path: Path, script: str, *, extra: str = "") -> tuple[Material, Diagnostics]:
    """A visual with that <script>, beside a folder of scripts and one of textures."""
    for name, text in {"scripts/box.material": PLAIN, "textures/wood.png": "png", "m/more.material": "{"}.items():
        path = tmp_path / "materials" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    file = tmp_path / "model.sdf"
    material = f"<material><script>{script}</script>{extra}</material>"
    visual = f"<visual name='v'><geometry><box><size>1 1 1</size></box></geometry>{material}</visual>"
    file.write_text(f"<sdf version='1.6'><model name='m'><link name='l'>{visual}</link></model></sdf>")
    report = Diagnostics()
    loaded = load(str(file), report, packages=Packages({"HOME": "/nobody"}, start=file))
    return loaded.world.models[0].links[0].visuals[0].material, report


def test_colors_come_from_the_first_pass() -> None:
    surface = surfaces(PLAIN)["Box/Plain"]
    assert surface.ambient == (0.1, 0.2, 0.3, 1.0)
    assert surface.diffuse == (0.4, 0.5, 0.6, 0.7)
    assert surface.specular == (0.8, 0.9, 1.0, 1.0)
    assert surface.emissive == (0.0, 0.0, 0.0, 1.0)
    assert surface.texture == "wood.png"
    assert surface.texture_scale == (5.0, 5.0)


def test_a_child_inherits_what_it_does_not_override() -> None:
    surface = surfaces(PLAIN)["Box/Two words"]
    assert surface.diffuse == (1.0, 0.0, 0.0, 1.0)
    assert surface.ambient == (0.1, 0.2, 0.3, 1.0)
    assert surface.texture == "wood.png"


def test_a_child_may_swap_the_texture_by_its_alias() -> None:
    text = """
    material A { technique { pass { texture_unit skin { texture a.png } } } }
    material B : A { set_texture_alias skin b.png }
    """
    assert surfaces(text)["B"].texture == "b.png"
    assert surfaces(text)["A"].texture == "a.png"


def test_cyclic_inheritance_is_stopped() -> None:
    text = "material A : B { technique { pass { diffuse 0 0 0 } } }\nmaterial B : A { }"
    assert surfaces(text)["B"].diffuse == (0.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize("text", ["material A {", "}", "{ }", "material A { } }", "a { " * 17])
def test_braces_that_do_not_match_are_named_with_their_line(text: str) -> None:
    with pytest.raises(DescriptionError, match=r"^a\.material:2: error: "):
        parse_script("\n" + text, name="a.material")


@given(st.text(alphabet='material A:{}"/*\n\t 01.', max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        blocks = parse_script(text, name="a.material").blocks
    except DescriptionError:
        return
    for block in blocks:
        parent_of(block)
        read_surface(name_of(block), {name_of(block): block})


@pytest.mark.parametrize(
    "uris",
    [
        "<uri>file://materials/scripts/box.material</uri>",
        "<uri>materials/scripts</uri>",
        "<uri>materials/scripts</uri><uri>materials/textures</uri>",
    ],
)
def test_a_visual_takes_colors_and_texture_from_the_script_it_names(tmp_path: Path, uris: str) -> None:
    material, report = sdf(tmp_path, f"{uris}<name>Box/Plain</name>")

    assert material.diffuse == (0.4, 0.5, 0.6, 0.7)
    assert material.texture == tmp_path / "materials/textures/wood.png"
    assert material.texture_scale == (5.0, 5.0)
    assert report.findings == []


def test_colors_of_the_visual_override_the_script(tmp_path: Path) -> None:
    material, _ = sdf(
        tmp_path, "<uri>materials/scripts</uri><name>Box/Plain</name>", extra="<diffuse>1 1 1 1</diffuse>"
    )
    assert material.diffuse == (1.0, 1.0, 1.0, 1.0)
    assert material.texture is not None


def test_a_script_that_cannot_be_read_is_named_and_the_rest_goes_on(tmp_path: Path) -> None:
    uris = "<uri>materials/m</uri><uri>materials/lost</uri><uri>materials/scripts</uri>"
    material, report = sdf(tmp_path, f"{uris}<name>Box/Plain</name>")

    assert material.texture is not None
    first, second = report.warnings
    assert first.endswith(f"model.sdf:1: warning: no such file {tmp_path}/materials/lost; it is left out")
    assert "more.material:1: warning: '{' without a word before it" in second
    assert second.endswith("this material script is left out")


def test_the_albedo_map_of_pbr_is_used_and_the_rest_is_reported(tmp_path: Path) -> None:
    metal = "<metal><albedo_map>materials/textures/wood.png</albedo_map><roughness>1</roughness></metal>"
    material, report = sdf(tmp_path, "<uri>materials/scripts</uri><name>Box/Plain</name>", extra=f"<pbr>{metal}</pbr>")
    assert material.texture == tmp_path / "materials/textures/wood.png"
    assert (material.diffuse, material.texture_scale) == ((1.0, 1.0, 1.0, 1.0), (1.0, 1.0))
    assert [finding.what for finding in report.findings] == [
        "<pbr>: <roughness> is for other renderers; it is not drawn"
    ]

    lost = metal.replace("wood", "lost")
    material, report = sdf(tmp_path, "<name>Gazebo/Red</name>", extra=f"<pbr>{lost}</pbr><diffuse>0 1 0</diffuse>")
    assert (material.texture, material.diffuse) == (None, (0.0, 1.0, 0.0, 1.0))
    image = tmp_path / "materials/textures/lost.png"
    assert report.warnings[0].endswith(f": no such file {image}; the texture is left out")


def test_an_unknown_material_name_is_grey(tmp_path: Path) -> None:
    material, report = sdf(tmp_path, "<uri>materials/scripts</uri><name>Box/Lost</name>")
    assert material == GREY
    assert any("no material 'Box/Lost'; grey is used" in warning for warning in report.warnings)


def test_a_material_of_a_stand_in_is_missed_once(tmp_path: Path) -> None:
    """Worlds that Gazebo saved name the scripts and textures of the public models."""
    folders = "".join(f"<uri>model://cafe_table/materials/{name}/</uri>" for name in ("scripts", "textures"))
    material, report = sdf(tmp_path, f"{folders}<name>CafeTable/Wood</name>")
    assert material == GREY
    assert [warning.partition("warning: ")[2] for warning in report.warnings] == [
        "no material 'CafeTable/Wood'; grey is used"
    ]


def test_a_texture_that_is_not_there_is_named_at_the_scripts_line(tmp_path: Path) -> None:
    sdf(tmp_path, "<name>x</name>")
    (tmp_path / "materials/textures/wood.png").unlink()
    file = tmp_path / "model.sdf"
    file.write_text(file.read_text().replace("<name>x</name>", "<uri>materials/scripts</uri><name>Box/Plain</name>"))
    report = Diagnostics()

    load(str(file), report, packages=Packages({}, start=file))

    (warning,) = report.warnings
    assert "box.material:4: warning: no texture 'wood.png'" in warning


def test_scripts_of_a_resource_folder_are_found_without_a_uri(tmp_path: Path) -> None:
    media = tmp_path / "media/materials/scripts"
    media.mkdir(parents=True)
    (media / "own.material").write_text("material Own/Blue { technique { pass { diffuse 0 0 1 } } }")
    file = tmp_path / "robot.urdf"
    inertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
    visual = "<visual><geometry><sphere radius='1'/></geometry></visual>"
    link = f"<link name='l'><inertial><mass value='1'/>{inertia}</inertial>{visual}</link>"
    file.write_text(f"<robot name='r'>{link}<gazebo reference='l'><material>Own/Blue</material></gazebo></robot>")
    packages = Packages({"GAZEBO_RESOURCE_PATH": str(tmp_path)}, start=file)

    loaded = load(str(file), Diagnostics(), packages=packages)

    assert loaded.world.models[0].links[0].visuals[0].material.diffuse == (0.0, 0.0, 1.0, 1.0)


@pytest.mark.slow
def test_every_published_script_is_read(shared: Path) -> None:
    """All 71 scripts of the collection: names, parents and colors; none is refused."""
    count = 0
    for path in sorted((shared / "corpus/repos").rglob("*.material")):
        top = parse_script(path.read_text(errors="replace"), name=str(path))
        blocks = {name_of(block): block for block in top.blocks if block.header[0] == "material"}
        assert blocks, path
        for name in blocks:
            read_surface(name, blocks)
        count += len(blocks)
    assert count > 100
