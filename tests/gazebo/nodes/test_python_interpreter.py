"""Which Python runs a script of ROS 1."""

import os
import sys
from pathlib import Path

import pytest

from trundle.gazebo.nodes import command_prefix, lacks_rospy, missing_ros_module
from trundle.gazebo.nodes.python_interpreter import interpreter

pytestmark = pytest.mark.skipif(os.name != "posix", reason="only POSIX systems read a script's shebang")


@pytest.fixture
def debian(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The `bin` of a machine whose system Python has rospy."""
    python = _program(tmp_path / "usr" / "bin" / "python3")
    (tmp_path / "usr" / "modules" / "rospy").mkdir(parents=True)
    monkeypatch.setattr("trundle.gazebo.nodes.python_interpreter._DEBIAN_PYTHON", str(python))
    monkeypatch.setattr("trundle.gazebo.nodes.python_interpreter._DEBIAN_MODULES", str(tmp_path / "usr" / "modules"))
    return python.parent


@pytest.fixture
def venv(tmp_path: Path) -> Path:
    """The `bin` of a virtual environment without ROS."""
    _program(tmp_path / "venv" / "bin" / "python")
    return _program(tmp_path / "venv" / "bin" / "python3").parent


def _program(path: Path, text: str = "#!/bin/sh\n") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)
    return path


def _interpreter_for(folder: Path, first: str, *path: Path, imports: str = "rospy", **env: str) -> list[str]:
    script = _program(folder / "node.py", f"{first}\nimport {imports}\n")
    return interpreter(script, {"PATH": os.pathsep.join(map(str, path)), **env})


@pytest.mark.parametrize("first", ["#!/usr/bin/env python3", "#!/usr/bin/env python", "#! /usr/bin/env python  "])
def test_an_active_environment_without_rospy_is_skipped(tmp_path: Path, debian: Path, venv: Path, first: str) -> None:
    assert _interpreter_for(tmp_path, first, venv, debian) == [str(debian / "python3")]


def test_a_script_that_imports_trundle_runs_with_its_python(tmp_path: Path, debian: Path, venv: Path) -> None:
    imports = "rospy\nfrom trundle.gym import MlpPolicy"
    assert _interpreter_for(tmp_path, "#!/usr/bin/env python3", venv, debian, imports=imports) == [sys.executable]


def test_debians_python_is_used_by_the_script_itself(tmp_path: Path, debian: Path, venv: Path) -> None:
    assert _interpreter_for(tmp_path, "#!/usr/bin/env python3", debian, venv) == []


@pytest.mark.parametrize(
    ("text", "uses_this_python"),
    [
        ("from talking.words import WORD", True),
        ("from talking.msg import Word", True),
        ("from talking.cfg import VoiceConfig", True),
        ("import near, numpy, json", False),
    ],
)
def test_scripts_with_unbuilt_workspace_modules_run_with_this_python(
    tmp_path: Path, debian: Path, text: str, uses_this_python: bool
) -> None:
    package = tmp_path / "src" / "talking"
    script = _program(package / "scripts" / "node.py", f"#!/usr/bin/env python3\nimport rospy\n{text}\n")
    (package / "package.xml").write_text("<package><name>talking</name></package>")
    (package / "scripts" / "near.py").write_text("")
    (package / "src" / "talking").mkdir(parents=True)
    (package / "src" / "talking" / "__init__.py").write_text("")

    env = {"PATH": str(debian), "ROS_PACKAGE_PATH": str(tmp_path / "src")}
    assert interpreter(script, env) == ([sys.executable] if uses_this_python else [])
    if uses_this_python:  # built: on the path, as by devel/setup.sh
        (tmp_path / "devel" / "talking").mkdir(parents=True)
        assert interpreter(script, {**env, "PYTHONPATH": str(tmp_path / "devel")}) == []


@pytest.mark.parametrize("text", ["from talking.words import WORD", "import near"])
def test_a_package_script_gets_rospy_even_without_importing_it(
    tmp_path: Path, venv: Path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    """Catkin's layout: a thin script, with rospy imported by its package's module or a neighbouring file."""
    monkeypatch.setattr("trundle.gazebo.nodes.python_interpreter._DEBIAN_MODULES", str(tmp_path / "nothing"))
    package = tmp_path / "src" / "talking"
    script = _program(package / "scripts" / "node.py", f"#!/usr/bin/env python3\n{text}\n")
    (package / "package.xml").write_text("<package><name>talking</name></package>")

    assert interpreter(script, {"PATH": str(venv)}) == [sys.executable]


def test_imports_of_a_neighbouring_module_count(tmp_path: Path, debian: Path) -> None:
    package = tmp_path / "src" / "talking"
    script = _program(package / "scripts" / "node.py", "#!/usr/bin/env python3\nimport near\n")
    (package / "scripts" / "near.py").write_text("import rospy\nfrom talking.words import WORD\n")
    (package / "package.xml").write_text("<package><name>talking</name></package>")
    (package / "src" / "talking").mkdir(parents=True)
    (package / "src" / "talking" / "__init__.py").write_text("")

    env = {"PATH": str(debian), "ROS_PACKAGE_PATH": str(tmp_path / "src")}
    assert interpreter(script, env) == [sys.executable]


def test_a_rospy_installed_in_the_environment_is_used(tmp_path: Path, debian: Path, venv: Path) -> None:
    (venv.parent / "lib" / "python3.11" / "site-packages" / "rospy").mkdir(parents=True)

    assert _interpreter_for(tmp_path, "#!/usr/bin/env python3", venv, debian) == []


def test_a_rospy_on_the_python_path_is_used(tmp_path: Path, debian: Path, venv: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    (elsewhere / "rospy").mkdir(parents=True)

    assert _interpreter_for(tmp_path, "#!/usr/bin/env python3", venv, debian, PYTHONPATH=str(elsewhere)) == []


@pytest.mark.parametrize(
    ("first", "imports"), [("#!/usr/bin/env python3", "math"), ("#!/bin/sh", "rospy"), ("#!/opt/ros/python3", "rospy")]
)
def test_a_script_without_rospy_or_with_a_fixed_interpreter_keeps_its_shebang(
    tmp_path: Path, debian: Path, venv: Path, first: str, imports: str
) -> None:
    assert _interpreter_for(tmp_path, first, venv, debian, imports=imports) == []


@pytest.mark.parametrize("first", ["#!/usr/bin/env python", "#!/nowhere/bin/python"])
def test_a_missing_python_is_replaced_by_this_one(tmp_path: Path, first: str) -> None:
    assert _interpreter_for(tmp_path, first, tmp_path, imports="math") == [sys.executable]


@pytest.mark.parametrize(
    ("first", "words"),
    [
        ("#!/bin/bash -e", ["/bin/bash", "-e"]),
        ("#!/usr/bin/env bash", ["bash"]),
        ("#!/opt/venv/bin/python3\r", ["/opt/venv/bin/python3"]),
        ("no script", []),
    ],
)
def test_a_script_that_is_not_executable_is_started_by_its_shebang(
    tmp_path: Path, first: str, words: list[str]
) -> None:
    script = _program(tmp_path / "run", f"{first}\n")
    script.chmod(0o644)

    assert command_prefix(script, {"PATH": os.defpath}) == words


@pytest.mark.parametrize(
    ("output", "module"),
    [
        ("  File x\n    ModuleNotFoundError: No module named 'rospy'", "rospy"),
        ("ImportError: No module named rospy", "rospy"),
        ("ModuleNotFoundError: No module named 'geometry_msgs'", "geometry_msgs"),
        ("ModuleNotFoundError: No module named 'std_msgs.msg'", "std_msgs"),
        ("ModuleNotFoundError: No module named 'rospyx'", None),
        ("ModuleNotFoundError: No module named 'numpy'", None),
        ("it said: No module named 'rospy'", None),
    ],
)
def test_a_missing_ros_module_is_read_from_a_traceback(output: str, module: str | None) -> None:
    assert missing_ros_module(f"Traceback:\n{output}\n") == module


@pytest.mark.parametrize(("imports", "lacks"), [("rospy", True), ("math", False)])
def test_lacks_rospy_queries_the_interpreter_of_the_script(tmp_path: Path, imports: str, lacks: bool) -> None:
    script = _program(tmp_path / "node.py", f"#!{sys.executable} -s\nimport {imports}\n")
    assert lacks_rospy(script, {"PATH": os.defpath}) is lacks
    (tmp_path / "rospy").mkdir()
    assert not lacks_rospy(script, {"PATH": os.defpath, "PYTHONPATH": str(tmp_path)})
