"""`trundle exec`: choice of the program, node names, and exit."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

from trundle.ros import open_bag, recover_messages

COMMAND = [sys.executable, "-m", "trundle", "exec", "my_robot", "fly"]


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Two programs with the same name, which print their paths."""
    (tmp_path / "package.xml").write_text("<package><name>my_robot</name></package>")
    paths = [tmp_path / folder / "fly" for folder in ("new", "old")]
    for path in paths:
        path.parent.mkdir()
        path.write_text('#!/bin/sh\necho "$0"\n')
        path.chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    return paths


def test_without_a_terminal_the_first_of_several_programs_runs(programs: list[Path]) -> None:
    first, other = programs
    process = subprocess.run(
        COMMAND, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S, check=True
    )
    assert process.stdout == f"{first}\n"
    assert process.stderr == f"[rosrun] Running {first}; others of this name: {other}\n"


def test_at_a_terminal_the_user_chooses(programs: list[Path]) -> None:
    terminal, stdin = os.openpty()
    try:
        os.write(terminal, b"3\n2\n")
        process = subprocess.run(COMMAND, stdin=stdin, capture_output=True, text=True, timeout=PATIENCE_S, check=True)
    finally:
        os.close(terminal)
        os.close(stdin)
    assert process.stdout == (
        "[rosrun] You have chosen a non-unique executable, please pick one of the following:\n"
        f"1) {programs[0]}\n2) {programs[1]}\n#? ERROR: please enter a number from 1 to 2 (ctrl-C to cancel)\n"
        f"{programs[1]}\n"
    )
    assert process.stderr == ""


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_rosbag_record_closes_its_bag_on_a_signal(graph: Any, tmp_path: Path, number: signal.Signals) -> None:
    node = graph.node("talker")
    node.advertise("/chatter", "std_msgs/String", latch=True).publish({"data": "hello"})
    graph.ready(node)
    active = tmp_path / "x.bag.active"
    with subprocess.Popen(
        [*COMMAND[:4], "rosbag", "record", "-q", "-O", str(tmp_path / "x.bag"), "/chatter"]
    ) as process:
        try:
            graph.until(lambda: active.exists() and active.stat().st_size and list(recover_messages(active)))
            process.send_signal(number)
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()
    with open_bag(tmp_path / "x.bag") as bag:
        assert bag.counts == [1]
    assert not any(name.startswith("/record") for name in graph.trundle("node", "list")[1].split())


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals")
def test_two_anonymous_nodes_of_one_program_run_until_sigterm(graph: Any) -> None:
    words = [*COMMAND[:4], "topic_tools", "relay", "/base/a", "/b"]
    with subprocess.Popen(words) as first, subprocess.Popen(words) as second:

        def relays() -> int:
            return graph.trundle("node", "list")[1].count("/a_relay_")

        try:
            graph.until(lambda: relays() == 2)
            for process in (first, second):
                process.send_signal(signal.SIGTERM)
                assert process.wait(PATIENCE_S) == 0
        finally:
            first.kill()
            second.kill()
    assert relays() == 0


def test_arguments_of_a_ros_tool_are_passed_on(graph: Any) -> None:
    assert graph.trundle("exec", "rosparam", "rosparam", "set", "/a", "5") == (0, "", "")
    assert graph.trundle("exec", "rosparam", "rosparam", "get", "/a", "__name:=me") == (0, "5\n", "")
    assert graph.trundle("exec", "rosparam", "rosparam", "get", "/none")[0] == 1


def test_a_script_imports_rospy_without_an_installed_ros(programs: list[Path]) -> None:
    programs[1].unlink()
    programs[0].write_text(f"#!{sys.executable} -s\nimport rospy\nprint(rospy.__name__)\n")
    process = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert (process.returncode, process.stdout) == (0, "rospy\n")


def test_a_python_without_rospy_is_explained(programs: list[Path], tmp_path: Path) -> None:
    """For example a Python of another version."""
    other = tmp_path / "other/python3"
    other.parent.mkdir()
    other.write_text(f'#!/bin/sh\nexec {sys.executable} -I -S "$@"\n')
    other.chmod(0o755)
    programs[1].unlink()
    programs[0].write_text(f"#!{other}\nimport rospy\n")
    process = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert process.returncode == 1
    first, *_ = process.stderr.splitlines()
    assert first.startswith(f"trundle exec: {programs[0]}: its Python has no rospy; ")


@pytest.mark.parametrize(
    ("text", "mode", "warning"),
    [
        ("#!/usr/bin/env python\nimport rospy\nprint(rospy.__name__)\n", 0o644, "is not executable"),
        ("#!/usr/bin/env python3\r\nimport rospy\r\nprint(rospy.__name__)\r\n", 0o755, "has the line ends of Windows"),
    ],
)
def test_scripts_that_the_kernel_cannot_run_are_run_with_a_warning(
    programs: list[Path], text: str, mode: int, warning: str
) -> None:
    """git on Windows and zip files produce such scripts."""
    programs[1].unlink()
    programs[0].write_bytes(text.encode())
    programs[0].chmod(mode)

    process = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE_S, check=False)

    assert (process.returncode, process.stdout) == (0, "rospy\n")
    assert f"trundle exec: warning: {programs[0]} {warning}; it is run nevertheless" in process.stderr
