"""Errors are one sentence with location and remedy, and exit code 1."""

import json
import socket
from pathlib import Path

import pytest

LINK = '<sdf version="1.6"><model name="m">\n<link name="a"/>\n{}\n</model></sdf>'


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("empty.sdf", "", "empty.sdf:1: error: the file is empty"),
        ("words.sdf", "hello", "words.sdf:1: error: not well-formed XML: the root element must start here, with '<'"),
        ("other.sdf", "<html/>", "other.sdf:1: error: <html> starts neither an SDF (<sdf>) nor a URDF (<robot>)"),
        (
            "joint.sdf",
            LINK.format('<joint name="hinge" type="revolute"><parent>a</parent><child>wheel</child></joint>'),
            "joint.sdf:3: error: joint 'hinge': no link 'wheel'; links here: 'a'",
        ),
        ("no.urdf", '<robot name="r"/>', "no.urdf:1: error: the robot has no links; is it a part to include"),
    ],
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_an_invalid_description_is_an_error(trundle, tmp_path: Path, command, name, text, message) -> None:
    (tmp_path / name).write_text(text)

    done = trundle(command, name, *(["--headless", "--no-ros"] if command == "run" else []))

    assert done.returncode == 1
    assert message in done.stderr + done.stdout
    assert "Traceback" not in done.stderr


def test_a_missing_file_is_an_error(trundle) -> None:
    done = trundle("run", "nowhere.sdf", "--headless")

    assert (done.returncode, done.stderr) == (1, "nowhere.sdf: error: no such file or folder [missing-file]\n")


def test_errors_of_check_are_printed_as_json(trundle, tmp_path: Path) -> None:
    (tmp_path / "empty.sdf").write_text("")

    done = trundle("check", "empty.sdf", "--json")

    assert done.returncode == 1
    assert json.loads(done.stdout) == {
        "kind": None,
        "models": [],
        "diagnostics": [
            {"severity": "error", "file": "empty.sdf", "line": 1, "message": "the file is empty", "id": "empty-file"}
        ],
    }


def test_errors_of_run_are_printed_as_json_with_a_similar_file_name(trundle, tmp_path: Path) -> None:
    (tmp_path / "robot.sdf").write_text("<sdf version='1.6'/>")

    done = trundle("run", "robt.sdf", "--json", "--headless")

    message = "no such file or folder (did you mean 'robot.sdf'?)"
    assert (done.returncode, done.stderr) == (1, f"robt.sdf: error: {message} [missing-file]\n")
    finding = {"severity": "error", "file": "robt.sdf", "line": None, "message": message, "id": "missing-file"}
    assert json.loads(done.stdout) == {"models": [], "diagnostics": [finding]}


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("msg show geometry_msgs/Twsit", "no message type 'geometry_msgs/Twsit' (did you mean 'geometry_msgs/Twist'?)"),
        ("msg show Twiist", "no message type 'Twiist' in any package (did you mean 'Twist'?)"),
        ("srv show std_srvs/Emtpy", "no service type 'std_srvs/Emtpy' (did you mean 'std_srvs/Empty'?)"),
        ("launch gazebo_ros empty_wrld.launch", "has no empty_wrld.launch (did you mean 'empty_world.launch'?)"),
        ("launch robot.lanch", "no such file: robot.lanch (did you mean 'robot.launch'?)"),
    ],
)
def test_a_misspelled_name_is_an_error_with_a_similar_name(trundle, tmp_path: Path, words: str, message: str) -> None:
    (tmp_path / "robot.launch").write_text("<launch/>")

    done = trundle(*words.split())

    assert done.returncode == 1
    assert message in done.stderr


def test_the_error_of_a_missing_package_lists_the_searched_folders(trundle, tmp_path: Path) -> None:
    done = trundle("launch", "no_such_package", "x.launch", ROS_PACKAGE_PATH=str(tmp_path))

    assert done.returncode == 1
    assert f"no package 'no_such_package'; looked below {tmp_path}" in done.stderr


def test_run_refuses_a_launch_file(trundle, tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text("<launch/>")

    done = trundle("run", "arm.xml", "--headless", "--no-ros")

    assert done.returncode == 1
    assert (
        done.stderr
        == "arm.xml:1: error: a launch file, not a robot or a world; `trundle launch` starts it [wrong-root]\n"
    )


def test_the_error_of_an_unknown_launch_argument_lists_the_arguments(trundle, tmp_path: Path) -> None:
    (tmp_path / "a.launch").write_text('<launch>\n<arg name="gui" default="true"/>\n</launch>')

    done = trundle("launch", "a.launch", "guy:=false")

    assert done.returncode == 1
    assert (
        done.stderr == "a.launch:1: error: no argument 'guy' to set; the file's arguments: 'gui' [unknown-argument]\n"
    )


def test_a_page_port_in_use_is_an_error_before_the_run(trundle, tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]

        done = trundle("run", "model://rp2w", "--no-ros", "--port", str(port), "--duration", "1")

    assert done.returncode == 1
    assert str(port) in done.stderr
    assert "Traceback" not in done.stderr


def test_a_second_core_on_the_same_port_is_an_error(start, trundle, master, until, env) -> None:
    port = env["ROS_MASTER_URI"].rpartition(":")[2]
    start("core", "-p", port)
    until("the first core", lambda: master.call("getPid"))

    done = trundle("core", "-p", port)

    assert done.returncode == 1
    assert port in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("words", [["run"], ["run", "x", "--speed", "fast"], ["fly"], ["topic", "fly"]])
def test_wrong_usage_exits_with_2(trundle, words) -> None:
    done = trundle(*words)

    assert done.returncode == 2
    assert "Traceback" not in done.stderr


def test_a_failing_plugin_is_a_warning_with_its_line(trundle, tmp_path: Path) -> None:
    (tmp_path / "model.sdf").write_text(LINK.format('<plugin name="p" filename="libp.so"/>'))
    (tmp_path / "p.py").write_text("import math\n\n1 / 0\n")

    done = trundle("run", "model.sdf", "--headless", "--no-ros", "--duration", "0.1", "--speed", "max")

    assert done.returncode == 0
    assert f"{tmp_path}/p.py:3: warning: plugin not loaded: ZeroDivisionError" in done.stderr
