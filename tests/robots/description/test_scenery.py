"""Saved states, populations, roads and actors of a world."""

import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load, load_text, write_sdf, written_uri
from trundle.robots.description.sdf.kmeans import kmeans_centers
from trundle.robots.model import Box, Cylinder, World
from trundle.robots.packages import Packages
from trundle.sim.render import scene_from_world
from trundle.spatial import Pose

CAN = "<model name='can'><pose>7 7 7 0 0 0</pose><link name='l'/></model>"


def read(folder: Path, body: str, report: Diagnostics | None = None, *, seed: int = 0) -> World:
    file = folder / "x.world"
    file.write_text(f"<sdf version='1.6'><world name='w'>{body}</world></sdf>")
    return load(str(file), report or Diagnostics(), packages=Packages({}, start=folder), seed=seed).world


def positions(world: World) -> list[tuple[float, ...]]:
    return [model.world_from_model.position for model in world.models]


def population(folder: Path, body: str, *, seed: int = 0, report: Diagnostics | None = None) -> World:
    return read(folder, f"<population name='p'>{CAN}{body}</population>", report, seed=seed)


def test_a_grid_is_centred_on_its_pose(tmp_path: Path) -> None:
    how = "<distribution><type>grid</type><rows>2</rows><cols>3</cols><step>1 2 0</step></distribution>"

    world = population(tmp_path, f"<pose>10 0 1 0 0 0</pose>{how}")

    assert [model.name for model in world.models] == [f"can_clone_{i}" for i in range(6)]
    assert positions(world) == [(9, -1, 1), (10, -1, 1), (11, -1, 1), (9, 1, 1), (10, 1, 1), (11, 1, 1)]


def test_a_row_ends_a_step_before_the_edge_as_in_gazebo(tmp_path: Path) -> None:
    region = "<box><size>4 2 1</size></box><model_count>4</model_count>"

    world = population(tmp_path, f"<pose>0 5 0 0 0 0</pose>{region}<distribution><type>linear-x</type></distribution>")

    assert positions(world) == [(-2, 5, 0), (-1, 5, 0), (0, 5, 0), (1, 5, 0)]


@pytest.mark.parametrize("kind", ["random", "uniform"])
def test_random_positions_are_inside_the_box_and_depend_on_the_seed(tmp_path: Path, kind: str) -> None:
    how = f"<model_count>20</model_count><distribution><type>{kind}</type></distribution>"
    body = f"<pose>3 4 5 0 0 0</pose><box><size>2 4 6</size></box>{how}"

    first = positions(population(tmp_path, body))

    assert len(set(first)) == 20
    assert all(abs(x - 3) <= 1 and abs(y - 4) <= 2 and abs(z - 5) <= 3 for x, y, z in first)
    assert positions(population(tmp_path, body)) == first
    assert positions(population(tmp_path, body, seed=1)) != first


def test_a_cylinder_is_filled_from_its_base_up(tmp_path: Path) -> None:
    how = "<model_count>50</model_count><distribution><type>random</type></distribution>"

    world = population(tmp_path, f"<cylinder><radius>2</radius><length>3</length></cylinder>{how}")

    assert all(math.hypot(x, y) <= 2 and 0 <= z <= 3 for x, y, z in positions(world))


def test_an_even_distribution_leaves_no_corner_empty() -> None:
    """The centres of a square's clusters are about as far apart as the points of a square grid."""
    import random

    points = [(x / 20, y / 20, 0.0) for x in range(20) for y in range(20)]

    middles = kmeans_centers(points, 16, random.Random(0))

    gaps = [min(math.dist(a, b) for b in middles if b is not a) for a in middles]
    assert min(gaps) > 0.12
    assert all(min(math.dist(p, m) for m in middles) < 0.3 for p in points)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("<model_count>2000000</model_count><box/>", "2000000 models; 1 to 1000 are possible"),
        ("<model_count>0</model_count><box/>", "0 models"),
        ("<model_count>2</model_count>", "no <box> or <cylinder>"),
        ("<box><size>0 1 1</size></box>", "its <box> or <cylinder> has no volume"),
        ("<cylinder/><distribution><type>linear-x</type></distribution>", "no distribution 'linear-x' of a cylinder"),
        ("<box/><distribution><type>heap</type></distribution>", "no distribution 'heap' of a box"),
        ("<distribution><type>grid</type><rows>-2</rows><cols>-2</cols></distribution>", "4 models"),
    ],
)
def test_an_invalid_population_is_reported(tmp_path: Path, body: str, message: str) -> None:
    report = Diagnostics()

    assert population(tmp_path, body, report=report).models == ()

    (warning,) = report.warnings
    assert f"x.world:1: warning: <population> 'p': {message}" in warning


SAVED = """<model name='arm'><pose>1 0 0 0 0 0</pose><link name='base'><visual name='v'><geometry><box>
<size>1 2 3</size></box></geometry></visual><collision name='c'><geometry><cylinder>
<radius>1</radius><length>1</length></cylinder></geometry></collision></link>
<link name='tip'><pose>0 0 1 0 0 0</pose></link>
<joint name='j' type='ball'><parent>base</parent><child>tip</child></joint></model>
<state world_name='w'>{}<model name='arm'><pose>5 0 0 0 0 1.5707963267948966</pose>{}
<link name='base'><pose>5 0 0 0 0 1.5707963267948966</pose><velocity>0 0 0 0 0 1</velocity></link>
<link name='tip'><pose>5 1 1 0 0 1.5707963267948966</pose></link></model></state>"""


def test_a_saved_link_keeps_its_saved_and_its_written_pose(tmp_path: Path) -> None:
    report = Diagnostics()

    world = read(tmp_path, SAVED.format("", ""), report)

    base, tip = world.models[0].links
    assert base.initial_pose is None
    assert tip.model_from_link == Pose((0.0, 0.0, 1.0))
    assert tip.initial_pose is not None
    assert tip.initial_pose.position == pytest.approx((1, 0, 1))
    messages = [finding.what for finding in report.findings]
    assert "<velocity> in <link> has no effect: everything starts at rest; it is ignored" in messages
    again = load_text(
        write_sdf(world, is_world=True, uri_of=written_uri, report=report),
        name="again.sdf",
        folder=tmp_path,
        packages=Packages({}, start=tmp_path),
        report=report,
    ).world
    start = again.models[0].links[1].initial_pose
    assert start is not None
    assert start.position == pytest.approx((1, 0, 1))


def test_a_saved_link_without_a_joint_is_placed_at_its_saved_pose(tmp_path: Path) -> None:
    loose = SAVED.replace("<joint name='j' type='ball'><parent>base</parent><child>tip</child></joint>", "")
    for body in (loose, SAVED.replace("<model name='arm'>", "<model name='arm'><static>1</static>", 1)):
        base, tip = read(tmp_path, body.format("", ""), Diagnostics()).models[0].links

        assert (base.initial_pose, tip.initial_pose) == (None, None)
        assert tip.model_from_link.position == pytest.approx((1, 0, 1))


def test_a_saved_scale_applies_to_the_shapes_of_the_links(tmp_path: Path) -> None:
    base = read(tmp_path, SAVED.format("", "<scale>2 3 4</scale>")).models[0].links[0]
    assert base.visuals[0].geometry == Box((2.0, 6.0, 12.0))
    assert base.collisions[0].geometry == Cylinder(3.0, 4.0)

    report = Diagnostics()
    base = read(tmp_path, SAVED.format("", "<scale>0 1 1</scale>"), report).models[0].links[0]
    assert base.visuals[0].geometry == Box((1.0, 2.0, 3.0))
    assert "needs three numbers > 0" in report.warnings[0]


def test_inserted_models_are_added_at_their_saved_poses(tmp_path: Path) -> None:
    added = f"<insertions>{CAN}<light name='lamp' type='point'/></insertions>"
    moved = "<model name='can'><pose>0 0 9 0 0 0</pose></model>"

    world = read(tmp_path, SAVED.format(added + moved, ""))

    assert [(model.name, model.world_from_model.position) for model in world.models][1] == ("can", (0, 0, 9))
    assert [light.name for light in world.lights] == ["lamp"]


def test_a_road_is_a_line_with_a_width_and_a_material(tmp_path: Path) -> None:
    points = "<point>0 0 0.1</point><point>5 0 0.1</point><point>5 5 0.1</point>"
    blue = "<material><script><name>Gazebo/Blue</name></script></material>"
    report = Diagnostics()

    world = read(tmp_path, f"<road name='way'><width>4</width>{points}{blue}</road><road name='dot'/>", report)

    (road,) = world.roads
    assert (road.width, road.points) == (4.0, ((0.0, 0.0, 0.1), (5.0, 0.0, 0.1), (5.0, 5.0, 0.1)))
    assert road.material.diffuse == (0.0, 0.0, 1.0, 1.0)
    assert "<road> 'dot' needs two points and a width > 0 m; it is left out" in report.warnings[0]


ACTOR = """<actor name='walker'><pose>1 0 0 0 0 0</pose><skin><filename>walk.dae</filename><scale>2</scale></skin>
<animation name='walking'><filename>walk.dae</filename><interpolate_x>true</interpolate_x></animation>
<script><loop>false</loop><delay_start>2.5</delay_start><auto_start>false</auto_start>
<trajectory id='1' type='dancing'/>
<trajectory id='0' type='walking' tension='0.5'><waypoint><time>2</time><pose>3 0 0 0 0 0</pose></waypoint>
<waypoint><time>0</time><pose>1 0 0 0 0 0</pose></waypoint></trajectory></script>
<link name='tag'/><plugin name='p' filename='libActorPlugin.so'/></actor>"""


def test_an_actor_has_its_skin_its_animations_and_its_script(tmp_path: Path) -> None:
    (tmp_path / "walk.dae").write_text("")
    report = Diagnostics()

    (actor,) = read(tmp_path, ACTOR, report).actors

    assert actor.skin is not None
    assert (actor.skin.path, actor.skin.scale) == (tmp_path / "walk.dae", 2.0)
    assert [(animation.name, animation.interpolate_x) for animation in actor.animations] == [("walking", True)]
    assert (actor.loop, actor.delay_start_s, actor.auto_start) == (False, 2.5, False)
    walk, dance = actor.trajectories
    assert (walk.tension, [point.time_s for point in walk.waypoints]) == (0.5, [0.0, 2.0])
    assert walk.waypoints[1].pose == Pose((3.0, 0.0, 0.0))
    assert dance.waypoints == ()
    assert [link.name for link in actor.links] == ["tag"]
    assert [plugin.filename for plugin in actor.plugins] == ["libActorPlugin.so"]
    assert report.warnings[0].endswith("actor 'walker': no animation 'dancing'; animations here: 'walking'")


def test_an_actor_and_a_road_round_trip(tmp_path: Path) -> None:
    (tmp_path / "walk.dae").write_text("")
    first = read(tmp_path, ACTOR + "<road name='way'><point>0 0 0</point><point>1 0 0</point></road>")
    text = write_sdf(first, is_world=True, uri_of=written_uri, report=Diagnostics())

    second = load_text(
        text, name="a.sdf", folder=tmp_path, packages=Packages({}, start=tmp_path), report=Diagnostics()
    ).world

    (a,), (b,) = first.actors, second.actors
    assert (a.trajectories, a.loop, a.delay_start_s, a.auto_start) == (
        b.trajectories,
        b.loop,
        b.delay_start_s,
        b.auto_start,
    )
    assert b.skin is not None
    assert b.skin.path == tmp_path / "walk.dae"
    assert second.roads[0].points == first.roads[0].points
    assert second.roads[0].material == first.roads[0].material


def test_a_road_is_drawn_on_static_geometry(tmp_path: Path) -> None:
    ground = "<model name='g'><static>1</static><pose>5 0 1 0 0 1</pose><link name='l'/></model>"
    road_text = "<road name='way'><point>0 0 0</point><point>1 0 0</point></road>"
    report = Diagnostics()
    world = read(tmp_path, f"<model name='car'><link name='l'/></model>{ground}{road_text}")

    (shape,) = scene_from_world(world, report).shapes

    assert shape.name == "way"
    model = world.models[shape.body]
    assert model.name == "g"
    assert (model.world_from_model @ shape.body_from_shape).as_list() == pytest.approx([0.0] * 6, abs=1e-12)
    assert scene_from_world(world, report, collisions=True).shapes == ()
    assert report.findings == []
    assert scene_from_world(read(tmp_path, road_text), report).shapes == ()
    assert "nothing in this world is static to lay it on; it is not drawn" in report.warnings[0]
