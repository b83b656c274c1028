"""Commands interrupted while they cut hollow meshes."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

CORNERS = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]


def angle_iron(height: float) -> str:
    """A closed L, which is hollow."""
    points = [f"v {x} {y} {z}" for z in (0.0, height) for x, y in CORNERS]
    sides = [f"f {i + 1} {(i + 1) % 6 + 1} {(i + 1) % 6 + 7} {i + 7}" for i in range(6)]
    ends = [
        f"f {' '.join(map(str, face))}"
        for a, b, c in ((1, 2, 3), (1, 3, 4), (1, 4, 5), (1, 5, 6))
        for face in ((c, b, a), (a + 6, b + 6, c + 6))
    ]
    return "\n".join([*points, *sides, *ends])


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="process groups are POSIX'")
@pytest.mark.parametrize("command", ["run", "launch"])
def test_ctrl_c_ends_mesh_cutting_at_once_without_a_traceback(command: str, tmp_path: Path) -> None:
    models = ""
    for i in range(60):
        (tmp_path / f"m{i}.obj").write_text(angle_iron(1 + i / 50))
        models += (
            f'<model name="m{i}"><pose>0 {3 * i} 0 0 0 0</pose><link name="l"><collision name="c"><geometry><mesh><uri>'
            f"m{i}.obj</uri></mesh></geometry></collision></link></model>"
        )
    world = tmp_path / "w.world"
    world.write_text(f'<sdf version="1.6"><world name="w">{models}</world></sdf>')
    launch = tmp_path / "w.launch"
    launch.write_text(f'<launch><node pkg="gazebo_ros" type="gzserver" name="gazebo" args="{world}"/></launch>')
    words = ["run", str(world), "--no-ros"] if command == "run" else ["launch", str(launch), "--port", "0"]
    process = subprocess.Popen(
        [sys.executable, "-m", "trundle", *words, "--headless"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,  # a terminal's Ctrl-C reaches all of a group
        env={**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache"), "ROS_HOME": str(tmp_path / "ros")},
    )
    for _ in range(1500):
        if len(list((tmp_path / "cache").glob("trundle/meshes/*.npz"))) > 1:
            break
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "cutting 60 hollow meshes" in errors
    assert "Traceback" not in errors
    assert 1 < len(list((tmp_path / "cache").glob("trundle/meshes/*.npz"))) < 60
