"""`trundle doctor` and roswtf: checks of the environment and faults of a running graph."""

import json
import os
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.graphs import Graph, running_graph

from trundle.app.cli import main
from trundle.app.doctor.check import Check, table
from trundle.app.doctor.environment_checks import environment_checks
from trundle.app.doctor.graph_faults import graph_faults
from trundle.app.doctor.machine import machine_checks
from trundle.ros import MasterProxy


@pytest.fixture
def graph() -> Iterator[Graph]:
    with running_graph() as running:
        yield running


def _checks(environment: dict[str, str], folder: Path) -> dict[str, Check]:
    env = {"HOME": str(folder), "ROS_HOME": str(folder / "ros"), **environment}
    return {check.name: check for check in environment_checks(env, folder)}


def test_states_of_machine_checks() -> None:
    checks = {check.name: check for check in machine_checks({"PATH": "/nowhere", "TERM": "dumb"})}

    assert [checks[name].state for name in ("python", "trundle", "mujoco")] == ["ok"] * 3
    assert checks["browser"].state == "missing"


def _compiler(folder: Path, **environment: str) -> Check:
    return next(check for check in machine_checks({"PATH": str(folder), **environment}) if check.name == "compiler")


def test_without_a_compiler_it_is_said_how_to_get_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)  # nor has Python one

    check = _compiler(tmp_path)

    assert check.state == "missing"
    assert "pip install 'trundle[cpp]'" in check.found
    assert "C++ nodes and plugins cannot be compiled" in check.cost


@pytest.mark.skipif(os.name != "posix", reason="the development kit is not for Windows")
def test_the_compiler_is_named_with_its_release(tmp_path: Path) -> None:
    for name in ("c++", "cmake", "ninja"):
        (tmp_path / name).write_text("#!/bin/sh\necho release 7\necho and more\n")
        (tmp_path / name).chmod(0o755)
    header = tmp_path / "include/boost/shared_ptr.hpp"
    header.parent.mkdir(parents=True)
    header.touch()

    check = _compiler(tmp_path, BOOST_ROOT=str(tmp_path))

    assert (check.state, check.found) == ("ok", f"{tmp_path}/c++: release 7")


def test_mujoco_and_mujoco_core_together_are_a_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.app.doctor.machine.version", "4.0.1".format)

    checks = {check.name: check for check in machine_checks({"PATH": ""})}

    assert (checks["mujoco"].state, checks["mujoco"].found) == ("problem", "mujoco-core 4.0.1 and mujoco 4.0.1")
    assert "pip uninstall mujoco mujoco-core && pip install mujoco-core==4.0.1" in checks["mujoco"].cost


def test_the_gpu_is_named_or_explained() -> None:
    gpu = {check.name: check for check in machine_checks({"PATH": ""})}["gpu"]

    if gpu.state == "ok":
        assert gpu.found.startswith("cuda")
    else:
        assert gpu.cost.startswith("many worlds at once are stepped by the processors: ")


def test_a_terminal_without_term_is_reported(capsys: pytest.CaptureFixture[str]) -> None:
    checks = {check.name: check for check in machine_checks({"PATH": ""})}
    assert "no TERM" in checks["terminal"].found


def test_wrong_variables_are_problems(tmp_path: Path) -> None:
    paths = f"{tmp_path}:{tmp_path / 'gone'}"
    variables = {
        "ROS_MASTER_URI": "http://no-such-host.invalid:11311",
        "ROS_HOSTNAME": "no-such-host.invalid",
        "ROS_PACKAGE_PATH": paths,
        "GAZEBO_MODEL_PATH": paths,
    }

    checks = _checks(variables, tmp_path)

    assert {name for name, check in checks.items() if check.state == "problem"} == set(variables)
    assert str(tmp_path / "gone") in checks["ROS_PACKAGE_PATH"].cost
    assert "set ROS_IP" in checks["ROS_HOSTNAME"].cost


def test_packages_and_models_are_counted(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / "src" / name).mkdir(parents=True)
        (tmp_path / "src" / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    before = int(_checks({}, tmp_path)["ROS_PACKAGE_PATH"].found.partition("; ")[2].split()[0])

    count = _checks({"ROS_PACKAGE_PATH": str(tmp_path / "src")}, tmp_path)["ROS_PACKAGE_PATH"].found

    assert count in (f"{before + 2} packages found; 1 folders", f"{before} packages found; 1 folders")


def test_a_running_master_is_distinguished_from_a_missing_one(graph: Graph, tmp_path: Path) -> None:
    assert "a master answers" in _checks({"ROS_MASTER_URI": graph.core.uri}, tmp_path)["ROS_MASTER_URI"].found
    silent = _checks({"ROS_MASTER_URI": "http://127.0.0.1:9"}, tmp_path)["ROS_MASTER_URI"]
    assert (silent.state, silent.cost) == ("missing", "roscore starts one")


def test_the_command_prints_a_table_and_json(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "gone"))
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:9")
    monkeypatch.setenv("HOME", str(tmp_path))

    assert main(["doctor", "--json"]) == 1
    checks = json.loads(capsys.readouterr().out)["checks"]
    assert {"name", "state", "found", "cost"} == set(checks[0])
    assert main(["doctor"]) == 1
    assert "problem  ROS_PACKAGE_PATH" in capsys.readouterr().out


def test_costs_are_printed_below_the_results() -> None:
    checks = [
        Check(name="a", state="ok", found="1"),
        Check(name="bcd", state="missing", found="none", cost="less"),
    ]
    assert table(checks).splitlines() == ["ok       a    1", "missing  bcd  none", "              → less"]


def test_a_healthy_graph_has_no_faults(graph: Graph) -> None:
    node = graph.node("talker")
    node.advertise("/chatter", "std_msgs/String")
    graph.node("listener").subscribe("/chatter", "std_msgs/String", lambda _: None)
    graph.ready(node)

    assert graph_faults(MasterProxy(graph.core.uri)) == []


def test_faults_of_a_graph_are_reported(graph: Graph) -> None:
    first, second = graph.node("first"), graph.node("second")
    first.advertise("/mixed", "std_msgs/String")
    second.subscribe("/mixed", "std_msgs/Float64", lambda _: None)
    second.subscribe("/lonely", "std_msgs/String", lambda _: None)
    graph.ready(first, second)
    proxy = MasterProxy(graph.core.uri, caller_id="/dead")
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        uri = f"http://127.0.0.1:{closed.getsockname()[1]}/"
    proxy.call("registerService", "/dead/serve", uri.replace("http", "rosrpc"), uri)
    proxy.call("setParam", "/use_sim_time", True)

    faults = {fault.what: fault for fault in graph_faults(proxy)}

    assert faults["Could not contact the following nodes:"].names == ("/dead",)
    assert faults["The following services belong to nodes that do not answer:"].names == ("/dead/serve (/dead)",)
    mixed = faults["The following topics are used with different types:"].names
    assert mixed == ("/mixed: std_msgs/Float64 by /second; std_msgs/String by /first",)
    assert faults["The following node subscriptions are unconnected:"].names == ("/lonely: /second",)
    assert not faults["The following node subscriptions are unconnected:"].is_error
    assert "Nodes wait for /clock, which no node publishes:" in faults


def test_roswtf_prints_its_report(
    graph: Graph, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    graph.node("second").subscribe("/lonely", "std_msgs/String", lambda _: None)
    monkeypatch.setenv("ROS_MASTER_URI", graph.core.uri)
    graph.until(lambda: "/lonely" in str(MasterProxy(graph.core.uri).call("getSystemState")))

    assert main(["--as", "roswtf"]) == 0

    printed = capsys.readouterr().out
    assert "Static checks summary:" in printed
    assert "Found 1 warning(s)." in printed
    assert "WARNING The following node subscriptions are unconnected:\n * /lonely: /second" in printed


def test_roswtf_reports_a_missing_master(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:9")

    assert main(["--as", "roswtf"]) == 0

    assert "ROS Master does not appear to be running." in capsys.readouterr().out
