"""pluginlib and nodelets in compiled programs."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros import Messages, Node

pytestmark = pytest.mark.slow


def test_plugins_are_created_and_faults_are_named(running: Running, workspace: Path) -> None:
    process = running.start("areas", f"{workspace}/devel/lib/libcpp_plugins.so", package="cpp_plugins")
    output, _ = process.communicate(timeout=WAIT_S)

    assert process.returncode == 0, output
    lines = output.splitlines()
    assert "shapes::Square Square cpp_plugins: A square & nothing else." in lines
    assert "shapes::Square 4 9" in lines
    assert "cpp_plugins/triangle 1.73205 3.89711" in lines
    assert (
        f"error: library {workspace}/devel/lib/libcpp_plugins.so does not export class shapes::Circle for this base "
        "class: PLUGINLIB_EXPORT_CLASS is missing, or names other classes."
    ) in lines
    assert any(
        line.startswith("error: According to the loaded plugin descriptions the class cpp_plugins/other with base")
        for line in lines
    )
    assert any(line.startswith("error: Unable to find package: no_such_package, which") for line in lines)
    assert lines[-2] in ("10", "11")
    assert lines[-1] == "loads 001 9 100 no library of this class loader has the class shapes::Square"


@pytest.mark.skipif(sys.platform != "linux", reason="libraries of macOS hide nothing")
def test_a_library_of_plugins_may_hide_its_symbols(workspace: Path) -> None:
    library = workspace / "devel/lib/libcpp_plugins.so"
    listed = subprocess.run(["nm", "-D", "--defined-only", library], capture_output=True, text=True, check=True)

    assert listed.stdout == ""


def _heard(node: Node, topic: str) -> list[str]:
    heard: list[str] = []
    node.subscribe(topic, "std_msgs/String", lambda message: heard.append(message.data))
    return heard


def _ask(node: Node, messages: Messages, topic: str, heard: list[str]) -> None:
    asked = node.advertise(topic, "std_msgs/String")

    def has_answer() -> bool:
        asked.publish(messages.new("std_msgs/String", {"data": "hello"}))
        return bool(heard)

    until(has_answer)
    asked.unregister()


def test_a_manager_loads_and_unloads_nodelets(running: Running, graph: Graph, messages: Messages) -> None:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/second/prefix", "two"))
    manager = running.start("nodelet", "manager", "__name:=boss", package="nodelet")
    loads = [
        running.start(
            "nodelet", "load", "cpp_plugins/Echo", "boss", "word", f"__name:={name}", f"out:=/said_by_{name}",
            package="nodelet",
        )
        for name in ("first", "second")
    ]  # fmt: skip
    first, second = _heard(node, "/said_by_first"), _heard(node, "/said_by_second")
    _ask(node, messages, "/in", first)
    _ask(node, messages, "/in", second)
    assert first[0] == "echo word: hello"
    assert second[0] == "two word: hello"

    def names() -> list[str]:
        return list(graph.loop.run(node.call_service("/boss/list", "nodelet/NodeletList", {})).nodelets)

    assert names() == ["/first", "/second"]
    loads[0].send_signal(signal.SIGINT)
    until(lambda: names() == ["/second"])
    assert loads[0].wait(WAIT_S) == 0
    loads[1].kill()  # the manager finds out by the bond
    until(lambda: names() == [])
    assert manager.poll() is None
    manager.send_signal(signal.SIGINT)
    output, _ = manager.communicate(timeout=WAIT_S)
    assert manager.returncode == 0, output
    assert "/first is ready" in output


def test_a_nodelet_that_cannot_be_loaded_is_named(running: Running, graph: Graph) -> None:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/sad/fails", True))
    for arguments, fault in (
        (("standalone", "cpp_plugins/Echo", "__name:=sad"), "Failed to load nodelet [/sad] of type [cpp_plugins/Echo]"),
        (("standalone", "cpp_plugins/None"), "the class cpp_plugins/None with base class type nodelet::Nodelet"),
        (("polish",), "usage: nodelet load CLASS MANAGER"),
    ):
        process = running.start("nodelet", *arguments, package="nodelet")
        output, _ = process.communicate(timeout=WAIT_S)
        assert process.returncode == 1
        assert fault in output


def test_a_launch_file_runs_compiled_nodelets(
    running: Running, graph: Graph, messages: Messages, tmp_path: Path
) -> None:
    launch = tmp_path / "echo.launch"
    launch.write_text("""<launch>
      <node pkg="nodelet" type="nodelet" name="boss" args="manager"/>
      <node pkg="nodelet" type="nodelet" name="echo" args="load cpp_plugins/Echo boss" output="screen">
        <remap from="out" to="answers"/>
        <param name="prefix" value="launched"/>
      </node>
    </launch>""")
    node = graph.node("tester")
    answers = _heard(node, "/answers")
    command = [sys.executable, "-m", "trundle", "--as", "roslaunch", str(launch)]
    with subprocess.Popen(
        command, env=running.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    ) as process:
        _ask(node, messages, "/in", answers)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=WAIT_S)
    assert answers[0] == "launched: hello"
    assert process.returncode == 0, output
