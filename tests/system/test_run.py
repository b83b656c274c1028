"""`trundle run` in a process."""

import json
import math
import shutil
import signal
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

EXAMPLE = Path(__file__).parents[2] / "examples/rp2w"
FLAT_OUT = ("--headless", "--speed", "max")


@pytest.fixture
def seed(shared: Path) -> Path:
    return shared / "seeds/rp2w"


def test_the_published_robot_stands_like_in_gazebo(trundle, seed, shared) -> None:
    """Link poses equal Gazebo 11's within 1 mm and 1 mrad, except for the roll of the wheels, which creep in Gazebo."""
    done = trundle("run", str(seed / "model.sdf"), *FLAT_OUT, "--duration", "10", "--no-sensors", "--json")

    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    robot = result["models"][0]
    reference = json.loads((shared / "peers/gazebo_rp2w.json").read_text())["samples"][-1]
    for link in robot["links"]:
        gazebo = reference["links"][f"my_robot::{link['name']}"]
        assert link["pose"][:3] == pytest.approx(gazebo["pos"], abs=1e-3), link["name"]
        if not link["name"].endswith("wheel"):
            assert link["pose"][3:] == pytest.approx(gazebo["rpy"], abs=1e-3), link["name"]
    assert result["time"] == 10.0
    assert result["steps"] == 10_000
    assert [model["name"] for model in result["models"] if model.get("added")] == ["ground_plane"]


def test_warnings_about_the_published_robot_are_printed_once(trundle, seed) -> None:
    done = trundle("run", str(seed), *FLAT_OUT, "--duration", "0.1", "--no-sensors", "--no-ros")

    lines = done.stderr.splitlines()
    assert sum("librp2w.so" in line and "the run goes on without it" in line for line in lines) == 1
    assert sum("of zero thickness; physics uses 0.1 mm" in line for line in lines) == 2
    assert "stands at" in done.stdout


def test_cameras_without_subscribers_render_no_images(trundle) -> None:
    """Both cameras are always on."""
    done = trundle("run", str(EXAMPLE), *FLAT_OUT, "--duration", "1", "--json", "--no-ros")

    assert json.loads(done.stdout)["images"] == 0


def test_models_are_searched_like_in_gazebo(trundle, seed, tmp_path) -> None:
    """`~/.gazebo/models` first, then GAZEBO_MODEL_PATH, then the shipped models."""
    shipped = trundle("run", "model://rp2w", *FLAT_OUT, "--duration", "0.01", "--no-ros", "--json", "--no-sensors")
    home = tmp_path / ".gazebo/models"
    home.mkdir(parents=True)
    shutil.copytree(seed, home / "rp2w")
    local = trundle("run", "model://rp2w", *FLAT_OUT, "--duration", "0.01", "--no-ros", "--json", "--no-sensors")

    assert json.loads(shipped.stdout)["models"][0]["name"] == "rp2w"
    assert json.loads(local.stdout)["models"][0]["name"] == "my_robot"


def test_two_runs_end_in_identical_states(trundle) -> None:
    results = [
        json.loads(trundle("run", str(EXAMPLE), *FLAT_OUT, "--duration", "3", "--json", "--no-sensors").stdout)
        for _ in range(2)
    ]

    assert results[0]["models"] == results[1]["models"]


def test_the_plugin_drives_on_cmd_vel(start, trundle, master, until) -> None:
    """A topic of one process moves the wheels in another, which publishes odometry."""
    running = start("run", str(EXAMPLE), "--headless", "--no-sensors")
    until("the plugin's subscription", lambda: "/cmd_vel" in dict(master.call("getTopicTypes")))

    trundle("topic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.3}}")

    def travelled() -> float:
        echoed = trundle("topic", "echo", "-n1", "/odom/pose/pose/position/x")
        return float(echoed.stdout.split()[0])

    until("the robot to have moved", lambda: travelled() > 0.2)
    assert running.interrupt() == 130
    y = float(running.output().partition(", y ")[2].split(",")[0])
    assert y > 0.2


def test_the_robot_in_the_living_room_sees_the_sofa(trundle, tmp_path) -> None:
    """`make demo HEADLESS=1`: without subscribers no images are rendered, and only movable models are printed."""
    run = trundle("run", "rp2w_at_home.world", *FLAT_OUT, "--duration", "1")
    render = trundle("render", "rp2w_at_home.world", "--camera", "my_sensor", "-o", "seen.png")

    assert run.returncode == 0, run.stderr
    assert "1000 steps, 0 images" in run.stdout
    assert [line.split()[0] for line in run.stdout.splitlines()[1:]] == ["ball", "rp2w"]
    assert render.returncode == 0, render.stderr
    red, _, blue = np.asarray(Image.open(tmp_path / "seen.png"))[205, 80].astype(int)
    assert blue > 2 * red, "the sofa is blue"


def test_images_have_camera_info(start, trundle, master, until) -> None:
    start("run", str(EXAMPLE), "--headless")
    until("the camera", lambda: "/rp2w/camera/my_sensor/image_raw" in dict(master.call("getTopicTypes")))

    info = trundle("topic", "echo", "-n1", "/rp2w/camera/my_sensor/camera_info").stdout
    image = trundle("topic", "echo", "-n1", "--noarr", "/rp2w/camera/my_sensor/image_raw").stdout

    focal = 160 / math.tan(1.047 / 2)
    assert f"K: [{focal}, 0.0, 160.5, 0.0, {focal}, 120.5, 0.0, 0.0, 1.0]" in info
    assert 'encoding: "rgb8"' in image
    assert "width: 320" in image
    assert 'frame_id: "my_sensor_optical"' in image


@pytest.mark.parametrize("times", [1, 2], ids=["once", "twice at once"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_run_stops_cleanly_on_signals(start, master, until, number, times) -> None:
    running = start("run", str(EXAMPLE), "--headless", "--no-sensors")
    until("the run", lambda: "/clock" in dict(master.call("getTopicTypes")))

    for _ in range(times):  # `timeout -s INT` signals the process and its group
        running.process.send_signal(number)
        time.sleep(0.002)

    assert running.process.wait(30) == 130
    assert "Traceback" not in running.output()
    assert "stands at" in running.output()


def test_a_second_run_uses_another_port(start, trundle, master, until, env) -> None:
    """Without ROS_MASTER_URI parallel runs are independent."""
    del env["ROS_MASTER_URI"]
    first = start("run", str(EXAMPLE), "--headless", "--no-sensors")
    until("the first run's master", lambda: "ROS master started" in first.output())

    second = trundle("run", str(EXAMPLE), *FLAT_OUT, "--duration", "0.1", "--no-sensors")

    def uri(text: str) -> str:
        return text.partition("ROS master started: ")[2].split()[0]

    assert second.returncode == 0
    assert uri(second.stderr) != uri(first.output())
