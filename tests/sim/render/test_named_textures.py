"""Textures of Gazebo's named materials."""

import hashlib
from pathlib import Path

import numpy as np
import pytest

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import write_sdf, written_uri
from trundle.robots.meshes import Mesh
from trundle.robots.model import TEXTURE_COLORS
from trundle.sim.render import scene_from_world
from trundle.sim.render.named_textures import texture_pixels
from trundle.sim.render.patterns import clouds, noise

WORLD = """<sdf version="1.6"><world name="w"><model name="m"><static>1</static><link name="l"><visual name="v">
<geometry>{}</geometry><material><script><name>{}</name></script>{}</material></visual></link></model></world></sdf>"""
BOX = "<box><size>1 1 1</size></box>"


def visual(folder: Path, geometry: str, material: str, more: str = ""):
    (folder / "w.sdf").write_text(WORLD.format(geometry, material, more))
    (shape,) = scene_from_world(trundle.load(str(folder / "w.sdf")).world, Diagnostics()).shapes
    return shape


@pytest.mark.parametrize("name", TEXTURE_COLORS)
def test_a_textures_mean_is_its_materials_color(name: str) -> None:
    mean = texture_pixels(name).reshape(-1, 3).mean(axis=0) / 255

    assert mean == pytest.approx(TEXTURE_COLORS[name], abs=0.02)
    assert texture_pixels(name).std() > 1.5


def test_generated_textures_equal_the_recorded_bytes() -> None:
    digest = hashlib.sha256(b"".join(texture_pixels(name).tobytes() for name in TEXTURE_COLORS)).hexdigest()

    assert digest == "6f74d12cfe9493ff1d6bc75621db643b43aa135fa75b14f011aa4dd31efd0bbf"


def test_noise_is_seamless() -> None:
    for field in (noise(3, 8, 4), clouds(5)):
        across = np.abs(np.diff(field, axis=1)).max()
        down = np.abs(np.diff(field, axis=0)).max()

        assert np.abs(field[:, 0] - field[:, -1]).max() <= across
        assert np.abs(field[0] - field[-1]).max() <= down
        assert field.min() >= 0
        assert field.max() <= 255


def test_noise_of_other_seeds_is_independent() -> None:
    first, second = noise(1, 32, 32).ravel(), noise(2, 32, 32).ravel()

    assert abs(np.corrcoef(first, second)[0, 1]) < 0.05


def test_a_box_shows_its_texture_tinted_by_its_colors(tmp_path: Path) -> None:
    plain = visual(tmp_path, BOX, "Gazebo/Bricks")
    tinted = visual(tmp_path, BOX, "Gazebo/Bricks", "<diffuse>0.5 1 1 1</diffuse>")

    assert isinstance(plain.texture, bytes)
    assert plain.rgba == (1.0, 1.0, 1.0, 1.0)
    assert tinted.texture is plain.texture
    assert tinted.rgba == (0.5, 1.0, 1.0, 1.0)


def test_a_mesh_without_uv_coordinates_has_the_color_only(tmp_path: Path) -> None:
    (tmp_path / "m.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    shape = visual(tmp_path, "<mesh><uri>m.obj</uri></mesh>", "Gazebo/Grass")

    assert isinstance(shape.geometry, Mesh)
    assert shape.texture is None
    assert shape.rgba == (*TEXTURE_COLORS["Gazebo/Grass"], 1.0)


def test_the_material_is_written_by_its_name(tmp_path: Path) -> None:
    (tmp_path / "w.sdf").write_text(WORLD.format(BOX, "Gazebo/Wood", ""))
    world = trundle.load(str(tmp_path / "w.sdf")).world

    text = write_sdf(world, is_world=True, uri_of=written_uri, report=Diagnostics())

    (tmp_path / "again.sdf").write_text(text)
    again = trundle.load(str(tmp_path / "again.sdf")).world
    assert "<name>Gazebo/Wood</name>" in text
    assert again.models[0].links[0].visuals[0].material == world.models[0].links[0].visuals[0].material
