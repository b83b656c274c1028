"""spawn_model's command line, in every distribution's form."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.gazebo.nodes.gazebo.spawn_arguments import SpawnRequest
from trundle.gazebo.nodes.gazebo.trimesh import trimesh_sdf
from trundle.robots.description import load
from trundle.robots.packages import Packages

_MESH = """solid s
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid s
"""
_TRIMESH = {"mass": "2", "ixx": "0.1", "iyy": "0.2", "izz": "0.3", "gravity": "false", "material": "Gazebo/Blue"}


def test_every_option_of_noetic_is_read() -> None:
    line = (
        "-urdf -param robot_description -model arm -reference_frame table -gazebo_namespace /g -robot_namespace r "
        "-unpause -wait table -x 1 -y=2 -z -0.5 -R .1 -P .2 -Y .3 -J a 1 -J b -2 -package_to_model -b"
    )
    request = SpawnRequest.read(line.split())

    assert (request.kind, request.source, request.is_old) == ("urdf", "-param", False)
    assert request.texts == {
        "-param": "robot_description",
        "-model": "arm",
        "-reference_frame": "table",
        "-gazebo_namespace": "/g",
        "-robot_namespace": "r",
        "-wait": "table",
    }
    assert request.pose.position == (1.0, 2.0, -0.5)
    assert request.joints == {"a": 1.0, "b": -2.0}
    assert request.flags == {"-unpause", "-package_to_model", "-b"}


def test_indigos_gazebo_option_is_sdf() -> None:
    request = SpawnRequest.read(["-gazebo", "-stdin", "-model", "cup", "-namespace", "r"])

    assert (request.kind, request.source, request.is_old) == ("sdf", "-stdin", True)
    assert request.texts["-robot_namespace"] == "r"


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("-urdf -gazebo -param p -model a", "-gazebo: the model is urdf already; give one of -urdf, -sdf"),
        ("-urdf -param p", "-model NAME is missing"),
        ("-urdf -param p -model", "-model needs a value"),
        ("-J a b -model a", "a number is needed: could not convert string to float: 'b'"),
        ("-model a -tint red", "no option '-tint'"),
    ],
)
def test_invalid_options_are_reported(line: str, reason: str) -> None:
    with pytest.raises(UsageError) as error:
        SpawnRequest.read(line.split())
    assert str(error.value) == reason


def test_a_mesh_is_a_model_of_one_link(tmp_path: Path) -> None:
    mesh = tmp_path / "a cup.stl"
    mesh.write_text(_MESH)
    line: list[str] = ["-trimesh", "-file", str(mesh), "-model", "cup", "-trimesh_name", "body"]
    for option, value in _TRIMESH.items():
        line += [f"-trimesh_{option}", value]
    request = SpawnRequest.read(line)

    (tmp_path / "cup.sdf").write_text(trimesh_sdf(request.texts["-file"], request.trimesh))
    report = Diagnostics()
    [model] = load(str(tmp_path / "cup.sdf"), report, packages=Packages({}, start=tmp_path)).world.models
    [link] = model.links
    assert (link.name, link.gravity, link.inertial.mass) == ("body", False, 2.0)
    assert link.inertial.moments == (0.1, 0.2, 0.3)
    assert [type(shape.geometry).__name__ for shape in (*link.collisions, *link.visuals)] == ["MeshFile", "MeshFile"]
    assert not report.warnings


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"mass": "heavy"}, "-trimesh_mass: a number is needed, got 'heavy'"),
        ({"gravity": "maybe"}, "-trimesh_gravity must be true or false, got 'maybe'"),
        ({"tint": "red"}, "no option '-trimesh_tint'"),
    ],
)
def test_invalid_mesh_options_are_reported(tmp_path: Path, change: dict[str, str], reason: str) -> None:
    mesh = tmp_path / "cup.stl"
    mesh.write_text(_MESH)
    with pytest.raises(UsageError) as error:
        trimesh_sdf(str(mesh), {**_TRIMESH, "name": "body", **change})
    assert str(error.value) == reason


def test_a_mesh_requires_all_its_options(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="-trimesh needs -trimesh_gravity, -trimesh_material, -trimesh_name"):
        trimesh_sdf(str(tmp_path), dict.fromkeys(("mass", "ixx", "iyy", "izz"), "1"))
