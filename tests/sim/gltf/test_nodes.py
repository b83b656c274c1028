"""Scenes as GLB, read by another program."""

import io
import math
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image
from tests.sim.gltf.glb import Glb

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.gltf import Document, add_scene, glb_from_scene
from trundle.sim.render import Scene, SceneLight, Shape
from trundle.spatial import Pose, quaternion_from_rpy, rows_from_poses

SOLIDS = {
    "box": Box((1.0, 2.0, 3.0)),
    "sphere": Sphere(0.5),
    "ellipsoid": Ellipsoid((1.0, 2.0, 0.5)),
    "cylinder": Cylinder(0.5, 2.0),
    "capsule": Capsule(0.5, 2.0),
}


def square(*, uv: bool = False, normals: bool = False) -> Mesh:
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    up = np.tile(np.array([0, 0, 2], dtype=np.float32), (2, 3, 1))
    return Mesh(corners, faces, uv=corners[faces][..., :2] if uv else None, normals=up if normals else None)


def scene_of(*shapes: Shape, bodies: int = 1, lights: tuple[SceneLight, ...] = ()) -> Scene:
    return Scene(bodies=tuple(f"m::l{i}" for i in range(bodies)), shapes=shapes, lights=lights)


def still(bodies: int) -> Any:
    return rows_from_poses([Pose()] * bodies)


def written(*shapes: Shape) -> Glb:
    return Glb(glb_from_scene(scene_of(*shapes), still(1)))


def test_trimesh_reads_shapes_at_their_poses() -> None:
    body = Pose((1.0, 2.0, 3.0), quaternion_from_rpy(0.3, -0.4, 1.2))
    local = Pose((0.1, 0.2, 0.3), quaternion_from_rpy(0.7, 0.1, -0.5))
    shape = Shape(name="v", body=1, geometry=square(), body_from_shape=local)
    data = glb_from_scene(scene_of(shape, bodies=2), rows_from_poses([Pose(), body]))

    loaded = trimesh.load_scene(io.BytesIO(data), file_type="glb", process=False)

    (node,) = loaded.graph.nodes_geometry
    transform, name = loaded.graph[node]
    vertices = np.asarray(loaded.geometry[name].vertices) @ transform[:3, :3].T + transform[:3, 3]
    z_up = vertices[:, [0, 2, 1]] * (1.0, -1.0, 1.0)
    expected = [(body @ local).transform_point((x, y, z)) for x, y, z in square().vertices.tolist()]
    assert z_up == pytest.approx(np.array(expected), abs=1e-6)


@pytest.mark.parametrize("name", SOLIDS)
def test_a_solid_is_closed_and_has_its_volume(name: str) -> None:
    data = glb_from_scene(scene_of(Shape(name="v", body=0, geometry=SOLIDS[name])), still(1))
    (mesh,) = trimesh.load_scene(io.BytesIO(data), file_type="glb").dump()
    glb = Glb(data)
    assert isinstance(mesh, trimesh.Trimesh)

    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    volumes = {
        "box": 6.0,
        "sphere": math.pi / 6,
        "ellipsoid": 4 / 3 * math.pi,
        "cylinder": math.pi / 2,
        "capsule": math.pi / 2 + math.pi / 6,
    }
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(volumes[name], rel=0.015)  # chords of 9° lie inside the circle
    corners = glb.attribute("v", "POSITION")[glb.triangles("v")]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = glb.attribute("v", "NORMAL")[glb.triangles("v")].sum(axis=1)
    assert (np.einsum("ij,ij->i", outward, normals) > 0).all()


def test_solids_of_one_kind_share_their_triangles() -> None:
    shapes = [Shape(name=f"v{i}", body=0, geometry=Box((1.0 + i, 1.0, 1.0))) for i in range(5)]

    glb = written(*shapes)

    assert len(glb.tree["meshes"]) == 1
    assert glb.nodes()["v3"]["scale"] == [4.0, 1.0, 1.0]


def test_equal_meshes_are_written_once_with_separate_materials() -> None:
    red, blue = (1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)
    glb = written(
        Shape(name="a", body=0, geometry=square(), rgba=red),
        Shape(name="b", body=0, geometry=square(), rgba=blue),
        Shape(name="c", body=0, geometry=square(), rgba=red),
    )

    nodes = glb.nodes()
    assert nodes["a"]["mesh"] == nodes["c"]["mesh"] != nodes["b"]["mesh"]
    assert len(glb.tree["accessors"]) == 2
    assert len(glb.tree["materials"]) == 2


def test_corners_with_different_values_are_separate_vertices() -> None:
    mesh = square(uv=True, normals=True)
    assert mesh.uv is not None
    mesh.uv[1] += 5.0  # a seam along the diagonal

    glb = written(Shape(name="v", body=0, geometry=mesh))

    corners = glb.triangles("v")
    assert len(glb.attribute("v", "POSITION")) == 6
    assert glb.attribute("v", "POSITION")[corners] == pytest.approx(mesh.vertices[mesh.faces])
    v_down = mesh.uv * (1.0, -1.0) + (0.0, 1.0)
    assert glb.attribute("v", "TEXCOORD_0")[corners] == pytest.approx(v_down)
    assert glb.attribute("v", "NORMAL") == pytest.approx(np.tile([0.0, 0.0, 1.0], (6, 1)))


def test_a_smooth_mesh_shares_its_vertices() -> None:
    glb = written(Shape(name="v", body=0, geometry=square(uv=True, normals=True)))

    assert len(glb.attribute("v", "POSITION")) == 4


def test_flat_faces_among_smooth_ones_get_their_own_normals() -> None:
    mesh = square(normals=True)
    assert mesh.normals is not None
    mesh.normals[1] = 0.0

    normals = written(Shape(name="v", body=0, geometry=mesh)).attribute("v", "NORMAL")

    assert normals == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(normals), 1)))


def test_names_and_numbers_of_links_and_visuals_are_kept() -> None:
    document = Document(embed=True)
    scene = scene_of(Shape(name="v", body=1, geometry=square(), casts_shadow=False), bodies=2)
    glb = Glb(document.glb(add_scene(document, scene, still(2), [7, 9])))

    root = glb.tree["nodes"][glb.tree["scenes"][0]["nodes"][0]]
    assert [glb.tree["nodes"][child]["name"] for child in root["children"]] == ["m::l0", "m::l1"]
    assert glb.nodes()["m::l1"]["extras"] == {"body": 9}
    assert glb.nodes()["v"]["extras"] == {"visual": "v", "casts_shadow": False}


def test_a_material_has_the_files_values_and_linear_ones() -> None:
    shape = Shape(
        name="v",
        body=0,
        geometry=square(),
        rgba=(0.5, 0.0, 1.0, 0.25),
        ambient=(0.1, 0.2, 0.3, 1.0),
        specular=(0.4, 0.4, 0.4, 1.0),
        emissive=(0.5, 0.0, 0.0, 1.0),
        shininess=30.0,
    )

    material = written(shape).material("v")

    assert material["extras"]["sdf"] == {
        "ambient": [0.1, 0.2, 0.3, 1.0],
        "diffuse": [0.5, 0.0, 1.0, 0.25],
        "specular": [0.4, 0.4, 0.4, 1.0],
        "emissive": [0.5, 0.0, 0.0, 1.0],
        "shininess": 30.0,
        "lighting": True,
    }
    half = 0.2140411  # sRGB's 0.5, IEC 61966-2-1
    assert material["pbrMetallicRoughness"]["baseColorFactor"] == pytest.approx([half, 0.0, 1.0, 0.25])
    assert material["emissiveFactor"] == pytest.approx([half, 0.0, 0.0])
    assert material["alphaMode"] == "BLEND"
    assert material["pbrMetallicRoughness"]["roughnessFactor"] == pytest.approx(0.5)


@pytest.mark.parametrize("format", ["PNG", "JPEG"])
def test_an_image_is_embedded_unchanged(format: str, tmp_path: Path) -> None:
    file = tmp_path / "image"
    Image.new("RGB", (4, 2), (10, 200, 30)).save(file, format)
    shapes = [Shape(name=name, body=0, geometry=square(uv=True), texture=file) for name in "ab"]

    glb = written(*shapes)

    (image,) = glb.tree["images"]
    assert glb.view(image["bufferView"]) == file.read_bytes()
    assert image["mimeType"] == f"image/{format.lower()}"


def test_an_image_of_another_format_becomes_png(tmp_path: Path) -> None:
    file = tmp_path / "image.bmp"
    Image.new("RGB", (3, 2), (10, 200, 30)).save(file)

    glb = written(Shape(name="v", body=0, geometry=square(uv=True), texture=file))

    with Image.open(io.BytesIO(glb.view(glb.tree["images"][0]["bufferView"]))) as image:
        assert (image.format, image.size, image.getpixel((0, 0))) == ("PNG", (3, 2), (10, 200, 30))


def test_an_unreadable_image_leaves_the_color(tmp_path: Path) -> None:
    (tmp_path / "broken.png").write_bytes(b"\x89PNG")
    shape = Shape(name="v", body=0, geometry=square(uv=True), texture=tmp_path / "broken.png")

    assert "baseColorTexture" not in written(shape).material("v")["pbrMetallicRoughness"]


def test_a_texture_scale_becomes_a_transform_about_the_centre(tmp_path: Path) -> None:
    Image.new("RGB", (1, 1)).save(tmp_path / "i.png")
    shape = Shape(name="v", body=0, geometry=square(uv=True), texture=tmp_path / "i.png", texture_scale=(0.5, 0.25))
    glb = written(shape)

    (transform,) = glb.material("v")["pbrMetallicRoughness"]["baseColorTexture"]["extensions"].values()

    assert glb.tree["extensionsUsed"] == ["KHR_texture_transform"]
    assert transform == {"offset": [-0.5, -1.5], "scale": [2.0, 4.0]}


def test_lights_shine_along_their_direction() -> None:
    spot = SceneLight(
        name="lamp",
        kind="spot",
        body=0,
        position=(1.0, 2.0, 3.0),
        direction=(0.6, 0.0, -0.8),
        diffuse=(1.0, 0.5, 0.0, 1.0),
        attenuation=(0.5, 0.1, 0.01),
        range_m=20.0,
        inner_angle_rad=0.4,
        outer_angle_rad=0.9,
        falloff=2.0,
        casts_shadows=True,
    )
    glb = Glb(glb_from_scene(scene_of(lights=(spot,)), still(1)))

    node = glb.nodes()["lamp"]
    (light,) = glb.tree["extensions"]["KHR_lights_punctual"]["lights"]
    x, y, z, w = node["rotation"]
    assert Pose(quaternion=(w, x, y, z)).transform_vector((0.0, 0.0, -1.0)) == pytest.approx((0.6, 0.0, -0.8))
    assert node["translation"] == [1.0, 2.0, 3.0]
    assert (light["type"], light["range"]) == ("spot", 20.0)
    assert light["spot"] == pytest.approx({"innerConeAngle": 0.2, "outerConeAngle": 0.45})
    assert light["extras"]["sdf"] == {
        "diffuse": [1.0, 0.5, 0.0, 1.0],
        "specular": [0.1, 0.1, 0.1, 1.0],
        "attenuation": [0.5, 0.1, 0.01],
        "cast_shadows": True,
        "spot": {"inner_angle": 0.4, "outer_angle": 0.9, "falloff": 2.0},
    }


def test_documents_share_files_of_equal_meshes_and_images(tmp_path: Path) -> None:
    Image.new("RGB", (1, 1)).save(tmp_path / "i.png")
    documents: list[Document] = []
    for name in "ab":
        document = Document(embed=False)
        shape = Shape(name=name, body=0, geometry=square(uv=True), texture=tmp_path / "i.png")
        root = add_scene(document, scene_of(shape), still(1), [0])
        tree = Glb(document.glb(root)).tree
        named = {buffer["uri"] for buffer in tree["buffers"]} | {image["uri"] for image in tree["images"]}
        assert named == set(document.files)
        documents.append(document)

    assert documents[0].files == documents[1].files
    assert sorted(Path(name).suffix for name in documents[0].files) == [".bin", ".png"]


@pytest.mark.slow
def test_khronos_validator_reports_no_errors(tmp_path: Path) -> None:
    """Every kind of shape, light and material through the Khronos glTF validator (`make system`)."""
    tools = Path(__file__).parents[3] / ".npm/node_modules"
    if not (tools / "gltf-validator").is_dir():
        pytest.skip("npm's gltf-validator is not installed (make system)")
    Image.new("RGB", (2, 2)).save(tmp_path / "i.png")
    texture = tmp_path / "i.png"
    shapes = [Shape(name=name, body=0, geometry=solid, texture=texture) for name, solid in SOLIDS.items()]
    shapes += [
        Shape(name="plane", body=0, geometry=Plane((0.0, 0.6, 0.8), (2.0, 3.0)), texture_scale=(0.5, 2.0)),
        Shape(name="ground", body=0, geometry=Plane((0.0, 0.0, 1.0), (0.0, 0.0)), texture=texture),
        Shape(name="glass", body=0, geometry=square(uv=True), rgba=(1.0, 1.0, 1.0, 0.2), texture=texture),
        Shape(name="flat", body=0, geometry=square(), emissive=(0.3, 0.0, 0.0, 1.0), texture=texture),
        Shape(name="tiled", body=0, geometry=square(uv=True), texture=texture, texture_scale=(0.5, 0.5)),
        Shape(name="thin", body=0, geometry=Box((1.0, 0.0, 1.0))),
    ]
    lights = tuple(SceneLight(name=kind, kind=kind, range_m=9.0) for kind in ("directional", "point", "spot"))
    (tmp_path / "all.glb").write_bytes(glb_from_scene(scene_of(*shapes, bodies=2, lights=lights), still(2)))
    code = (
        "require('gltf-validator').validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[1])))"
        ".then(r => console.log(r.issues.numErrors, r.issues.numWarnings, JSON.stringify(r.issues.messages)))"
    )

    result = subprocess.run(
        ["node", "-e", code, str(tmp_path / "all.glb")],
        env={"NODE_PATH": str(tools), "PATH": "/usr/bin:/usr/local/bin"},
        capture_output=True,
        text=True,
        check=True,
    )

    assert result.stdout.split()[:2] == ["0", "0"], result.stdout
