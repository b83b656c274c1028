"""Textures of URDF visuals: Gazebo ignores them, rviz and Trundle draw them."""

from pathlib import Path

import numpy as np
from PIL import Image

from trundle.app.cli import main
from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load, load_text, write_urdf, written_uri
from trundle.robots.model import GREY
from trundle.robots.packages import Packages

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
BOX = '<geometry><box size="1 1 1"/></geometry>'


def robot(folder: Path, *visuals: str) -> Path:
    """A URDF file with a green picture beside it."""
    Image.new("RGB", (4, 4), (0, 255, 0)).save(folder / "green.png")
    inside = "".join(f"<visual>{BOX}{visual}</visual>" for visual in visuals)
    file = folder / "r.urdf"
    file.write_text(
        f'<robot name="r"><material name="known"><texture filename="green.png"/></material>'
        f'<link name="base">{INERTIAL}{inside}</link></robot>'
    )
    return file


def test_a_texture_is_found_beside_the_file_and_by_the_name_of_its_material(tmp_path: Path) -> None:
    file = robot(
        tmp_path,
        '<material name="known"/>',
        '<material name="own"><color rgba="0.5 1 1 1"/><texture filename="green.png"/></material>',
        '<material name="lost"><texture filename="package://nowhere/x.png"/></material>',
    )
    report = Diagnostics()

    loaded = load(str(file), report, packages=Packages({}, start=tmp_path))

    by_name, beside_file, missing = (visual.material for visual in loaded.world.models[0].links[0].visuals)
    assert by_name.texture == beside_file.texture == tmp_path / "green.png"
    assert (by_name.diffuse, beside_file.diffuse) == ((1.0, 1.0, 1.0, 1.0), (0.5, 1.0, 1.0, 1.0))
    assert missing is GREY
    (warning,) = report.warnings
    assert "no package 'nowhere'" in warning
    assert warning.endswith("the texture is left out")
    assert any("Gazebo draws URDF textures grey" in finding.what for finding in report.findings)


def test_a_texture_is_drawn(tmp_path: Path) -> None:
    file, out = robot(tmp_path, '<material name="known"/>'), tmp_path / "r.png"

    assert main(["render", str(file), "-o", str(out), "--size", "60x40"]) == 0

    red, green, blue = np.asarray(Image.open(out).convert("RGB"))[20, 30].astype(int)
    assert green > max(red, blue) + 60


def test_a_texture_is_written_to_urdf(tmp_path: Path) -> None:
    packages = Packages({}, start=tmp_path)
    (model,) = load(str(robot(tmp_path, '<material name="known"/>')), Diagnostics(), packages=packages).world.models

    text = write_urdf(model, uri_of=written_uri, report=Diagnostics())

    again = load_text(text, name="again.urdf", folder=tmp_path, packages=packages, report=Diagnostics())
    assert again.world.models[0].links[0].visuals[0].material == model.links[0].visuals[0].material
