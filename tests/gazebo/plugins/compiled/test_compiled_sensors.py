"""Sensors' plugins in C++, which get what the simulation measures."""

import math
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.graphs import running_graph, until

from trundle.base.diagnostics import UsageError
from trundle.ros.sdk import find_toolchain

pytestmark = pytest.mark.slow
_SOURCE = Path(__file__).parents[3] / "data/gazebo_plugins/sense"
_WAIT_S = 1800  # the first to come compiles the kit


def _environment(cwd: Path, **variables: str) -> dict[str, str]:
    path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ["PATH"]])
    left_out = ("GAZEBO_PLUGIN_PATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "ROS_MASTER_URI")
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    return {**kept, "PATH": path, "PWD": str(cwd), **variables}


def _run(*words: str, cwd: Path, **variables: str) -> str:
    done = subprocess.run(
        [sys.executable, "-m", "trundle", *words],
        cwd=cwd,
        env=_environment(cwd, **variables),
        capture_output=True,
        text=True,
        check=False,
        timeout=_WAIT_S,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the world, with its compiled plugins."""
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    folder = tmp_path_factory.mktemp("plugins") / "sense"
    shutil.copytree(_SOURCE, folder)
    _run("shell", "-c", "cmake -S . -B build && cmake --build build", cwd=folder)
    return folder


def test_each_kind_of_sensor_gives_its_readings(built: Path) -> None:
    """A red wall 1.8 m ahead of a box of 2 kg, 0.25 m more for the lidar's plugin; a box that SetCollideMode lets fall,
    though a model comes."""
    with running_graph() as graph:
        words = ("run", "sense.world", "--headless", "--duration", "1", "--speed", "max")
        output = _run(*words, cwd=built, ROS_MASTER_URI=graph.core.uri)

    assert re.search(rf"plugin '\w+' of \S*box::body::lidar: {built}/build/lib\w+\.so, in C\+\+\n", output), output
    seen = dict(re.findall(r"seen (\w+) of box::body: (.*)", output))
    assert seen == {
        "lidar": "5 rays from -0.20 to 0.20, middle 2.050, topic 5",
        "imu": "9.80",
        "gps": "47.000 400.500",
        "sonar": seen.get("sonar", "nothing"),
        "bumper": seen.get("bumper", "nothing"),
        "eye": "64x48 RGB_INT8 red, message 144 of 3",
        "deep": "64x48 R8G8B8 red, depth 1.80",
        "list": seen.get("list", "nothing"),
        "eyes": "01 left red right other",
    }, output
    assert seen["list"] == "from 0.5 to 3.0 at z 0.90, topic 2: ground_plane -0.20 wall 1.85"
    assert "idle is loaded" in output
    assert "noise" not in output
    assert re.fullmatch(r"1\.\d\d of 5\.0", seen["sonar"])
    force = re.fullmatch(r"(\d+\.\d) N with ground_plane::link::collision", seen["bumper"])
    assert force is not None, seen["bumper"]
    assert float(force[1]) == pytest.approx(2 * 9.8, abs=1.0)
    fallen = re.search(r"ghost stands at x \S+, y \S+, z (\S+)", output)
    assert fallen is not None, output
    assert float(fallen[1]) == pytest.approx(0.5 - 9.8 * 0.8**2 / 2, abs=0.05)


def test_gzserver_loads_a_plugin_of_the_system_before_the_others(built: Path) -> None:
    with running_graph() as graph:
        command = [sys.executable, "-m", "trundle", "--as", "gzserver", "-s", "libwatch.so", "-s", "libnone.so"]
        process = subprocess.Popen(
            [*command, "sense.world"],
            cwd=built,
            env=_environment(built, ROS_MASTER_URI=graph.core.uri),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        assert process.stdout is not None
        lines: list[str] = []
        for line in process.stdout:
            lines.append(line)
            if "watched step 100" in line:
                break
        process.terminate()
        lines += process.communicate(timeout=_WAIT_S)[0].splitlines(keepends=True)

    output = "".join(lines)
    assert "watched gzserver: world room with ground_plane wall box feather ghost" in output
    assert (
        "gzserver -s libnone.so: warning: there is no library libnone.so that was compiled with Trundle's kit" in output
    )
    # A body that weighs nothing until the 90th step.
    assert "watched step 100 at 0.099, 99 draws, feather 1.9995" in output
    assert output.index("watched gzserver") < output.index("plugin 'through'")


def test_a_camera_by_the_base_of_gazebo_ros_cameras_publishes_pictures_and_its_info(
    built: Path, tmp_path: Path
) -> None:
    """Negatives of a red wall; the parameters of its element, set_camera_info, and no pictures without subscribers."""
    del built
    workspace = tmp_path / "ws"
    shutil.copytree(_SOURCE.parent / "negative", workspace / "src/negative")
    made = _run("--as", "catkin_make", cwd=workspace)
    assert "library negative (src/negative.cpp; src/negative/CMakeLists.txt:10): built: " in made, made
    with running_graph() as graph:
        folder = workspace / "src/negative"
        process = subprocess.Popen(
            [sys.executable, "-m", "trundle", "run", "wall.world", "--headless"],
            cwd=folder,
            env=_environment(folder, ROS_MASTER_URI=graph.core.uri),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        try:
            node = graph.node("viewer")
            pictures: list[Any] = []
            infos: list[Any] = []
            node.subscribe("/mast/eye_1/image_raw", "sensor_msgs/Image", pictures.append)
            until(lambda: pictures)
            node.subscribe("/mast/eye_1/camera_info", "sensor_msgs/CameraInfo", infos.append)
            until(lambda: infos)
            matrix = [20.0, 0.0, 15.0, 0.0, 21.0, 11.0, 0.0, 0.0, 1.0]
            wanted = {"width": 64, "height": 48, "distortion_model": "plumb_bob", "D": [0.0] * 5, "K": matrix}
            call = node.call_service(
                "/mast/eye_1/set_camera_info", "sensor_msgs/SetCameraInfo", {"camera_info": wanted}
            )
            graph.loop.run(call)
            until(lambda: list(infos[-1].K) == matrix)
        finally:
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=_WAIT_S)
    assert "pictures of /mast/eye_1/image_raw are negatives" in output
    picture, info = pictures[0], infos[0]
    assert (picture.width, picture.height, picture.encoding) == (64, 48, "rgb8")
    assert picture.header.frame_id == info.header.frame_id == "optical"
    red, green, blue = np.asarray(picture.data, np.uint8).reshape(48, 64, 3)[24, 32].tolist()
    assert red < green == blue == 255
    focal = 32 / math.tan(0.5)
    assert (info.K[0], info.K[2], info.K[5], info.P[3]) == pytest.approx((focal, 32.5, 24.5, -0.1 * focal))
    assert list(info.D) == [0.25, 0.0, 0.0, 0.0, 0.0]
    assert infos[-1].header.frame_id == "optical"
    assert process.returncode == 130, output
