"""Mesh files of the four formats, and errors of invalid ones."""

import subprocess
import sys
from pathlib import Path

import collada
import numpy as np
import pytest
import trimesh
from collada import geometry, scene, source
from numpy.typing import NDArray

from trundle.robots import meshes
from trundle.robots.meshes import Mesh, MeshError, load_mesh

from .exporting import exported

SIZE = (0.4, 0.6, 0.8)
CENTRE = np.array([1.0, 2.0, 3.0])


def block() -> trimesh.Trimesh:
    """A box away from the origin, unlike along its three axes."""
    box_mesh = trimesh.creation.box(extents=SIZE)
    box_mesh.apply_translation(CENTRE)
    return box_mesh


def write_dae(path: Path, *, up: str = "Z_UP", metre: float = 1.0) -> None:
    """The same box as COLLADA, its numbers in units of `metre`."""
    document = collada.Collada()
    assert document.assetInfo is not None
    document.assetInfo.upaxis = up
    document.assetInfo.unitmeter = metre
    document.assetInfo.unitname = "unit"
    box = block()
    points = source.FloatSource("points", np.asarray(box.vertices).ravel(), ("X", "Y", "Z"))
    shape = geometry.Geometry(document, "block", "block", [points])
    inputs = source.InputList()
    inputs.addInput(0, "VERTEX", "#points")
    shape.primitives.append(shape.createTriangleSet(np.asarray(box.faces).ravel(), inputs, "none"))
    document.geometries.append(shape)
    node = scene.Node("node", children=[scene.GeometryNode(shape)])
    document.scenes.append(scene.Scene("scene", [node]))
    document.scene = document.scenes[0]
    with path.open("wb") as file:
        document.write(file)


def bounds(mesh: Mesh) -> NDArray[np.float64]:
    return np.array([mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)], dtype=np.float64)


def volume(mesh: Mesh) -> float:
    """Signed: positive where the faces look outwards."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]].astype(float) for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


EXPECTED = np.array([CENTRE - np.array(SIZE) / 2, CENTRE + np.array(SIZE) / 2])


def test_the_front_door_exports_in_order() -> None:
    names: list[str] = vars(meshes)["__all__"]
    assert names == sorted(names)
    assert all(hasattr(meshes, name) for name in names)


@pytest.mark.parametrize("suffix", [".stl", ".obj", ".STL"])
def test_a_file_without_an_up_axis_is_read_as_it_is(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"block{suffix}"
    path.write_bytes(exported(block(), suffix[1:].lower()))
    mesh = load_mesh(path)
    assert bounds(mesh) == pytest.approx(EXPECTED, abs=1e-6)
    assert volume(mesh) == pytest.approx(0.4 * 0.6 * 0.8, rel=1e-5)
    assert mesh.vertices.dtype == np.float32
    assert mesh.faces.dtype == np.int32


def test_an_stl_in_letters_is_read_too(tmp_path: Path) -> None:
    path = tmp_path / "block.stl"
    path.write_bytes(exported(block(), "stl_ascii"))
    assert bounds(load_mesh(path)) == pytest.approx(EXPECTED, abs=1e-6)
    path.write_text(path.read_text().upper())  # as some old CAD programs write it
    assert bounds(load_mesh(path)) == pytest.approx(EXPECTED, abs=1e-6)


def test_gltf_is_y_up_and_stands_upright_here(tmp_path: Path) -> None:
    path = tmp_path / "block.glb"
    path.write_bytes(exported(trimesh.Scene(block()), "glb"))
    x, y, z = EXPECTED.T
    upright = np.array([[x[0], -z[1], y[0]], [x[1], -z[0], y[1]]])
    mesh = load_mesh(path)
    assert bounds(mesh) == pytest.approx(upright, abs=1e-6)
    assert volume(mesh) > 0


@pytest.mark.parametrize("up", ["Z_UP", "Y_UP"])
def test_collada_is_z_up_whatever_its_up_axis_as_in_gazebo_and_rviz(tmp_path: Path, up: str) -> None:
    write_dae(tmp_path / "block.dae", up=up)
    assert bounds(load_mesh(tmp_path / "block.dae")) == pytest.approx(EXPECTED, abs=1e-6)


def test_collada_gives_the_length_of_its_unit(tmp_path: Path) -> None:
    write_dae(tmp_path / "cm.dae", metre=0.01)
    assert bounds(load_mesh(tmp_path / "cm.dae")) == pytest.approx(EXPECTED * 0.01, abs=1e-7)


def test_a_scale_stretches_along_the_axes(tmp_path: Path) -> None:
    path = tmp_path / "block.stl"
    path.write_bytes(exported(block(), "stl"))
    mesh = load_mesh(path)
    assert bounds(mesh.scaled((2.0, 1.0, 0.5))) == pytest.approx(EXPECTED * (2.0, 1.0, 0.5), abs=1e-6)
    assert mesh.scaled((1.0, 1.0, 1.0)) is mesh
    assert bounds(mesh) == pytest.approx(EXPECTED, abs=1e-6)


@pytest.mark.parametrize("scale", [(-1.0, 1.0, 1.0), (1.0, -1.0, 1.0), (-1.0, -1.0, -1.0), (-1.0, -1.0, 1.0)])
def test_a_mirrored_mesh_keeps_its_outside_outside(tmp_path: Path, scale: tuple[float, float, float]) -> None:
    path = tmp_path / "block.stl"
    path.write_bytes(exported(block(), "stl"))
    mirrored = load_mesh(path).scaled(scale)
    corners = EXPECTED * scale
    assert bounds(mirrored) == pytest.approx(np.array([corners.min(axis=0), corners.max(axis=0)]), abs=1e-6)
    assert volume(mirrored) == pytest.approx(0.4 * 0.6 * 0.8, rel=1e-5)


@pytest.mark.parametrize("suffix", [".dae", ".glb", ".obj"])
@pytest.mark.parametrize("scale", [(1.0, 1.0, 1.0), (-1.0, 2.0, 1.0)])
def test_a_ball_comes_with_the_normals_of_its_file(
    tmp_path: Path, suffix: str, scale: tuple[float, float, float]
) -> None:
    ball = trimesh.creation.icosphere(subdivisions=2, radius=0.5)
    path = tmp_path / f"ball{suffix}"
    assert ball.vertex_normals is not None
    options = {"include_normals": True} if suffix != ".dae" else {}
    path.write_bytes(exported(ball, suffix[1:], **options))
    mesh = load_mesh(path).scaled(scale)
    assert mesh.normals is not None
    unit_normals = mesh.normals / np.linalg.norm(mesh.normals, axis=2, keepdims=True)
    steep = mesh.vertices[mesh.faces] / np.square(scale)  # of an ellipsoid
    assert unit_normals == pytest.approx(steep / np.linalg.norm(steep, axis=2, keepdims=True), abs=0.02)


def test_normals_turn_with_their_faces_where_a_mesh_is_bent() -> None:
    ball = trimesh.creation.icosphere(subdivisions=1)
    vertices, faces = ball.vertices.astype(np.float32), ball.faces.astype(np.int32)
    assert Mesh(vertices, faces).with_vertices(vertices * 2).normals is None
    turn = trimesh.transformations.rotation_matrix(0.7, (1.0, 2.0, 3.0))[:3, :3].T.astype(np.float32)
    bent = Mesh(vertices, faces, normals=vertices[faces]).with_vertices(vertices @ turn)
    assert bent.normals == pytest.approx((vertices @ turn)[faces], abs=1e-5)
    flattened = Mesh(vertices, faces, normals=vertices[faces]).with_vertices(np.zeros_like(vertices))
    assert flattened.normals is not None
    assert not flattened.normals.any()


def test_files_without_normals_have_flat_faces(tmp_path: Path) -> None:
    for suffix in (".stl", ".glb", ".obj"):
        path = tmp_path / f"block{suffix}"
        path.write_bytes(exported(block(), suffix[1:].lower()))
        assert load_mesh(path).normals is None


def two_parts(path: Path) -> None:
    parts = trimesh.Scene()
    wheel = trimesh.creation.icosphere(subdivisions=1, radius=0.5)
    parts.add_geometry(block(), geom_name="hull", node_name="hull_node")
    parts.add_geometry(wheel, geom_name="wheel", transform=trimesh.transformations.translation_matrix([9.0, 0.0, 0.0]))
    path.write_bytes(exported(parts, "glb"))


def test_parts_are_joined_where_the_file_places_them(tmp_path: Path) -> None:
    two_parts(tmp_path / "cart.glb")
    mesh = load_mesh(tmp_path / "cart.glb")
    assert len(mesh.faces) == 12 + 80
    assert mesh.faces.max() == len(mesh.vertices) - 1
    assert bounds(mesh)[1, 0] == pytest.approx(9.5, abs=1e-5)


def test_one_part_can_be_asked_for_and_centred(tmp_path: Path) -> None:
    two_parts(tmp_path / "cart.glb")
    hull = load_mesh(tmp_path / "cart.glb", submesh="hull")
    assert len(hull.faces) == 12
    centred = load_mesh(tmp_path / "cart.glb", submesh="hull", center=True)
    x, y, z = SIZE
    half = np.array([x, z, y]) / 2
    assert bounds(centred) == pytest.approx(np.array([-half, half]), abs=1e-6)


def test_a_part_that_is_not_there_is_answered_with_the_parts_there_are(tmp_path: Path) -> None:
    two_parts(tmp_path / "cart.glb")
    with pytest.raises(MeshError, match=r"cart\.glb: no part 'door'; parts: "):
        load_mesh(tmp_path / "cart.glb", submesh="door")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.stl", b"", "no triangles|not readable"),
        ("a.stl", b"\x00\xff garbage that is no mesh" * 9, r"declares \d+ triangles and contains 3"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\n", "no triangles|not readable"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "not readable"),
        ("a.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1 is at|not readable"),
        ("a.dae", b"<COLLADA>\n", "line 2: not well-formed XML: <COLLADA> of line 1 is not closed"),
        ("a.dae", b"", "line 1: the file is empty"),
        ("a.glb", b"glTF\x02\x00\x00\x00", "not a binary glTF, or truncated"),
        ("a.ply", b"ply", r"\.ply meshes are not supported; formats: \.dae, \.glb, \.obj, \.stl"),
        ("mesh", b"", "files without ending meshes are not supported"),
    ],
)
def test_a_file_that_cannot_be_used_is_one_sentence_that_names_it(
    tmp_path: Path, name: str, content: bytes, message: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(MeshError, match=message) as caught:
        load_mesh(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"lost\.stl: No such file"):
        load_mesh(tmp_path / "lost.stl")


def test_log_messages_of_trimesh_do_not_reach_the_user() -> None:
    # trimesh logs a traceback for each missing bump map.
    code = "import logging, trundle.robots.meshes.glb; logging.getLogger('trimesh').warning('no texture')"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    assert (done.stdout, done.stderr) == ("", "")


@pytest.mark.slow
def test_every_published_mesh_has_the_bounds_that_trimesh_gives_it(shared: Path) -> None:
    files = [
        path
        for folder in ("corpus/repos", "seeds")
        for path in sorted((shared / folder).rglob("*"))
        if path.suffix.lower() in (".dae", ".stl", ".obj", ".glb")
    ]
    assert len(files) > 150
    empty: list[str] = []
    for path in files:
        expected = trimesh.load_scene(str(path), process=False)
        if not expected.geometry:
            with pytest.raises(MeshError, match="no triangles"):
                load_mesh(path)
            empty.append(path.name)
            continue
        scale = meshes_unit(expected.units) if path.suffix.lower() == ".dae" else 1.0
        assert bounds(load_mesh(path)) == pytest.approx(expected.bounds * scale, rel=1e-4, abs=1e-5), path
    assert empty == ["multi_joint_robot.dae"]


def meshes_unit(units: str | None) -> float:
    """trimesh hands COLLADA's unit on as the text `0.01 * meters`."""
    number, _, unit = (units or "").rpartition("*")
    return float(number) if number and unit.strip() == "meters" else 1.0
