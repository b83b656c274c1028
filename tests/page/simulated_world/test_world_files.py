"""GLB files of worlds that change."""

from pathlib import Path

import pytest
from PIL import Image
from tests.manifests import empty_manifest
from tests.page.simulated_world.worlds import BOX, model, world
from tests.sim.gltf.glb import Glb

from trundle.base.diagnostics import Diagnostics
from trundle.page.simulated_world.world_builder import WorldBuilder
from trundle.page.simulated_world.world_files import NamedFiles, WorldFiles
from trundle.robots.description import load
from trundle.robots.model import World, flattened
from trundle.robots.packages import Packages

MESH = "<visual name='m'><geometry><mesh><uri>{}</uri></mesh></geometry></visual>"


def read(folder: Path, inside: str) -> World:
    (folder / "w.sdf").write_text(world(inside))
    return flattened(load(str(folder / "w.sdf"), Diagnostics(), packages=Packages({}, start=folder)).world)


def numbers(described: World) -> dict[str, int]:
    names = [f"{m.name}::{link.name}" for m in described.models for link in m.links]
    return {name: number for number, name in enumerate(names)}


def update(
    files: WorldFiles, described: World, bodies: dict[str, int] | None = None
) -> tuple[NamedFiles, dict[str, bytes]]:
    return files.update(described, (bodies or numbers(described)).__getitem__, Diagnostics())


def urls(named: NamedFiles) -> dict[str, str]:
    return {file.id: file.url for file in named.files}


def test_each_model_has_a_file_with_its_bodies(tmp_path: Path) -> None:
    described = read(tmp_path, model("a", BOX) + model("b", BOX))

    named, contents = update(WorldFiles(), described)

    assert list(urls(named)) == ["", "a", "b"]
    glb = Glb(contents[urls(named)["b"]])
    assert glb.nodes()["b::l"]["extras"] == {"body": 1}
    all_urls = {*urls(named).values(), named.collisions, *named.resources}
    assert all_urls == set(contents)
    uses = {f"world/{buffer['uri']}" for buffer in glb.tree["buffers"]}
    assert uses <= set(named.resources)


def test_a_spawned_model_adds_only_new_files(tmp_path: Path) -> None:
    files = WorldFiles()
    before, _ = update(files, read(tmp_path, model("a", BOX)))

    after, contents = update(files, read(tmp_path, model("a", BOX) + model("b", BOX)))

    assert urls(after)["a"] == urls(before)["a"]
    assert set(contents) == {urls(after)["b"], after.collisions} - {before.collisions}
    assert after.resources == before.resources


def test_files_of_a_deleted_model_are_sent_again_when_it_is_restored(tmp_path: Path) -> None:
    files = WorldFiles()
    both = read(tmp_path, model("a", BOX) + model("b", "<visual name='s'><geometry><sphere/></geometry></visual>"))
    first, _ = update(files, both)
    alone, contents = update(files, read(tmp_path, model("a", BOX)))
    assert list(urls(alone)) == ["", "a"]
    assert len(alone.resources) < len(first.resources)
    assert urls(first)["b"] not in contents

    again, contents = update(files, both)

    assert urls(again) == urls(first)
    assert {urls(first)["b"], *set(first.resources) - set(alone.resources)} <= set(contents)


def test_a_changed_color_makes_a_new_file_of_that_model(tmp_path: Path) -> None:
    files = WorldFiles()
    red = BOX.replace("</visual>", "<material><diffuse>1 0 0 1</diffuse></material></visual>")
    before, _ = update(files, read(tmp_path, model("a", BOX) + model("b", BOX)))

    after, contents = update(files, read(tmp_path, model("a", red) + model("b", BOX)))

    changed = {name for name, url in urls(after).items() if urls(before)[name] != url}
    assert changed == {"a"}
    assert set(contents) == {urls(after)["a"]}


def test_a_changed_light_makes_a_new_file_of_the_lights(tmp_path: Path) -> None:
    files = WorldFiles()
    light = '<light name="sun" type="directional"><diffuse>{} 1 1 1</diffuse></light>'
    before, _ = update(files, read(tmp_path, light.format(1) + model("a", BOX)))

    after, contents = update(files, read(tmp_path, light.format(0.5) + model("a", BOX)))

    assert {name for name, url in urls(after).items() if urls(before)[name] != url} == {""}
    (light_of,) = Glb(contents[urls(after)[""]]).tree["extensions"]["KHR_lights_punctual"]["lights"]
    assert light_of["extras"]["sdf"]["diffuse"][0] == 0.5


@pytest.mark.parametrize(("inside", "count"), [("", 1), ('<light name="torch" type="point"/>', 0)])
def test_a_world_without_lights_gets_the_cameras_default_lights(tmp_path: Path, inside: str, count: int) -> None:
    named, contents = update(WorldFiles(), read(tmp_path, model("a", inside)))

    tree = Glb(contents[urls(named)[""]]).tree

    assert len(tree.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])) == count


def test_models_with_the_same_mesh_and_image_share_files(tmp_path: Path) -> None:
    Image.new("RGB", (2, 2), (1, 2, 3)).save(tmp_path / "i.png")
    (tmp_path / "m.mtl").write_text("newmtl m\nmap_Kd i.png\n")
    (tmp_path / "m.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    )
    inside = MESH.format("m.obj")

    named, contents = update(WorldFiles(), read(tmp_path, model("a", inside) + model("b", inside)))

    suffixes = sorted(Path(url).suffix for url in named.resources)
    assert suffixes == [".bin", ".png"]
    (image,) = (content for url, content in contents.items() if url.endswith(".png"))
    assert image == (tmp_path / "i.png").read_bytes()


def test_collisions_of_all_models_are_in_one_file(tmp_path: Path) -> None:
    box = '<collision name="c"><geometry><box/></geometry></collision>'

    named, contents = update(WorldFiles(), read(tmp_path, model("a", box) + model("b", box)))

    nodes = Glb(contents[named.collisions]).tree["nodes"]
    assert [node["extras"].get("visual") for node in nodes if "mesh" in node] == ["c", "c"]


def test_roads_are_drawn_once(tmp_path: Path) -> None:
    road = "<road name='r'><width>2</width><point>0 0 0</point><point>5 0 0</point></road>"

    named, contents = update(WorldFiles(), read(tmp_path, road + model("a") + model("b")))

    drawn = [b'"name":"r"' in contents[url] for url in urls(named).values()]
    assert drawn == [False, True, False]


def test_the_builder_skips_replaced_worlds(tmp_path: Path) -> None:
    builder = WorldBuilder()
    for count in range(1, 6):
        described = read(tmp_path, "".join(model(f"m{i}", BOX) for i in range(count)))
        builder.build(described, empty_manifest(count), numbers(described))

    worlds = [builder.wait()]
    while worlds[-1].manifest.generation < 5:
        worlds.append(builder.wait())
    builder.close()

    served: set[str] = set()
    for built in worlds:  # each has the files that earlier ones did not
        named = {*(file.url for file in built.manifest.files), *built.manifest.resources}
        served |= set(built.files)
        assert named <= served
    assert len(worlds[-1].manifest.files) == 6


def test_a_shape_that_cannot_be_drawn_is_reported(tmp_path: Path) -> None:
    (tmp_path / "broken.obj").write_text("nothing")
    described = read(tmp_path, model("a", MESH.format("broken.obj")))
    builder = WorldBuilder()
    builder.build(described, empty_manifest(1), numbers(described))

    (warning,) = builder.wait().report.warnings
    builder.close()

    assert "no triangles; the shape is left out" in warning
