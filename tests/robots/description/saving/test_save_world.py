"""A world that was changed while it ran, saved into its own XML, read again."""

from pathlib import Path

import pytest
from msgspec.structs import replace

import trundle
from trundle.page import EditAction, SetFriction, SetLight, SetMass, SetPhysics, SetPose
from trundle.page.simulated_world.current_world import current_world
from trundle.page.simulated_world.edits import edit
from trundle.robots.description import SavedWorld, save_world
from trundle.robots.model import Light, World
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation

BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
ARM = f"""<model name="arm"><pose>5 0 0 0 0 0</pose><link name="base"><collision name="c">{BOX}</collision></link>
      <link name="upper"><pose>0 0 1 0 0 0</pose></link>
      <joint name="root" type="fixed"><parent>world</parent><child>base</child></joint>
      <joint name="hinge" type="revolute"><parent>base</parent><child>upper</child><axis><xyz>0 1 0</xyz></axis></joint>
    </model>"""
WORLD = f"""<?xml version="1.0"?>
<!-- about the file -->
<sdf version="1.6">
  <world name="yard">
    <gravity>0 0 0</gravity>
    <!-- the crate is heavy -->
    <model name="crate">
      <pose>1 2 3 0 0 0</pose>
      <made_by>a person</made_by>
      <link name="body">
        <inertial><mass>2</mass></inertial> <!-- as weighed -->
        <collision name="c">{BOX}</collision>
      </link>
    </model>
    <include><uri>model://ball</uri><pose>0 0 4 0 0 0</pose></include>
    <include><name>other</name><uri>model://ball</uri></include>
    <light name="lamp" type="point"><diffuse>1 1 1 1</diffuse></light>
    {ARM}
  </world>
</sdf>
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    file = tmp_path / "yard.sdf"
    file.write_text(WORLD)
    return file


def _saved(simulation: Simulation, file: Path, *edits: EditAction) -> SavedWorld:
    for change in edits:
        edit(change, simulation)
    return save_world(current_world(simulation), file=file, packages=Packages({}, start=file.parent))


def _reread(saved: SavedWorld, file: Path) -> World:
    file.write_bytes(saved.sdf)
    return trundle.load(str(file)).world


def test_an_unchanged_world_is_saved_as_the_same_text(file: Path) -> None:
    assert _saved(trundle.load(str(file)), file).sdf.decode() == WORLD


def test_comments_and_unknown_elements_stay(file: Path) -> None:
    mass = SetMass("crate", "body", 4.0)
    move = SetPose("crate", "body", (0.0, 0.0, 8.5), (1.0, 0.0, 0.0, 0.0))
    saved = _saved(trundle.load(str(file)), file, mass, move)

    text = saved.sdf.decode()
    assert saved.lost == ()
    assert "<made_by>a person</made_by>" in text
    for comment in ("<!-- about the file -->", "<!-- the crate is heavy -->", "<!-- as weighed -->"):
        assert comment in text
    world = _reread(saved, file)
    (crate,) = (model for model in world.models if model.name == "crate")
    assert crate.world_from_model.position == (0.0, 0.0, 8.5)
    assert crate.link("body").inertial.mass == 4.0


def test_an_included_model_that_moves_stays_included(file: Path) -> None:
    saved = _saved(trundle.load(str(file)), file, SetPose("other", "link", (3.0, 0.0, 1.0), (1.0, 0.0, 0.0, 0.0)))

    assert saved.sdf.decode().count("<uri>model://ball</uri>") == 2
    (other,) = (model for model in _reread(saved, file).models if model.name == "other")
    assert other.world_from_model.position == (3.0, 0.0, 1.0)


def test_an_included_model_whose_mass_changes_is_written_out(file: Path) -> None:
    """The file on the model path stays as it is."""
    saved = _saved(trundle.load(str(file)), file, SetMass("other", "link", 7.0))

    assert saved.lost == ()
    models = {model.name: model for model in _reread(saved, file).models}
    assert models["other"].links[0].inertial.mass == 7.0
    assert models["ball"].links[0].inertial.mass != 7.0


def test_physics_light_friction_and_a_deleted_model(file: Path) -> None:
    simulation = trundle.load(str(file))
    simulation.delete("ball")

    saved = _saved(
        simulation,
        file,
        SetPhysics(gravity=(0.0, 1.0, -2.0), wind=(3.0, 0.0, 0.0), step=0.004),
        SetLight("lamp", (0.5, 0.25, 0.125), 2.0),
        SetFriction("crate", "body", 0.25, 0.5),
    )

    world = _reread(saved, file)
    assert (world.physics.gravity, world.wind) == ((0.0, 1.0, -2.0), (3.0, 0.0, 0.0))
    assert world.physics.max_step_size_s == 0.004
    lamp: Light = world.lights[0]
    assert (lamp.diffuse, lamp.intensity) == ((0.5, 0.25, 0.125, 1.0), 2.0)
    surface = world.models[0].links[0].collisions[0].surface
    assert (surface.mu, surface.mu2) == (0.25, 0.5)
    assert [model.name for model in world.models] == ["crate", "other", "arm"]
    assert saved.lost == ()


def test_a_saved_world_keeps_joint_positions(file: Path) -> None:
    simulation = trundle.load(str(file))
    simulation["arm"].joint("hinge").set_position(0.7)
    saved = _saved(simulation, file)

    file.write_bytes(saved.sdf)
    again = trundle.load(str(file))
    assert saved.lost == ()
    assert again["arm"].joint("hinge").position == pytest.approx(0.7, abs=1e-9)
    again.reset()
    assert again["arm"].joint("hinge").position == pytest.approx(0.7, abs=1e-9)


def test_spawned_models_are_saved_as_an_include_or_a_copy(file: Path, tmp_path: Path) -> None:
    """A model of the path by its name, another one as it is written; a second save changes nothing more."""
    model_file = tmp_path / "own.sdf"
    model_file.write_text(
        '<sdf version="1.6"><!-- outside --><model name="own"><!-- mine --><link name="l"/></model></sdf>'
    )
    simulation = trundle.load(str(file))
    for source, name in (("model://ball", "third"), (str(model_file), "own")):
        (model,) = (m for m in trundle.load(source).world.models if not m.added)
        simulation.spawn(replace(model, name=name))
    saved = _saved(simulation, file)

    text = saved.sdf.decode()
    assert saved.lost == ()
    assert "<name>third</name>" in text
    assert "<!-- mine -->" in text
    file.write_bytes(saved.sdf)
    assert _saved(trundle.load(str(file)), file).sdf == saved.sdf


def test_a_robot_alone_becomes_a_world(tmp_path: Path) -> None:
    urdf = tmp_path / "robot.urdf"
    urdf.write_text('<robot name="post"><link name="base"><inertial><mass value="3"/><inertia ixx="1" ixy="0" ixz="0" '
                    'iyy="1" iyz="0" izz="1"/></inertial></link></robot>')  # fmt: skip
    saved = _saved(trundle.load(str(urdf)), tmp_path / "post.sdf", SetPhysics(gravity=(0.0, 0.0, -1.0)))

    world = _reread(saved, tmp_path / "post.sdf")
    assert saved.lost == ()
    assert "<uri>model://ground_plane</uri>" in saved.sdf.decode()
    assert sorted(model.name for model in world.models) == ["ground_plane", "post"]
    assert world.physics.gravity == (0.0, 0.0, -1.0)


def test_files_beside_the_world_are_found_from_another_folder(tmp_path: Path) -> None:
    (tmp_path / "worlds").mkdir()
    (tmp_path / "worlds" / "part.stl").write_bytes(_stl())
    mesh = "<geometry><mesh><uri>part.stl</uri></mesh></geometry>"
    file = tmp_path / "worlds" / "w.sdf"
    model = f'<model name="m"><static>1</static><link name="l"><visual name="v">{mesh}</visual></link></model>'
    file.write_text(f'<sdf version="1.6"><world name="w">{model}</world></sdf>')
    saved = _saved(trundle.load(str(file)), tmp_path / "saved.sdf", SetPhysics(gravity=(0.0, 0.0, -1.0)))

    assert "<uri>worlds/part.stl</uri>" in saved.sdf.decode()
    assert saved.lost == ()


def test_another_model_posed_relative_to_a_moved_one_stays(tmp_path: Path) -> None:
    file = tmp_path / "w.sdf"
    file.write_text("""<sdf version="1.7"><world name="w"><gravity>0 0 0</gravity>
      <model name="a"><pose degrees="true">1 0 0 0 0 90</pose><link name="l"/></model>
      <model name="b"><pose relative_to="a">1 0 0 0 0 0</pose><link name="l"/></model></world></sdf>""")
    saved = _saved(trundle.load(str(file)), file, SetPose("a", "l", (0.0, 0.0, 5.0), (1.0, 0.0, 0.0, 0.0)))

    poses = [model.world_from_model.position for model in _reread(saved, file).models]
    assert poses == [(0.0, 0.0, 5.0), pytest.approx((1.0, 1.0, 0.0))]


def _stl() -> bytes:
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet"
    return f"solid p\n{facet}\nendsolid p\n".encode()
