"""Variables that packages set by catkin's environment hooks."""

import subprocess
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main

HOOK = """# Set some sane defaults
: ${ROVER_BASE:=tracks}         # wheels, tracks
: ${ROVER_WORLD:=`rospack find rover_gazebo`/worlds/yard.world}
export ROVER_MAP="$(rospack find rover_gazebo)/maps/${ROVER_BASE}.yaml"
export ROVER_HOME='@(CMAKE_CURRENT_SOURCE_DIR)/home'
export ROVER_HOST=`hostname`
export ROVER_LIST=$(ls; touch ran)
export LD_PRELOAD=/tmp/x.so
export PATH=/tmp:$PATH
export ROVER_BASE
"""
LAUNCH = "".join(
    f'<param name="{name}" value="$(optenv {variable} none)"/>'
    for name, variable in (
        ("base", "ROVER_BASE"),
        ("world", "ROVER_WORLD"),
        ("map", "ROVER_MAP"),
        ("home", "ROVER_HOME"),
        ("host", "ROVER_HOST"),
        ("list", "ROVER_LIST"),
        ("preload", "LD_PRELOAD"),
    )
)


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "ws/src/rover_gazebo"
    (folder / "env-hooks").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>rover_gazebo</name></package>")
    (folder / "env-hooks/25.rover.sh.em").write_text(HOOK)
    (folder / "a.launch").write_text(f'<launch><arg name="world" default="$(env ROVER_WORLD)"/>{LAUNCH}</launch>')
    monkeypatch.chdir(tmp_path / "ws")
    for name in ("ROS_PACKAGE_PATH", "ROVER_BASE", "LD_PRELOAD"):
        monkeypatch.delenv(name, raising=False)
    return folder


def test_a_launch_has_the_variables_of_hooks(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As turtlebot_gazebo's, without which its launch files end at $(env TURTLEBOT_GAZEBO_WORLD_FILE)."""
    assert main(["launch", "rover_gazebo", "a.launch", "--dump-params"]) == 0

    printed = capsys.readouterr()
    for name, value in (
        ("base", "tracks"),
        ("world", f"{package}/worlds/yard.world"),
        ("map", f"{package}/maps/tracks.yaml"),
        ("home", f"{package}/home"),
        ("host", "none"),
        ("list", "none"),
        ("preload", "none"),
    ):
        assert f"/{name}: {value}\n" in printed.out
    assert "set ROVER_BASE, ROVER_WORLD, ROVER_MAP, ROVER_HOME as the environment hooks of rover_gazebo" in printed.err
    assert not list(package.parents[2].rglob("ran")), "nothing is run"
    assert main(["check", str(package / "a.launch"), "--strict"]) == 0


def test_a_variable_that_the_user_set_is_kept(
    package: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROVER_BASE", "wheels")

    assert main(["launch", str(package / "a.launch"), "--dump-params"]) == 0

    printed = capsys.readouterr().out
    assert "/base: wheels\n" in printed
    assert f"/map: {package}/maps/wheels.yaml\n" in printed


def test_a_robots_file_has_them_by_itself_and_in_a_launch(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    robot = package / "rover.urdf.xacro"
    robot.write_text(
        '<robot name="rover" base="$(env ROVER_BASE)" host="$(optenv ROVER_HOST no host)" map="$(optenv ROVER_MAP)"/>'
    )
    attributes = f'base="tracks" host="no host" map="{package}/maps/tracks.yaml" name="rover"'
    launch = package / "b.launch"
    launch.write_text(f'<launch><param name="robot_description" command="xacro {robot}"/></launch>')

    assert main(["xacro", str(robot)]) == 0
    assert f"<robot {attributes}/>" in capsys.readouterr().out
    assert main(["launch", str(launch), "--dump-params"]) == 0
    assert f"<robot {attributes}/>" in " ".join(capsys.readouterr().out.split())

    robot.write_text('<robot name="rover" host="$(env ROVER_HOST)"/>')
    assert main(["xacro", str(robot)]) == 1
    assert "environment variable 'ROVER_HOST' is not set" in capsys.readouterr().err


def test_a_program_has_them(package: Path) -> None:
    program = package / "scripts/base.py"
    program.parent.mkdir()
    program.write_text("#!/usr/bin/env python3\nimport os\nprint(os.environ['ROVER_BASE'])\n")
    program.chmod(0o755)

    words = [sys.executable, "-m", "trundle", "exec", "rover_gazebo", "base.py"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)

    assert done.stdout == "tracks\n", done.stderr
