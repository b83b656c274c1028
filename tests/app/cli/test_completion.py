"""Tab completion, called like a shell calls it."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from trundle.ros import StaticTransformBroadcaster, Transform


@pytest.fixture
def complete(graph: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Function that returns the completions of a command line."""
    node = graph.node("talker", params={"rate": 5})
    node.advertise("/chatter", "std_msgs/String")
    node.advertise_service("~enable", "std_srvs/SetBool", lambda _: {})
    StaticTransformBroadcaster(node).send_transform(Transform(parent="map", child="laser", stamp_ns=0))
    graph.ready(node)

    package = tmp_path / "my_robot"
    (package / "launch").mkdir(parents=True)
    (package / "launch/start.launch").write_text("<launch/>")
    (package / "package.xml").write_text("<package><name>my_robot</name></package>")
    (package / "drive").write_text("#!/bin/sh\n")
    (package / "drive").chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))

    def completions(line: str, **variables: str) -> list[str]:
        output = tmp_path / "words"
        argcomplete = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "_ARGCOMPLETE_STDOUT_FILENAME": str(output)}
        env = {**os.environ, **argcomplete, "COMP_LINE": line, "COMP_POINT": str(len(line)), **variables}
        subprocess.run([sys.executable, "-m", "trundle"], env=env, check=True, timeout=60)
        return output.read_text().split("\n")

    return completions


@pytest.mark.parametrize(
    ("line", "completion"),
    [
        ("trundle to", "topic "),
        ("trundle topic ec", "echo "),
        ("trundle topic echo /ch", "/chatter "),
        ("trundle topic pub /x std_msgs/Stri", "std_msgs/String "),
        ("trundle plot /ch", "/chatter "),
        ("trundle node info /ta", "/talker "),
        ("trundle node machine 127", "127.0.0.1 "),
        ("trundle tf echo map la", "laser "),
        ("trundle param get /talker/r", "/talker/rate "),
        ("trundle service call /talker/en", "/talker/enable "),
        ("trundle srv show std_srvs/SetB", "std_srvs/SetBool "),
        ("trundle topic pub /chatter s", "std_msgs/String "),
        ("trundle topic find std_msgs/Stri", "std_msgs/String "),
        ("trundle msg package turtles", "turtlesim "),
        ("trundle srv package std_s", "std_srvs "),
        ("trundle exec turtlesim turtlesim_", "turtlesim_node "),
        ("trundle exec my_robot dri", "drive "),
        ("trundle launch my_ro", "my_robot "),
        ("trundle launch my_robot st", "start.launch "),
        ("trundle run model://rp2w_c", "model://rp2w_camsave "),
        ("trundle check willow", "willowgarage.world "),
    ],
)
def test_words_and_names_of_the_graph_are_completed(complete: Any, line: str, completion: str) -> None:
    assert complete(line) == [completion]


@pytest.mark.parametrize("words", ["fix a.bag b.bag", "check a.bag -g"])
def test_rule_files_are_completed(complete: Any, tmp_path: Path, words: str) -> None:
    for name in ("rules.bmr", "rules.txt"):
        (tmp_path / name).touch()
    assert complete(f"trundle bag {words} {tmp_path}/ru") == [f"{tmp_path}/rules.bmr "]


def test_without_a_master_there_are_no_completions(complete: Any) -> None:
    assert complete("trundle node info /ta", ROS_MASTER_URI="http://127.0.0.1:9/") == [""]
