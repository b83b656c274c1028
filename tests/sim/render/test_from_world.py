"""Scenes of worlds: shapes, poses and colors."""

from io import BytesIO
from pathlib import Path

import pytest
import trimesh
from msgspec.structs import replace
from PIL import Image
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.meshes import Mesh
from trundle.robots.model import (
    GREY,
    Box,
    Collision,
    Cone,
    Geometry,
    Heightmap,
    Light,
    Link,
    Material,
    MeshFile,
    Model,
    Polyline,
    SceneSettings,
    Sphere,
    TerrainLayer,
    Visual,
    World,
)
from trundle.sim.render import Intrinsics, Scene, scene_from_world
from trundle.spatial import Pose

AT = Source("w.sdf", 3)
RED = Material(diffuse=(1.0, 0.0, 0.0, 1.0))


def visual(name: str = "v", geometry: Geometry | None = None, **rest: object) -> Visual:
    default = Visual(name=name, geometry=geometry or Sphere(0.1), at=AT, material=RED)
    return replace(default, **rest)


def world(*visuals: Visual, lights: tuple[Light, ...] = ()) -> World:
    link = Link(name="l", at=AT, visuals=visuals)
    return World(name="w", at=AT, models=(Model(name="m", at=AT, links=(link,)),), lights=lights)


def drawn(*visuals: Visual) -> Scene:
    return scene_from_world(world(*visuals), Diagnostics(strict=True))


def test_bodies_are_the_links_of_all_models_in_file_order() -> None:
    def model(name: str, *links: str) -> Model:
        return Model(name=name, at=AT, links=tuple(Link(name=l_, at=AT, visuals=(visual(l_),)) for l_ in links))

    both = World(name="w", at=AT, models=(model("one", "b", "a"), model("two", "c")))
    scene = scene_from_world(both, Diagnostics(strict=True))
    assert scene.bodies == ("one::b", "one::a", "two::c")
    assert [(shape.name, shape.body) for shape in scene.shapes] == [("b", 0), ("a", 1), ("c", 2)]


def test_a_shape_has_the_visuals_geometry_pose_and_color() -> None:
    pose = Pose((1.0, 2.0, 3.0))
    (shape,) = drawn(visual(geometry=Box((1.0, 2.0, 3.0)), link_from_visual=pose)).shapes
    assert (shape.geometry, shape.body_from_shape, shape.rgba) == (Box((1.0, 2.0, 3.0)), pose, (1.0, 0.0, 0.0, 1.0))


def test_transparency_reduces_opacity_and_invisible_visuals_are_left_out() -> None:
    shapes = drawn(visual("half", transparency=0.5), visual("none", transparency=1.0)).shapes
    assert [(shape.name, shape.rgba[3]) for shape in shapes] == [("half", 0.5)]


def test_collision_shapes_can_be_drawn_instead() -> None:
    touched = Collision(name="c", geometry=Box((1.0, 1.0, 1.0)), at=AT, link_from_collision=Pose((0.0, 0.0, 1.0)))
    link = Link(name="l", at=AT, visuals=(visual(),), collisions=(touched,))
    described = World(name="w", at=AT, models=(Model(name="m", at=AT, links=(link,)),))
    (shape,) = scene_from_world(described, Diagnostics(strict=True), collisions=True).shapes
    assert (shape.name, shape.body_from_shape) == ("c", Pose((0.0, 0.0, 1.0)))
    assert shape.rgba[3] < 1.0


def test_a_directional_lights_direction_is_rotated_by_its_pose() -> None:
    down = Light(
        name="sun", type="directional", at=AT, world_from_light=Pose.from_rpy(0, 0, 9, 3.141592653589793, 0, 0)
    )
    scene = scene_from_world(world(lights=(down,)), Diagnostics(strict=True))
    assert scene.lights[0].direction == pytest.approx((0.0, 0.0, 1.0))


def test_lights_belong_to_the_world_or_to_links() -> None:
    lamp = Light(
        name="lamp",
        type="spot",
        at=AT,
        world_from_light=Pose((1.0, 2.0, 3.0)),
        diffuse=(1.0, 0.5, 0.0, 1.0),
        intensity=0.5,
        linear=0.25,
        range_m=7.0,
        outer_angle_rad=0.6,
        cast_shadows=True,
    )
    carrier = Link(name="l", at=AT, visuals=(visual(),), lights=(replace(lamp, type="point"),))
    described = World(name="w", at=AT, models=(Model(name="m", at=AT, links=(carrier,)),), lights=(lamp,))
    first, second = scene_from_world(described, Diagnostics(strict=True)).lights
    assert (first.kind, first.body, first.position, first.diffuse) == ("spot", None, (1, 2, 3), (0.5, 0.25, 0.0, 1.0))
    assert (first.attenuation, first.range_m, first.outer_angle_rad) == ((1.0, 0.25, 0.0), 7.0, 0.6)
    assert first.casts_shadows
    assert (second.kind, second.body) == ("point", 0)
    dark = replace(described, scene=SceneSettings(shadows=False))
    assert not scene_from_world(dark, Diagnostics()).lights[0].casts_shadows


def test_background_and_sky_come_from_the_world() -> None:
    sky = replace(world(), scene=SceneSettings(background=(0.1, 0.2, 0.3, 1.0)))
    assert scene_from_world(sky, Diagnostics()).background == (0.1, 0.2, 0.3, 1.0)
    assert scene_from_world(sky, Diagnostics()).sky is None
    assert scene_from_world(replace(world(), scene=SceneSettings(sky=True)), Diagnostics()).sky is not None


def mesh_file(folder: Path) -> MeshFile:
    """A red box of 2 m."""
    box = trimesh.creation.box(extents=(2.0, 2.0, 2.0))
    box.visual = TextureVisuals(material=PBRMaterial(baseColorFactor=[255, 0, 0, 255]))
    glb = trimesh.Scene(box).export(file_type="glb")
    assert isinstance(glb, bytes)
    (folder / "box.glb").write_bytes(glb)
    return MeshFile(path=folder / "box.glb", uri="model://m/box.glb")


def test_a_mesh_is_loaded_and_scaled(tmp_path: Path) -> None:
    (shape,) = drawn(visual(geometry=replace(mesh_file(tmp_path), scale=(0.5, 1.0, 2.0)))).shapes
    assert isinstance(shape.geometry, Mesh)
    assert shape.geometry.vertices.max(axis=0) == pytest.approx([0.5, 1.0, 2.0])


def test_a_mesh_has_its_files_color_unless_the_visual_has_a_material(tmp_path: Path) -> None:
    plain = Visual(name="plain", geometry=mesh_file(tmp_path), at=AT)
    blue = replace(plain, name="blue", material=Material(diffuse=(0.0, 0.0, 1.0, 1.0)))
    assert [shape.rgba[:3] for shape in drawn(plain, blue).shapes] == [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)]


def test_a_mesh_of_two_colors_is_two_shapes_unless_the_visual_has_a_material(tmp_path: Path) -> None:
    (tmp_path / "car.mtl").write_text("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n")
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    (tmp_path / "car.obj").write_text(f"mtllib car.mtl\n{corners}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n")
    plain = Visual(name="plain", geometry=MeshFile(path=tmp_path / "car.obj", uri="car.obj"), at=AT, transparency=0.5)
    assert [shape.rgba for shape in drawn(plain).shapes] == [(1.0, 0.0, 0.0, 0.5), (0.0, 0.0, 1.0, 0.5)]
    assert [shape.rgba[:3] for shape in drawn(replace(plain, material=RED)).shapes] == [(1.0, 0.0, 0.0)]


def test_a_missing_texture_is_reported(tmp_path: Path) -> None:
    (tmp_path / "car.mtl").write_text("newmtl a\nmap_Kd paint.png\n")
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
    (tmp_path / "car.obj").write_text(f"mtllib car.mtl\n{corners}usemtl a\nf 1/1 2/2 3/3\n")
    report = Diagnostics()
    scene_from_world(world(visual(geometry=MeshFile(path=tmp_path / "car.obj", uri="car.obj"))), report)
    (finding,) = report.findings
    assert str(finding).endswith(
        "car.obj: info: its texture 'paint.png' is not in the model's folder; a plain color is drawn [texture]"
    )


def test_an_unreadable_mesh_is_left_out_with_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()
    lost = MeshFile(path=tmp_path / "lost.dae", uri="model://m/lost.dae")
    scene = scene_from_world(world(visual("gone", lost), visual("here")), report)
    assert [shape.name for shape in scene.shapes] == ["here"]
    (warning,) = report.warnings
    assert warning.startswith("w.sdf:3: warning: ")
    assert warning.endswith("; the shape is left out")
    assert "lost.dae" in warning


def test_a_mesh_of_degenerate_triangles_is_reported(tmp_path: Path) -> None:
    (tmp_path / "lines.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 3 + "f 1 2 4\n")
    report = Diagnostics()
    scene = scene_from_world(world(visual(geometry=MeshFile(uri="lines.obj", path=tmp_path / "lines.obj"))), report)

    assert len(scene.shapes) == 1
    assert report.warnings == [
        "w.sdf:3: warning: lines.obj: 3 of its 4 triangles have no area; only the others are drawn"
    ]


def test_the_focal_length_equals_gazebo_ros() -> None:
    # camera_info of a 320 px wide camera of 1.047 rad in Gazebo: K[0] = 277.19.
    assert Intrinsics(width_px=320, height_px=240, horizontal_fov_rad=1.047).focal_px == pytest.approx(277.19, abs=0.01)


def test_cones_polylines_and_terrain_are_drawn(tmp_path: Path) -> None:
    Image.new("L", (5, 5), 255).save(tmp_path / "flat.png")
    terrain = Heightmap(path=tmp_path / "flat.png", uri="flat.png", size=(4.0, 4.0, 0.5), position=(0.0, 0.0, 1.0))
    square = Polyline((((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)),), 2.0)
    forms = (visual("cone", Cone(0.5, 1.0)), visual("tower", square), visual("hill", terrain))
    tops = {}
    for shape in drawn(*forms).shapes:
        assert isinstance(shape.geometry, Mesh)
        tops[shape.name] = shape.geometry.vertices[:, 2].max()
    assert tops == pytest.approx({"cone": 0.5, "tower": 2.0, "hill": 1.5})


def test_terrain_has_its_texture_layers_by_height(tmp_path: Path) -> None:
    Image.linear_gradient("L").transpose(Image.Transpose.ROTATE_90).save(tmp_path / "ramp.png")
    for name, color in (("low", "red"), ("high", "lime")):
        Image.new("RGB", (8, 8), color).save(tmp_path / f"{name}.png")
    layers = (
        TerrainLayer(size=1.0, diffuse=tmp_path / "low.png"),
        TerrainLayer(size=1.0, diffuse=tmp_path / "high.png", from_height=1.0, fade=2.0),
        TerrainLayer(diffuse=tmp_path / "ramp.png.txt", from_height=0.0),
    )
    ramp = Heightmap(path=tmp_path / "ramp.png", uri="ramp.png", size=(40.0, 40.0, 4.0), layers=layers)
    report = Diagnostics()
    (shape,) = scene_from_world(world(replace(visual("hill", ramp), material=GREY)), report).shapes

    assert isinstance(shape.texture, bytes)
    with Image.open(BytesIO(shape.texture)) as image:
        middle = image.height // 2
        samples = [image.getpixel((int(share * image.width), middle)) for share in (0.1, 0.5, 0.9)]
    assert samples[0] == (255, 0, 0)
    assert samples[1] == pytest.approx((127, 128, 0), abs=3)
    assert samples[2] == (0, 255, 0)
    assert report.warnings == [
        "w.sdf:3: warning: heightmap texture ramp.png.txt cannot be read: No such file or directory; "
        "the layer is left out"
    ]


def test_terrain_without_its_image_is_left_out_with_a_warning(tmp_path: Path) -> None:
    report = Diagnostics()
    lost = Heightmap(path=tmp_path / "lost.png", uri="file://lost.png")
    assert scene_from_world(world(visual("hill", lost)), report).shapes == ()
    (warning,) = report.warnings
    assert warning.startswith("w.sdf:3: warning: heightmap 'file://lost.png': ")
    assert warning.endswith("; it is not drawn")
