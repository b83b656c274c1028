"""`trundle graph`, `log`, `exec` and `pack`."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

from trundle.app.cli import main
from trundle.base.drawing import Item, NodeGraph, graph_svg
from trundle.base.xmlnode import parse_xml
from trundle.ros import WallClock

STRING = "std_msgs/String"


def test_the_graph_is_drawn(graph: Any, tmp_path: Path) -> None:
    one, two = graph.node("one"), graph.node("two")
    one.advertise("/a", STRING)
    one.advertise("/unheard", STRING)
    two.subscribe("/a", STRING, print)
    graph.ready(one, two)
    assert graph.trundle("graph") == (
        0,
        'digraph graphname {\n  rankdir=LR;\n  "n_/one" [label="/one", shape=ellipse];\n'
        '  "n_/two" [label="/two", shape=ellipse];\n  "t_/a" [label="/a", shape=box];\n'
        '  "n_/one" -> "t_/a";\n  "t_/a" -> "n_/two";\n}\n',
        "",
    )
    assert '"t_/unheard"' in graph.trundle("graph", "-a")[1]
    assert json.loads(graph.trundle("graph", "--json")[1])["subscribers"]["/a"] == ["/two"]
    target = tmp_path / "graph.svg"
    assert graph.trundle("graph", "-o", str(target))[0] == 0
    texts = parse_xml(target.read_text(), name="graph.svg").all("text")
    left = {text.text: float(text.attribute("x") or 0) for text in texts}
    assert left["/one"] < left["/a"] < left["/two"]
    assert graph.trundle("graph", "-o", "graph.pdf")[0] == 1


def test_loops_are_drawn() -> None:
    items: list[Item] = [("node", "/a"), ("topic", "/t"), ("node", "/b"), ("topic", "/u")]
    circle = [(items[i], items[(i + 1) % 4]) for i in range(4)]
    picture = parse_xml(graph_svg(NodeGraph(items, circle)), name="x.svg")
    assert len([path for path in picture.all("path") if path.attribute("marker-end")]) == 4
    assert len({(rect.attribute("x"), rect.attribute("y")) for rect in picture.all("rect")}) == 5
    assert parse_xml(graph_svg(NodeGraph([], [])), name="x.svg").all("text") == []


@pytest.fixture
def chatter(graph: Any) -> Any:
    """Node that logs at each level repeatedly."""
    node, other = graph.node("motor"), graph.node("camera")

    async def talk() -> None:
        while True:
            node.log.info("spinning")
            node.log.warn("getting <hot>")
            other.log.error("lens cap on")
            await WallClock().sleep(0.05)

    graph.ready(node, other)
    talking = graph.loop.spawn(talk())
    yield node
    talking.cancel()


@pytest.mark.parametrize(
    ("arguments", "ends"),
    [
        (["-l", "warn", "-n", "/motor"], "[/motor]: getting <hot>"),
        (["-l", "error"], "[/camera]: lens cap on"),
        (["-g", "spin+ing"], "[/motor]: spinning"),
        (["-x", "spin|lens"], "[/motor]: getting <hot>"),
    ],
)
def test_log_messages_are_shown_and_filtered(graph: Any, chatter: Any, arguments: list[str], ends: str) -> None:
    code, out, _ = graph.trundle("log", "-c", "2", *arguments)
    assert code == 0
    assert len(out.splitlines()) == 2
    assert all(line.endswith(ends) for line in out.splitlines())


def test_log_messages_are_printed_as_json(graph: Any, chatter: Any) -> None:
    line = json.loads(graph.trundle("log", "-c", "1", "--json", "-l", "error")[1])
    assert (line["level"], line["node"], line["text"]) == ("error", "/camera", "lens cap on")
    assert graph.trundle("log", "-g", "(")[0] == 1


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, version, lines in (
        ("my_robot", 3, "<depend>my_msgs</depend><exec_depend>my_tools</exec_depend><depend>libboost</depend>"),
        ("my_tools", 1, "<run_depend>my_msgs</run_depend>"),
        ("my_two", 3, '<depend condition="$ROS_VERSION == 2">my_msgs</depend>'),
        ("my_msgs", 2, ""),
    ):
        folder = tmp_path / "src" / name
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(
            f'<package format="{version}"><name>{name}</name><version>1.0.0</version><description>x</description>'
            f'<maintainer email="a@example.com">a</maintainer><license>x</license>{lines}</package>'
        )
    script = tmp_path / "src" / "my_robot" / "scripts" / "drive"
    script.parent.mkdir()
    script.write_text('#!/bin/sh\necho "$@"\nexit 7\n')
    script.chmod(0o755)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    return tmp_path / "src"


def test_packages_and_their_dependencies_are_found(
    graph: Any, workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert graph.trundle("pack", "find", "my_robot")[1] == f"{workspace / 'my_robot'}\n"
    assert f"my_two {workspace / 'my_two'}\n" in graph.trundle("pack", "list")[1]
    assert graph.trundle("pack", "deps1", "my_robot")[1] == "my_tools\nmy_msgs\n"
    assert graph.trundle("pack", "depends", "my_robot")[1] == "my_msgs\nmy_tools\n"
    assert graph.trundle("pack", "depends-on1", "my_msgs")[1] == "my_robot\nmy_tools\n"
    assert graph.trundle("pack", "depends-on", "my_two")[1] == ""
    code, _, error = graph.trundle("pack", "find", "nobody")
    assert code == 1
    assert error.startswith("trundle pack: error: no package 'nobody'; looked below ")
    assert graph.trundle("pack", "find", "-q", "nobody") == (1, "", "")
    assert graph.trundle("pack", "find")[0] == 1
    monkeypatch.chdir(workspace / "my_tools")
    assert graph.trundle("pack", "find")[1] == f"{workspace / 'my_tools'}\n"


def test_cyclic_dependencies_are_listed_once(graph: Any, workspace: Path) -> None:
    manifest = workspace / "my_msgs" / "package.xml"
    manifest.write_text(manifest.read_text().replace("</package>", "<exec_depend>my_robot</exec_depend></package>"))
    assert graph.trundle("pack", "depends", "my_robot")[1] == "my_msgs\nmy_tools\n"


@pytest.mark.real_ros
def test_dependencies_are_equal_to_rospack(graph: Any, workspace: Path) -> None:
    """rospack ignores build and test dependencies."""
    if not Path("/usr/bin/rospack").exists():
        pytest.skip("Debian's rospack-tools is not installed")
    for name, dependencies in (
        ("built", "<buildtool_depend>my_two</buildtool_depend><build_depend>my_tools</build_depend>"),
        ("mixed", "<depend>built</depend><test_depend>my_two</test_depend><exec_depend>my_robot</exec_depend>"),
    ):
        text = (workspace / "my_robot/package.xml").read_text().replace("my_robot", name)
        (workspace / name).mkdir()
        (workspace / name / "package.xml").write_text(text.replace("</package>", f"{dependencies}</package>"))
    env = {"PATH": "/usr/bin", "ROS_PACKAGE_PATH": str(workspace), "ROS_VERSION": "1", "HOME": str(workspace)}
    for words in ("find mixed", "depends1 built", "depends1 mixed", "depends mixed", "deps my_robot"):
        process = subprocess.run(
            ["/usr/bin/rospack", *words.split()], env=env, capture_output=True, text=True, check=True, timeout=60
        )
        assert graph.trundle("pack", *words.split()) == (0, process.stdout, "")


def test_stock_nodes_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["exec", "--list"]) == 0
    assert "tf2_ros static_transform_publisher" in capsys.readouterr().out.splitlines()


def _exec(*arguments: str) -> "subprocess.Popen[str]":
    command = [sys.executable, "-m", "trundle", "exec", *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=dict(os.environ))


def test_a_program_of_a_package_is_run(graph: Any, workspace: Path) -> None:
    with _exec("my_robot", "drive", "-x", "1", "a:=b") as process:
        out, _ = process.communicate(timeout=60)
    assert (process.returncode, out) == (7, "-x 1 a:=b\n")
    with _exec("--prefix", "env -i", "my_robot", "drive") as process:
        assert process.communicate(timeout=60)[0] == "\n"
    code, _, error = graph.trundle("exec", "my_robot", "fly")
    assert code == 3
    assert "no executable 'fly' in" in error
    assert graph.trundle("exec", "my_rocket", "fly")[0] == 2
    with _exec("--debug", "my_robot", "drive") as process:
        program = f"{workspace / 'my_robot'}/scripts/drive"
        output = f"[rosrun] Looking in rospack dir: {workspace / 'my_robot'}\n[rosrun] Running  {program}\n\n"
        assert process.communicate(timeout=60)[0] == output


def test_a_stock_node_runs_until_sigint(graph: Any) -> None:
    messages: list[Any] = []
    graph.node("n").subscribe("/tf", "tf2_msgs/TFMessage", messages.append)
    words = ["0", "0", "0.1", "0", "0", "0", "base", "laser", "10", "__name:=mount"]
    with _exec("tf", "static_transform_publisher", *words) as process:
        try:
            graph.until(lambda: messages)
            assert "/mount\n" in graph.trundle("node", "list")[1]
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()
    graph.until(lambda: "/mount" not in graph.trundle("node", "list")[1])


@pytest.mark.slow
def test_gazebo_is_started_like_by_rosrun(graph: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The node's name is /gazebo for every program's name."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    client = graph.node("client")
    with _exec("gazebo_ros", "gzserver", "-u", "worlds/shapes.world") as process:
        try:
            graph.loop.run(client.wait_for_service("/gazebo/get_world_properties", PATIENCE_S), PATIENCE_S)
            call = client.call_service("/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties", {})
            names = graph.loop.run(call, PATIENCE_S).model_names
            assert list(names) == ["ground_plane", "box", "sphere", "cylinder"]
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()


@pytest.mark.parametrize(
    "command", ["topic list", "node list", "service list", "param list", "graph", "topic type /rosout"]
)
def test_light_commands_import_no_heavy_modules(graph: Any, command: str) -> None:
    """Neither asyncio nor numpy, so that they start fast."""
    code = (
        f"import sys; from trundle.app.cli import main; assert main({command.split()!r}) == 0;"
        "print([name for name in ('asyncio', 'numpy', 'rosbags', 'yaml', 'lxml') if name in sys.modules])"
    )
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert process.stdout.splitlines()[-1] == "[]"
