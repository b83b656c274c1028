"""Worlds of many bodies are built in batches, and compile to what a world built at once compiles to."""

from pathlib import Path

import mujoco
import numpy as np
import pytest
import trimesh
from msgspec.structs import replace

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import World, flattened
from trundle.sim.physics import compile_mjcf, compile_world
from trundle.sim.physics.compile import body_batches
from trundle.sim.render import scene_from_world
from trundle.spatial import Pose

ROBOT = Path(__file__).parents[4] / "examples/rp2w"
PIECES = """<sdf version="1.6"><world name="w">
<model name="gate"><static>true</static><pose>0 5 0 0 0 0</pose><link name="l">{mesh}</link></model>
<model name="cart"><pose>3 0 1 0 0 0</pose><link name="l">{mesh}</link>
<link name="flag"><pose>0 0 1 0 0 0</pose><inertial><mass>0.1</mass></inertial></link>
<joint name="j" type="ball"><parent>l</parent><child>flag</child></joint></model>
<model name="pole"><pose>6 0 1 0 0 0.3</pose><link name="l"><inertial><mass>2</mass></inertial></link>
<joint name="foot" type="revolute"><parent>world</parent><child>l</child><axis><xyz>0 1 0</xyz></axis></joint></model>
</world></sdf>"""


def scene(folder: Path) -> World:
    """Robots between hollow meshes, some on the world's hinges."""
    trimesh.util.concatenate(
        [trimesh.creation.box((0.1, 1, 1)), trimesh.creation.torus(1.0, 0.1, major_sections=16, minor_sections=6)]
    ).export(folder / "gate.stl")
    mesh = f"<collision name='c'><geometry><mesh><uri>file://{folder}/gate.stl</uri></mesh></geometry></collision>"
    (folder / "w.world").write_text(PIECES.format(mesh=mesh))
    world, robots = trundle.load(str(folder / "w.world")).world, trundle.load(str(ROBOT)).world
    copies = [
        replace(model, name=f"{model.name}{i}", world_from_model=Pose((9.0 + 2 * i, 0.0, 0.0)))
        for i in range(3)
        for model in robots.models
        if not model.static
    ]
    return replace(world, models=(copies[0], *world.models, *copies[1:]))


def compiled(world: World) -> bytes:
    report = Diagnostics()
    model = compile_world(world, report).model
    assert not any("MuJoCo" in warning for warning in report.warnings)
    saved = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, saved)
    return saved.tobytes()


@pytest.mark.parametrize("bodies", [1, 10])
def test_batches_of_bodies_compile_to_the_same_bytes(
    bodies: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    world = scene(tmp_path)
    at_once = compiled(world)
    monkeypatch.setattr(body_batches, "_MANY", bodies)
    assert compiled(world) == at_once
    assert capfd.readouterr() == ("", "")


def test_batches_of_bodies_export_to_the_same_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world = flattened(scene(tmp_path))
    drawn = scene_from_world(world, Diagnostics())
    at_once = mujoco.MjModel.from_xml_string(compile_mjcf(world, drawn, Diagnostics()))
    monkeypatch.setattr(body_batches, "_MANY", 5)
    in_batches = mujoco.MjModel.from_xml_string(compile_mjcf(world, drawn, Diagnostics()))
    assert in_batches.names == at_once.names
    for numbers in ("body_pos", "body_mass", "body_parentid", "geom_size", "geom_rgba", "mesh_vert", "jnt_axis"):
        assert np.array_equal(getattr(in_batches, numbers), getattr(at_once, numbers))
