"""The RP2W with its Python plugin: motion and poses."""

import shutil
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import running_graph

from trundle.base.diagnostics import Diagnostics
from trundle.gazebo.model_plugins import load_plugins
from trundle.live.world_setup import load_world
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation

EXAMPLE = Path(__file__).parents[2] / "examples/rp2w"


class Run:
    """A simulation and its model's plugin."""

    def __init__(self, folder: Path) -> None:
        report = Diagnostics()
        loaded = load_world(str(folder), Packages({}, start=folder), report)
        self.sim = Simulation(loaded.flat, report)
        self.robot = self.sim.models[0]
        self.plugin: Any = load_plugins(self.sim, None, {}, log=lambda _: None)[0]


def with_the_published_model(folder: Path, shared: Path) -> Path:
    """Copy the tutorial's files and the plugin to a folder."""
    for name in ("model.sdf", "model.config"):
        shutil.copy(shared / "seeds/rp2w" / name, folder)
    shutil.copy(EXAMPLE / "rp2w.py", folder)
    return folder


def test_the_published_robot_drives_in_the_direction_of_its_cameras(tmp_path: Path, shared: Path) -> None:
    """With seven unit inertias, 2 N·m on each wheel accelerate it to 0.2 m/s in about three seconds."""
    run = Run(with_the_published_model(tmp_path, shared))
    run.plugin.command = (0.2, 0.0)

    run.sim.run(5.0)

    x, y, _ = run.robot.pose.position
    assert y > 0.3
    assert abs(x) < 0.02 * y
    assert abs(run.robot.pose.rpy[0]) < 0.01


def test_the_example_follows_a_velocity_command() -> None:
    run = Run(EXAMPLE)
    run.plugin.command = (0.4, 0.0)

    run.sim.run(5.0)

    # 0.4 m/s reached after 0.8 s at 0.5 m/s²: 0.16 m, then 4.2 s at full speed; wheels slip a little.
    x, y, _ = run.robot.pose.position
    assert y == pytest.approx(0.16 + 4.2 * 0.4, rel=0.02)
    assert abs(x) < 0.02
    assert run.plugin.odometry.x == pytest.approx(y, rel=0.02)


def test_the_example_turns_left_for_a_positive_yaw_rate() -> None:
    run = Run(EXAMPLE)
    run.plugin.command = (0.0, 0.5)

    run.sim.run(5.0)

    yaw = run.robot.pose.rpy[2]
    assert yaw == pytest.approx(0.5 * 5.0 - 0.5**2 / (2 * 2.0), rel=0.1)
    assert run.plugin.odometry.yaw == pytest.approx(yaw, rel=0.1)


@pytest.mark.parametrize(("joint", "angle"), [("body_camera_base", 0.7), ("camera_base_camera", -0.4)])
def test_the_camera_turns_on_both_axes(joint: str, angle: float) -> None:
    run = Run(EXAMPLE)
    handle = run.robot.joint(joint)
    run.plugin.look(handle, angle)

    run.sim.run(4.0)

    assert handle.position == pytest.approx(angle, abs=0.02)


def test_a_positive_tilt_looks_up() -> None:
    run = Run(EXAMPLE)
    run.plugin.look(run.robot.joint("camera_base_camera"), 0.5)

    run.sim.run(4.0)

    view_direction = run.robot.link("camera").pose.transform_vector((1.0, 0.0, 0.0))
    assert view_direction[2] > 0.4


def test_a_reset_clears_the_command() -> None:
    run = Run(EXAMPLE)
    run.plugin.command = (0.4, 0.0)
    run.sim.run(1.0)

    run.sim.reset()
    run.sim.run(1.0)

    assert run.robot.pose.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


def test_the_demo_world_loads_its_plugin_without_warnings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A failing plugin would be a warning."""
    monkeypatch.chdir(tmp_path)
    with running_graph() as graph:
        report = Diagnostics()
        loaded = load_world("rp2w_at_home.world", Packages({}, start=tmp_path), report)
        sim = Simulation(loaded.flat, report)

        loaded = load_plugins(sim, graph.node, {}, log=lambda _: None)
        sim.run(0.2)

    assert [type(plugin).__name__ for plugin in loaded] == ["Rp2w"]
    assert report.warnings == []
