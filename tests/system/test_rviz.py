"""The real rviz in a virtual display with Trundle's graph: its status is Ok, and its picture shows the driving car."""

import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

pytestmark = [
    pytest.mark.slow,
    pytest.mark.real_ros,
    pytest.mark.skipif(
        not all(Path("/usr/bin", name).exists() for name in ("rviz", "Xvfb", "import")),
        reason="rviz, Xvfb and ImageMagick are not installed (make system)",
    ),
]
CONFIG = """
Panels:
  - {Class: rviz/Displays, Name: Displays, Property Tree Widget: {Expanded: [/RobotModel1], Splitter Ratio: 0.5}}
Visualization Manager:
  Displays:
    - {Class: rviz/RobotModel, Enabled: true, Name: RobotModel, Robot Description: robot_description}
  Global Options: {Background Color: 255; 255; 255, Fixed Frame: odom, Frame Rate: 10}
  Views:
    Current: {Class: rviz/TopDownOrtho, Name: Current View, Scale: 100, Target Frame: odom}
Window Geometry: {Height: 800, Width: 1100}
"""
PANEL, VIEW = np.s_[70:660, 0:340], np.s_[70:760, 370:1080]
"""Regions of rviz' display list and of its picture, with this configuration [rows, columns]."""


@pytest.fixture
def look(env: dict[str, str], tmp_path: Path) -> Iterator[Callable[[], np.ndarray]]:
    """Start rviz; return a function that captures its window, (height, width, 3)."""
    (tmp_path / "car.rviz").write_text(CONFIG)
    reading, writing = os.pipe()
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    screen = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1200x900x24"]
    display = subprocess.Popen(screen, pass_fds=[writing], **quiet)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    runtime = tmp_path / "runtime"
    runtime.mkdir(mode=0o700)
    desktop = {
        "PATH": "/usr/bin:/bin",
        "HOME": str(tmp_path),
        "DISPLAY": f":{number}",
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "XDG_RUNTIME_DIR": str(runtime),
        "ROS_MASTER_URI": env["ROS_MASTER_URI"],
        "ROS_PACKAGE_PATH": "/usr/share",
    }
    rviz = subprocess.Popen(["/usr/bin/rviz", "-d", str(tmp_path / "car.rviz")], env=desktop, **quiet)

    def picture() -> np.ndarray:
        target = tmp_path / "window.png"
        subprocess.run(["/usr/bin/import", "-window", "root", str(target)], env=desktop, check=True, timeout=60)
        return np.asarray(Image.open(target).convert("RGB")).astype(int)

    yield picture
    for process in (rviz, display):
        process.kill()
        process.wait()


def _is_ok(window: np.ndarray) -> bool:
    """Return whether the list of displays has green ticks, and no red errors or orange warnings."""
    red, green, blue = np.moveaxis(window[PANEL], -1, 0)
    ticks = (green > red + 60) & (green > blue + 60)
    faults = (red > green + 60) & (red > blue + 100)
    return int(ticks.sum()) > 20 and not faults.any()


def _car(window: np.ndarray) -> np.ndarray:
    """Return the position of the blue car in the picture, (x, y) [px]; NaN: not visible."""
    red, green, blue = np.moveaxis(window[VIEW], -1, 0)
    rows, columns = np.nonzero((blue > red + 60) & (blue > green + 60))
    return np.array([columns.mean(), rows.mean()]) if len(rows) > 100 else np.full(2, np.nan)


def test_the_real_rviz_shows_the_driving_car(start, master, until, trundle, shared, look) -> None:
    """The car turns left: away from its start, and up in a picture from above."""
    packages = str(shared / "seeds")
    start("launch", "smartcar_description", "smartcar_display.rviz.launch", "--headless", ROS_PACKAGE_PATH=packages)
    until("the driver", lambda: "/odom" in dict(master.call("getTopicTypes")))
    until("rviz to find nothing wrong and draw the car", lambda: _is_ok(w := look()) and np.isfinite(_car(w)).all())
    start_position = _car(look())

    twist = "{linear: {x: 0.5}, angular: {z: 0.5}}"
    assert trundle("topic", "pub", "-1", "/cmd_vel", "geometry_msgs/Twist", twist).returncode == 0

    until("the car to drive", lambda: start_position[1] - _car(look())[1] > 40)
    assert _is_ok(look())
