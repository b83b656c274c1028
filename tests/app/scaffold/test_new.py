"""`trundle new`: its files have no findings, their tests pass, and nothing is overwritten."""

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.app.scaffold import ROBOTS
from trundle.base.diagnostics import UsageError
from trundle.ros.sdk import find_toolchain

_TIMEOUT_S = 300.0


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "own"  # packages next to it are found, and tmp_path is next to other tests' folders
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    return folder


def _pytest(folder: Path) -> None:
    """Run the generated tests in a new process."""
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test"]
    env = {key: value for key, value in os.environ.items() if not key.startswith(("PYTEST", "COV"))}
    process = subprocess.run(
        words, cwd=folder, env=env, capture_output=True, text=True, timeout=_TIMEOUT_S, check=False
    )
    assert process.returncode == 0, process.stdout + process.stderr


@pytest.mark.parametrize("kind", ROBOTS)
def test_robots_have_no_warnings(kind: str, folder: Path) -> None:
    assert main(["new", "robot", "rover", "--kind", kind]) == 0
    assert main(["check", "urdf/rover.urdf.xacro", "--strict"]) == 0
    assert main(["check", "launch/rover.launch", "--strict"]) == 0


@pytest.mark.parametrize(
    ("template", "name", "files"),
    [
        ("world", "yard", ["worlds/yard.world"]),
        ("plugin", "hover_box", ["models/hover_box"]),
        ("launch", "bringup", ["launch/bringup.launch"]),
    ],
)
def test_worlds_models_and_launch_files_have_no_warnings(
    template: str, name: str, files: list[str], folder: Path
) -> None:
    assert main(["new", template, name]) == 0
    for file in files:
        assert main(["check", file, "--strict"]) == 0


@pytest.mark.slow
def test_generated_tests_pass(folder: Path) -> None:
    for kind in ROBOTS:
        assert main(["new", "robot", f"my_{kind}", "--kind", kind]) == 0
    assert main(["new", "world", "yard"]) == 0
    assert main(["new", "plugin", "hover_box"]) == 0
    _pytest(folder)


@pytest.mark.slow
def test_the_generated_plugin_in_cpp_is_compiled_and_holds_its_height(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    monkeypatch.setenv("PATH", sysconfig.get_path("scripts"), prepend=os.pathsep)
    assert main(["new", "plugin", "--cpp", "hover_box"]) == 0
    _pytest(folder)


@pytest.mark.slow
def test_a_generated_package_node_and_message_work(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert main(["new", "package", "patrol"]) == 0
    package = folder / "patrol"
    monkeypatch.chdir(package)
    assert main(["new", "message", "WheelSpeed"]) == 0
    assert main(["new", "node", "circle"]) == 0
    assert main(["new", "launch", "bringup"]) == 0
    assert main(["check", "launch/patrol.launch", "--strict"]) == 0
    _pytest(package)
    for test in ("patrol", "circle"):
        words = [sys.executable, "-m", "trundle", "test", f"test/{test}.test"]
        env = {**os.environ, "ROS_TEST_RESULTS_DIR": str(folder / "results"), "ROS_HOME": str(folder / "ros")}
        process = subprocess.run(words, env=env, capture_output=True, text=True, timeout=_TIMEOUT_S, check=False)
        assert process.returncode == 0, process.stdout + process.stderr


@pytest.mark.slow
def test_a_package_and_a_node_in_cpp_are_compiled_and_tested(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    source = folder / "ws/src"
    source.mkdir(parents=True)
    monkeypatch.chdir(source)
    assert main(["new", "package", "--cpp", "patrol"]) == 0
    monkeypatch.chdir(source / "patrol")
    assert main(["new", "node", "--cpp", "circle"]) == 0
    env = {**os.environ, "PWD": str(folder / "ws"), "ROS_HOME": str(folder / "ros")}
    env.pop("CMAKE_PREFIX_PATH", None)
    for words in ([], ["run_tests"]):
        command = [sys.executable, "-m", "trundle", "--as", "catkin_make", *words]
        made = subprocess.run(command, cwd=folder / "ws", env=env, capture_output=True, text=True, check=False)
        assert made.returncode == 0, made.stdout + made.stderr
    results = sorted((folder / "ws/build/patrol/test_results").glob("*/rosunit-*.xml"))
    assert [result.name for result in results] == ["rosunit-check_circle.xml", "rosunit-check_patrol.xml"]
    for result in results:
        text = result.read_text()
        assert 'failures="0"' in text, text
        assert "test_the_command_is_that_of_the_parameters" in text, text


def test_existing_files_are_not_overwritten(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "launch").mkdir()
    (folder / "launch/rover.launch").write_text("mine")

    assert main(["new", "robot", "rover"]) == 1

    assert "launch/rover.launch exists already; nothing is written" in capsys.readouterr().err
    assert (folder / "launch/rover.launch").read_text() == "mine"
    assert not (folder / "urdf").exists()
    (folder / "taken").mkdir()
    assert main(["new", "package", "taken"]) == 1
    assert list((folder / "taken").iterdir()) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["node", "patrol"], "a node belongs in a package"),
        (["message", "Speed"], "a message belongs in a package"),
        (["robot", "../rover"], "is not a name"),
        (["world", "yard", "--kind", "arm"], "--kind is only for robots, not for a world"),
        (["world", "yard", "--cpp"], "--cpp is for packages, nodes and plugins, not for a world"),
        (["node", "patrol", "--cpp"], "a node belongs in a package"),
    ],
)
def test_invalid_arguments_are_explained(
    words: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", *words]) == 1
    assert message in capsys.readouterr().err
    assert list(folder.iterdir()) == []


def test_a_message_name_must_be_camel_case(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "package", "patrol"]) == 0
    assert main(["new", "message", "wheel_speed", "-C", "patrol"]) == 1
    assert "such as WheelSpeed" in capsys.readouterr().err
