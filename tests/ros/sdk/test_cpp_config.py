"""dynamic_reconfigure in a compiled program, changed by Trundle's tools."""

import math
import subprocess
import sys

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros.clients.reconfigure_client import find_reconfigurable, read_options, set_options

pytestmark = pytest.mark.slow


def test_parameters_are_listed_clamped_and_changed(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    told: list[str] = []
    node.subscribe("/told", "std_msgs/String", lambda message: told.append(message.data))
    graph.loop.run(node.params.set("/drive/gain", 99))
    running.start("drive", package="cpp_config")
    until(lambda: told)
    assert told == ["level 4294967295 mode 0 gain 10 frame base \\ ??/ is_on 1 speed 1 turns 0 depth -5 open 101"], (
        "the parameter is clamped to its largest value"
    )
    until(lambda: graph.loop.run(find_reconfigurable(node)) == ["/drive", "/drive/other"])

    options = {option.name: option for option in graph.loop.run(read_options(node, "/drive"))}
    assert list(options) == ["mode", "gain", "frame", "is_on", "speed", "turns", "depth"]
    assert (options["depth"].lower, options["depth"].upper, options["depth"].value) == (-10, -1, -5)
    assert options["speed"].upper == math.inf
    assert options["turns"].lower == -(2**31)

    graph.loop.run(set_options(node, "/drive", {"turns": 7, "depth": 3, "frame": "odom"}))
    until(lambda: len(told) == 2)
    assert told[1] == "level 100 mode 0 gain 10 frame odom is_on 1 speed 1 turns 7 depth -1 open 101"
    assert graph.loop.run(node.params.get("/drive/depth")) == -1
    values = graph.loop.run(set_options(node, "/drive", {"mode": 3}))
    assert values["gain"] == 9.0, "the callback changes it"
    assert {option.name: option.value for option in graph.loop.run(read_options(node, "/drive/other"))}["turns"] == 12

    tool = [sys.executable, "-m", "trundle", "--as", "rosrun", "dynamic_reconfigure", "dynparam", "get", "/drive"]
    shown = subprocess.run(tool, env=running.environment, capture_output=True, text=True, check=False)
    assert "'turns': 7" in shown.stdout, shown.stderr


def test_a_hostile_request_changes_nothing_else(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    told: list[str] = []
    node.subscribe("/told", "std_msgs/String", lambda message: told.append(message.data))
    process = running.start("drive", package="cpp_config")
    until(lambda: told)
    doubles = [{"name": "gain", "value": math.nan}, {"name": "speed", "value": 2.0}, {"name": "none", "value": 1.0}]
    request = {"config": {"doubles": doubles, "groups": [{"name": "Limits_of_it", "id": 1, "state": True}]}}
    until(lambda: graph.loop.run(find_reconfigurable(node)) == ["/drive", "/drive/other"])
    answer = graph.loop.run(node.call_service("/drive/set_parameters", "dynamic_reconfigure/Reconfigure", request))

    assert {item.name: item.value for item in answer.config.doubles} == {"gain": 0.5, "speed": 2.0}
    until(lambda: len(told) == 2)
    assert told[1].startswith("level 16 ")
    assert told[1].endswith("open 111")
    assert process.poll() is None


def test_a_client_reads_and_sets_the_parameters(running: Running) -> None:
    running.start("drive", package="cpp_config")
    process = running.start("steer", package="cpp_config")
    output, _ = process.communicate(timeout=WAIT_S)

    assert process.returncode == 0, output
    assert "callback turns 0 depth -5 gain 0.5\n" in output
    assert "set turns 3 depth -1 gain 0.5\n" in output, "the server clamps"
    assert "min turns -2147483648 depth -10 " in output
    assert output.endswith("\n00\n"), "no such node"
