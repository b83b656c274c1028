"""`trundle exec`: which program runs, under which name, and how it ends."""

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
    """Two programs of one name, each of which prints its folder."""
    (tmp_path / "package.xml").write_text("<package><name>my_robot</name></package>")
    paths = [tmp_path / folder / "fly" for folder in ("new", "old")]
    for path in paths:
        path.parent.mkdir()
        path.write_text('#!/bin/sh\necho "$0"\n')
        path.chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    return paths


def test_without_a_terminal_the_first_runs_and_the_others_are_named(programs: list[Path]) -> None:
    first, other = programs
    done = subprocess.run(
        COMMAND, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE_S, check=True
    )
    assert done.stdout == f"{first}\n"
    assert done.stderr == f"[rosrun] Running {first}; of the same name are {other}\n"


def test_at_a_terminal_the_user_chooses(programs: list[Path]) -> None:
    ours, theirs = os.openpty()
    try:
        os.write(ours, b"3\n2\n")
        done = subprocess.run(COMMAND, stdin=theirs, capture_output=True, text=True, timeout=PATIENCE_S, check=True)
    finally:
        os.close(ours)
        os.close(theirs)
    assert done.stdout == (
        "[rosrun] You have chosen a non-unique executable, please pick one of the following:\n"
        f"1) {programs[0]}\n2) {programs[1]}\n#? ERROR: please enter a number from 1 to 2 (ctrl-C to cancel)\n"
        f"{programs[1]}\n"
    )
    assert done.stderr == ""


@pytest.mark.skipif(os.name != "posix", reason="Windows has no such signals")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_tool_that_is_told_to_end_closes_its_bag(graph: Any, tmp_path: Path, number: signal.Signals) -> None:
    node = graph.node("talker")
    node.advertise("/said", "std_msgs/String", latch=True).publish({"data": "hello"})
    graph.ready(node)
    active = tmp_path / "x.bag.active"
    with subprocess.Popen([*COMMAND[:4], "rosbag", "record", "-q", "-O", str(tmp_path / "x.bag"), "/said"]) as process:
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
def test_two_of_a_kind_run_beside_each_other_until_told_to_end(graph: Any) -> None:
    words = [*COMMAND[:4], "topic_tools", "relay", "/base/a", "/b"]
    with subprocess.Popen(words) as one, subprocess.Popen(words) as other:

        def relays() -> int:
            return graph.trundle("node", "list")[1].count("/a_relay_")

        try:
            graph.until(lambda: relays() == 2)
            for process in (one, other):
                process.send_signal(signal.SIGTERM)
                assert process.wait(PATIENCE_S) == 0
        finally:
            one.kill()
            other.kill()
    assert relays() == 0


def test_a_tool_takes_its_words_as_they_are(graph: Any) -> None:
    assert graph.trundle("exec", "rosparam", "rosparam", "set", "/a", "5") == (0, "", "")
    assert graph.trundle("exec", "rosparam", "rosparam", "get", "/a", "__name:=me") == (0, "5\n", "")
    assert graph.trundle("exec", "rosparam", "rosparam", "get", "/none")[0] == 1


def test_a_script_imports_rospy_without_an_installed_ros(programs: list[Path]) -> None:
    programs[1].unlink()
    programs[0].write_text(f"#!{sys.executable} -s\nimport rospy\nprint(rospy.__name__)\n")
    done = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert (done.returncode, done.stdout) == (0, "rospy\n")


def test_a_script_whose_python_has_no_rospy_is_told_the_way_out(programs: list[Path], tmp_path: Path) -> None:
    """Such as a Python of another version."""
    other = tmp_path / "other/python3"
    other.parent.mkdir()
    other.write_text(f'#!/bin/sh\nexec {sys.executable} -I -S "$@"\n')
    other.chmod(0o755)
    programs[1].unlink()
    programs[0].write_text(f"#!{other}\nimport rospy\n")
    done = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert done.returncode == 1
    first, *_ = done.stderr.splitlines()
    assert first.startswith(f"trundle exec: {programs[0]}: its Python has no rospy; ")


@pytest.mark.parametrize(
    ("text", "mode", "warning"),
    [
        ("#!/usr/bin/env python\nimport rospy\nprint(rospy.__name__)\n", 0o644, "is not executable"),
        ("#!/usr/bin/env python3\r\nimport rospy\r\nprint(rospy.__name__)\r\n", 0o755, "has the line ends of Windows"),
    ],
)
def test_scripts_that_the_system_would_refuse_run_with_a_warning(
    programs: list[Path], text: str, mode: int, warning: str
) -> None:
    """As git on Windows, and zip files, leave them."""
    programs[1].unlink()
    programs[0].write_bytes(text.encode())
    programs[0].chmod(mode)

    done = subprocess.run(COMMAND, capture_output=True, text=True, timeout=PATIENCE_S, check=False)

    assert (done.returncode, done.stdout) == (0, "rospy\n")
    assert f"trundle exec: warning: {programs[0]} {warning}; it is run nevertheless" in done.stderr
