"""Worlds, robots, launch files and plans that come with Trundle: they are listed, they run, and do what is said."""

import math
import os
import shlex
import subprocess
import sys
from itertools import groupby
from pathlib import Path

import numpy as np
import pytest
from tests.docs_blocks import ROOT
from tests.graphs import free_port

import trundle
from trundle.app.cli.main import main
from trundle.app.cli.shipped_list import shipped_list
from trundle.assets import ASSETS
from trundle.base.diagnostics import Diagnostics
from trundle.gazebo.nodes.map_server.occupancy_grid import read_map
from trundle.robots.description import load
from trundle.robots.model import Box
from trundle.robots.packages import Packages, shipped_files
from trundle.ros import Messages, open_bag

if not (ROOT / "docs/generate").is_dir():
    pytest.skip("the gallery is not part of the sdist", allow_module_level=True)
sys.path.insert(0, str(ROOT / "docs"))
from generate.gallery import GALLERY

TIMEOUT_S = 300.0


def test_everything_that_can_be_run_is_listed_with_a_sentence() -> None:
    files = shipped_files()
    commands = {file.command for file in files}
    worlds = {path.name for path in (ASSETS / "worlds").glob("*.world")}
    worlds |= {f"physics/{path.name}" for path in (ROOT / "examples/physics").glob("*.world")}
    models = {
        path.parent.name
        for root in ("src/trundle/assets/models", "examples")
        for path in (ROOT / root).glob("*/model.config")
    }

    assert len(worlds) > 40
    assert {f"trundle run {world}" for world in worlds} <= commands
    assert {f"trundle run model://{model}" for model in models} <= commands
    assert {"trundle launch smartcar drive.launch", "trundle sweep race.yaml"} <= commands
    assert [file.command for file in files if len(file.about) < 8] == []
    assert [kind for kind, _ in groupby(file.kind for file in files)] == ["worlds", "launch files", "models", "plans"]


@pytest.mark.parametrize("width", [40, 80, 120, 200])
def test_the_list_fits_its_terminal(width: int) -> None:
    lines = shipped_list(width).splitlines()
    longest = max(len(file.command) for file in shipped_files()) + 2

    assert max(map(len, lines)) <= max(width, longest)
    assert lines[0] == "Worlds"


def test_run_lists_without_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "--list"]) == 0
    assert "trundle run rp2w_at_home.world" in capsys.readouterr().out


def test_the_gallery_shows_a_dozen_listed_things() -> None:
    commands = {file.command for file in shipped_files()}

    assert len(GALLERY) >= 12
    assert {entry.command for entry in GALLERY.values()} <= commands


def _environment(home: Path) -> dict[str, str]:
    """A user's without ROS, with a master's address of its own."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_"))}
    return {**kept, "HOME": str(home), "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}/"}


@pytest.mark.slow
@pytest.mark.parametrize("name", GALLERY)
def test_each_thing_of_the_gallery_runs_for_a_second(name: str, tmp_path: Path) -> None:
    program, *words = shlex.split(GALLERY[name].command)
    assert program == "trundle"
    command = [sys.executable, "-m", "trundle", *words, "--headless", "--speed", "max", "--duration", "1"]

    done = subprocess.run(
        command, cwd=tmp_path, env=_environment(tmp_path), capture_output=True, text=True, timeout=TIMEOUT_S
    )

    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    assert "warning:" not in done.stderr


@pytest.mark.slow
def test_the_plan_of_the_gallery_tells_rolling_from_sliding(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A hoop needs mu of about half the slope's tangent."""
    monkeypatch.chdir(tmp_path)

    table = trundle.sweep("race.yaml", workers=1).table

    friction, rolled = np.array(table["mu"]), np.array(table["rolled"])
    assert (tmp_path / "race.sweep/results.parquet").is_file()
    assert (rolled[friction > 0.6 * math.tan(0.2)] > 0.95).all()
    assert (rolled[friction < 0.4 * math.tan(0.2)] < 0.9).all()


def test_the_smaller_the_moment_of_inertia_the_faster_a_body_rolls() -> None:
    """From rest, without sliding: v = g t sin(a) / (1 + I / (m r²))."""
    sim = trundle.load("race.world")
    sim.run(1.0)

    for name, factor in (("ball", 0.4), ("disc", 0.5), ("hoop", 0.98)):
        speed = math.hypot(*sim[name].twist.linear)
        assert speed == pytest.approx(9.8 * math.sin(0.2) / (1 + factor), rel=0.05), name


@pytest.mark.slow
def test_all_dominoes_fall_and_the_last_one_last() -> None:
    sim = trundle.load("dominoes.world", plugins=True)
    names = [model.name for model in sim.models if model.name.startswith("domino")]

    def lies(name: str) -> bool:
        return sim[name].link("link").pose.position[2] < 0.09

    sim.run(1.0)
    assert lies(names[0])
    assert not lies(names[-1])
    sim.run(2.0)
    assert [name for name in names if not lies(name)] == []


@pytest.mark.slow
def test_the_top_keeps_its_tilt_while_its_axis_turns() -> None:
    """The axis turns at about m g l / (I w) = 0.5 · 9.8 · 0.1 / (0.0014 · 60) = 5.8 rad/s."""
    sim = trundle.load("spinning_top.world", plugins=True)
    axes: list[tuple[float, float, float]] = []
    for _ in range(20):
        sim.run(0.05)
        axes.append(sim["top"].link("top").pose.transform_vector((0.0, 0.0, 1.0)))

    tilts = [math.acos(axis[2]) for axis in axes]
    turned = np.unwrap([math.atan2(axis[1], axis[0]) for axis in axes])
    assert tilts == pytest.approx([0.2] * 20, abs=0.04)
    assert (turned[-1] - turned[0]) / 0.95 == pytest.approx(5.8, rel=0.05)


@pytest.mark.slow
def test_the_quadruped_trots_ahead_and_turns() -> None:
    with trundle.load("quadruped.world", plugins=True, ros=True) as sim:
        command = sim.make_node("/me").advertise("/cmd_vel", "geometry_msgs/Twist")
        sim.run(4.0)
        x, _, z = sim["quadruped"].link("body").pose.position
        command.publish({"linear": {"x": 0.3}, "angular": {"z": 0.5}})
        sim.run(3.0)
        body = sim["quadruped"].link("body").pose

    assert x == pytest.approx(0.3 * 4, rel=0.2)
    assert z == pytest.approx(0.275, abs=0.04)
    forward, up = body.transform_vector((1.0, 0.0, 0.0)), body.transform_vector((0.0, 0.0, 1.0))
    assert math.atan2(forward[1], forward[0]) > 0.5
    assert up[2] > 0.95


def test_the_map_of_the_house_has_the_walls_of_its_world() -> None:
    packages = Packages({"HOME": "/nobody"}, start=Path(__file__))
    (house,) = (
        model for model in load("house.world", Diagnostics(), packages=packages).world.models if model.name == "house"
    )
    grid = read_map(ASSETS / "ros_packages/house_navigation/maps/house.yaml")
    rows, columns = np.indices(grid.cells.shape)
    corner = np.subtract(grid.origin[:2], house.world_from_model.position[:2])
    x, y = (corner[0] + 0.05 * (columns + 0.5), corner[1] + 0.05 * (rows + 0.5))
    is_wall = np.zeros(grid.cells.shape, dtype=bool)
    for collision in house.links[0].collisions:
        assert isinstance(collision.geometry, Box)
        at, size = collision.link_from_collision.position, collision.geometry.size
        is_wall |= (abs(x - at[0]) < size[0] / 2) & (abs(y - at[1]) < size[1] / 2)

    assert ((grid.cells == 100) == is_wall).all()


_GOAL = """<launch>
  <include file="$(find house_navigation)/launch/house.launch"><arg name="gui" value="false"/></include>
  <node pkg="rostopic" type="rostopic" name="goal" args="pub /move_base_simple/goal geometry_msgs/PoseStamped
    '{header: {frame_id: map}, pose: {position: {x: 5.6, y: 2.7}, orientation: {w: 1.0}}}'"/>
</launch>
"""


@pytest.mark.slow
def test_the_robot_of_the_house_finds_its_way_to_another_room(tmp_path: Path) -> None:
    file, bag = tmp_path / "goal.launch", tmp_path / "goal.bag"
    file.write_text(_GOAL)
    options = ["--headless", "--speed", "max", "--duration", "40", "--record", str(bag)]
    command = [sys.executable, "-m", "trundle", "launch", str(file), *options]
    subprocess.run(command, env=_environment(tmp_path), check=True, timeout=TIMEOUT_S)

    messages = Messages()
    with open_bag(bag) as opened:
        last = list(opened.messages(lambda connection: connection.topic == "/odom"))[-1]
        status = list(opened.messages(lambda connection: connection.topic == "/move_base/result"))[-1]
    pose = messages.deserialize(last.data, last.connection.type).pose.pose.position
    assert messages.deserialize(status.data, status.connection.type).status.status == 3
    assert (pose.x, pose.y) == pytest.approx((5.6, 2.7), abs=0.4)
