"""Parts, colors and textures of mesh files, as Gazebo would draw them."""

import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
import trimesh.visual
from PIL import Image

from trundle.robots.meshes import MeshError, load_mesh

from .exporting import exported

TWO_NODES = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="cm" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="img"><init_from>paint.png</init_from></image></library_images>
<library_effects>
 <effect id="red-fx"><profile_COMMON><technique sid="t"><phong><diffuse><color>1 0 0 1</color></diffuse></phong>
 </technique></profile_COMMON></effect>
 <effect id="glass-fx"><profile_COMMON><technique sid="t"><phong><diffuse><color>0 0 1 1</color></diffuse>
  <transparent opaque="A_ONE"><color>1 1 1 0.25</color></transparent><transparency><float>1</float></transparency>
 </phong></technique></profile_COMMON></effect>
 <effect id="paint-fx"><profile_COMMON>
  <newparam sid="s"><surface type="2D"><init_from>img</init_from></surface></newparam>
  <newparam sid="m"><sampler2D><source>s</source></sampler2D></newparam>
  <technique sid="t"><phong><diffuse><texture texture="m" texcoord="UV"/></diffuse></phong></technique>
 </profile_COMMON></effect>
</library_effects>
<library_materials>
 <material id="red"><instance_effect url="#red-fx"/></material>
 <material id="glass"><instance_effect url="#glass-fx"/></material>
 <material id="paint"><instance_effect url="#paint-fx"/></material>
</library_materials>
<library_geometries><geometry id="quad-mesh" name="quad"><mesh>
 <source id="p"><float_array id="pa" count="12">0 0 0 100 0 0 100 100 0 0 100 0</float_array>
  <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
  <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
 <source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array>
  <technique_common><accessor source="#ua" count="4" stride="2"><param name="S" type="float"/>
  <param name="T" type="float"/></accessor></technique_common></source>
 <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
 <polylist material="symbol" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
  <input semantic="TEXCOORD" source="#u" offset="1" set="0"/><vcount>4</vcount><p>0 0 1 1 2 2 3 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
 <node id="n1" name="Body"><translate>200 0 0</translate>INSTANCE_1
  <node id="n2" name="Window"><scale>-1 1 1</scale>INSTANCE_2</node></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""


def collada(path: Path, first: str = "red", second: str = "glass") -> Path:
    """Two quads of a metre: one at x = 2, and one mirrored beside it."""

    def instance(material: str) -> str:
        bound = f'<instance_material symbol="symbol" target="#{material}"/>'
        return (
            f'<instance_geometry url="#quad-mesh"><bind_material><technique_common>{bound}'
            "</technique_common></bind_material></instance_geometry>"
        )

    path.write_text(TWO_NODES.replace("INSTANCE_1", instance(first)).replace("INSTANCE_2", instance(second)))
    return path


def normals(vertices: np.ndarray, faces: np.ndarray) -> np.ndarray:
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def test_collada_nodes_are_parts_with_the_materials_bound_to_them(tmp_path: Path) -> None:
    mesh = load_mesh(collada(tmp_path / "car.dae"))

    body, window = mesh.parts
    assert (body.name, body.rgba) == ("Body", (1.0, 0.0, 0.0, 1.0))
    assert (window.name, window.rgba) == ("Window", (0.0, 0.0, 1.0, 0.25))
    assert [(p.first_face, p.face_count) for p in mesh.parts] == [(0, 2), (2, 2)]
    assert mesh.vertices[:, 0].min() == pytest.approx(1.0)
    assert mesh.vertices[:, 0].max() == pytest.approx(3.0)


def test_a_mirrored_node_keeps_its_outside_outside(tmp_path: Path) -> None:
    mesh = load_mesh(collada(tmp_path / "car.dae"))

    assert (normals(mesh.vertices, mesh.faces)[:, 2] > 0).all()


def test_a_part_is_asked_for_by_its_nodes_name_as_in_gazebo(tmp_path: Path) -> None:
    path = collada(tmp_path / "car.dae")

    window = load_mesh(path, submesh="Window", center=True)

    assert window.rgba == (0.0, 0.0, 1.0, 0.25)
    assert window.vertices.min(axis=0) == pytest.approx([-0.5, -0.5, 0.0])
    assert len(load_mesh(path, submesh="quad").faces) == 4
    with pytest.raises(MeshError, match="no part 'Door'; parts: 'Body', 'Window'"):
        load_mesh(path, submesh="Door")


def test_a_textured_part_has_its_image_its_mean_color_and_where_it_goes(tmp_path: Path) -> None:
    folder = tmp_path / "meshes"
    folder.mkdir()
    Image.new("RGB", (4, 4), (255, 51, 0)).save(folder / "paint.png")

    mesh = load_mesh(collada(folder / "car.dae", first="paint"))

    body, window = mesh.parts
    assert body.texture == folder / "paint.png"
    assert body.rgba == pytest.approx((1.0, 0.2, 0.0, 1.0))
    assert window.texture is None
    assert body.tint == (1.0, 1.0, 1.0, 1.0)
    assert mesh.uv is not None
    assert mesh.uv.shape == (4, 3, 2)
    assert mesh.uv.dtype == np.float32
    corners = mesh.vertices[mesh.faces]
    assert mesh.uv[:2] == pytest.approx(corners[:2, :, :2] - (2.0, 0.0))  # the image lies on the quad as it is


def test_a_texture_is_looked_for_in_the_models_own_folders_and_nowhere_else(tmp_path: Path) -> None:
    meshes = tmp_path / "model/meshes"
    textures = tmp_path / "model/materials/textures"
    for folder in (meshes, textures):
        folder.mkdir(parents=True)
    path = collada(meshes / "car.dae", first="paint")
    Image.new("RGB", (1, 1)).save(tmp_path / "paint.png")
    path.write_text(path.read_text().replace("paint.png", "../../paint.png"))
    assert load_mesh(path).parts[0].texture is None

    Image.new("RGB", (1, 1)).save(textures / "paint.png")
    path.write_text(path.read_text() + " ")
    assert load_mesh(path).parts[0].texture == textures / "paint.png"


def test_an_image_that_cannot_be_decoded_leaves_a_grey(tmp_path: Path) -> None:
    (tmp_path / "paint.png").write_bytes(b"no image")
    assert load_mesh(collada(tmp_path / "car.dae", first="paint")).parts[0].rgba == (0.8, 0.8, 0.8, 1.0)


OBJ = """mtllib car.mtl
o Body
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
usemtl red
f 1/1 2/2 3/3 4
o Window
v 0 0 1
v 1 0 1
v 1 1 1
usemtl glass
f -3 -2 -1
l 1 2
"""
MTL = "newmtl red\nKd 1 0 0\n# glass\nnewmtl glass\nKd 0 0 1\nd 0.5\n"


def test_obj_objects_and_materials_are_parts(tmp_path: Path) -> None:
    (tmp_path / "car.obj").write_text(OBJ)
    (tmp_path / "car.mtl").write_text(MTL)

    mesh = load_mesh(tmp_path / "car.obj")

    assert [(p.name, p.face_count, p.rgba) for p in mesh.parts] == [
        ("Body", 2, (1.0, 0.0, 0.0, 1.0)),
        ("Window", 1, (0.0, 0.0, 1.0, 0.5)),
    ]
    window = load_mesh(tmp_path / "car.obj", submesh="Window")
    assert window.vertices[:, 2] == pytest.approx([1.0, 1.0, 1.0])


def test_obj_textures_follow_the_corners(tmp_path: Path) -> None:
    (tmp_path / "car.obj").write_text(OBJ.replace("3/3 4", "3/3"))
    (tmp_path / "car.mtl").write_text(MTL.replace("Kd 1 0 0", "map_Kd -s 1 1 1 paint.png"))
    Image.new("RGB", (1, 1), (0, 255, 0)).save(tmp_path / "paint.png")

    mesh = load_mesh(tmp_path / "car.obj")

    body, window = mesh.parts
    assert (body.texture, body.rgba, body.tint) == (tmp_path / "paint.png", (0.0, 1.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0))
    assert window.texture is None
    assert mesh.uv is not None
    assert mesh.uv[0] == pytest.approx(mesh.vertices[mesh.faces[0], :2])
    assert not mesh.uv[1:].any()
    mirrored = mesh.scaled((-1.0, 1.0, 1.0))
    assert mirrored.uv is not None
    assert mirrored.uv[0] == pytest.approx(mirrored.vertices[mirrored.faces[0], :2] * (-1.0, 1.0))


def test_obj_faces_without_normals_are_flat_beside_others_that_have_some(tmp_path: Path) -> None:
    path = tmp_path / "two.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nvn 1 0 0\no a\nf 1//1 2//2 3//-1\no b\nf 1 2 3\n")
    mesh = load_mesh(path)
    assert mesh.normals is not None
    assert mesh.normals.tolist() == [[[0, 0, 2], [1, 0, 0], [1, 0, 0]], [[0, 0, 0]] * 3]


def test_a_texture_of_a_library_is_tinted_by_its_diffuse_color(tmp_path: Path) -> None:
    (tmp_path / "car.obj").write_text(OBJ.replace("3/3 4", "3/3"))
    (tmp_path / "car.mtl").write_text("newmtl red\nmap_Kd paint.png\nKd 1 0.5 0\nd 0.5\n")
    Image.new("RGB", (1, 1), (255, 255, 255)).save(tmp_path / "paint.png")

    body = load_mesh(tmp_path / "car.obj").parts[0]

    assert body.rgba == body.tint == (1.0, 0.5, 0.0, 0.5)


def test_uv_are_kept_without_a_texture_as_the_description_may_bring_one(tmp_path: Path) -> None:
    mesh = load_mesh(collada(tmp_path / "car.dae"))

    assert mesh.uv is not None
    red, _ = mesh.split_by_material()
    assert red.uv is not None
    assert red.uv == pytest.approx(red.vertices[red.faces][..., :2] - (2.0, 0.0))


def test_a_material_library_elsewhere_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "car.mtl").write_text(MTL)
    (tmp_path / "a/car.obj").write_text(OBJ.replace("car.mtl", "../car.mtl"))

    assert [p.rgba for p in load_mesh(tmp_path / "a/car.obj").parts] == [None, None]


def test_a_mesh_is_cut_into_one_mesh_per_look(tmp_path: Path) -> None:
    mesh = load_mesh(collada(tmp_path / "car.dae"))

    red, blue = mesh.scaled((2.0, 1.0, 1.0)).split_by_material()

    assert (red.rgba, blue.rgba) == ((1.0, 0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.25))
    assert (len(red.vertices), len(red.faces)) == (4, 2)
    assert red.vertices[:, 0].max() == pytest.approx(6.0)
    assert mesh.split_by_material() is mesh.split_by_material()
    same = load_mesh(collada(tmp_path / "car.dae", second="red"))
    assert same.split_by_material() == (same,)


def test_a_texture_inside_a_glb_comes_with_the_mesh(tmp_path: Path) -> None:
    image = Image.new("RGB", (2, 2), (0, 102, 255))
    image.putpixel((0, 1), (255, 0, 0))  # lower left
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=image, baseColorFactor=(1.0, 1.0, 0.5, 1.0))
    box = trimesh.creation.box()
    uv = np.random.default_rng(1).random((8, 2))
    box.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    (tmp_path / "box.glb").write_bytes(exported(trimesh.Scene(box), "glb"))

    mesh = load_mesh(tmp_path / "box.glb")

    (part,) = mesh.parts
    assert isinstance(part.texture, bytes)
    with Image.open(io.BytesIO(part.texture)) as read:
        assert read.convert("RGB").getpixel((0, 1)) == (255, 0, 0)
        assert read.convert("RGB").getpixel((1, 1)) == (0, 102, 255)
    assert part.tint == pytest.approx((1.0, 1.0, 0.5, 1.0), abs=0.01)
    assert part.rgba == pytest.approx((0.25, 0.3, 0.375, 1.0), abs=0.01)
    assert mesh.uv is not None
    assert mesh.uv == pytest.approx(uv[box.faces], abs=1e-6)


def test_a_glb_whose_image_cannot_be_decoded_names_it_and_keeps_its_shape(tmp_path: Path) -> None:
    box = trimesh.creation.box()
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=Image.new("RGB", (64, 64)), name="paint")
    box.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=material)
    data = exported(trimesh.Scene(box), "glb")
    start = data.index(b"IDAT") + 6
    (tmp_path / "box.glb").write_bytes(data[:start] + b"\xff" * 8 + data[start + 8 :])

    mesh = load_mesh(tmp_path / "box.glb")

    assert len(mesh.faces) == 12
    assert mesh.parts[0].texture is None
    assert mesh.parts[0].missing_texture == "image inside, of material 'paint'"
