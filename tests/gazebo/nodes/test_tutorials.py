"""Nodes and launch files of the ROS tutorials."""

from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.gazebo.nodes.catalog import BUILTIN_NODES
from trundle.robots.packages import Packages
from trundle.ros import TransformListener

STRING = "std_msgs/String"


@pytest.mark.parametrize(
    ("package", "text"), [("rospy_tutorials", "hello world 1"), ("roscpp_tutorials", "hello world ")]
)
def test_a_listener_receives_from_its_talker(graph, package: str, text: str) -> None:
    messages = graph.listen("/chatter", STRING)
    log = graph.listen("/rosout_agg", "rosgraph_msgs/Log")
    graph.start(f"{package}/listener")
    graph.start(f"{package}/talker")

    graph.until(lambda: len(messages) > 3)
    assert str(messages[-1].data).startswith(text)
    graph.until(lambda: any("I heard" in str(line.msg) and "hello world" in str(line.msg) for line in log))


@pytest.mark.parametrize(("package", "answer"), [("rospy_tutorials", "40 + 2 = 42"), ("roscpp_tutorials", "Sum: 42")])
def test_two_ints_are_added(graph, package: str, answer: str) -> None:
    log = graph.listen("/rosout_agg", "rosgraph_msgs/Log")
    graph.start(f"{package}/add_two_ints_server")

    assert graph.start(f"{package}/add_two_ints_client", "40 2").result(60.0) == 0

    graph.until(lambda: any(str(line.msg) == answer for line in log))
    assert graph.start(f"{package}/add_two_ints_client", "forty two").result(60.0) == 1


@pytest.mark.parametrize("package", ["turtle_tf", "turtle_tf2"])
def test_a_turtle_follows_another_by_tf(graph, package: str) -> None:
    graph.start("turtlesim/turtlesim_node", name="sim")
    for turtle in ("turtle1", "turtle2"):
        graph.start(f"{package}/{package}_broadcaster.py", name=f"{turtle}_broadcaster", turtle=turtle)
    graph.start(f"{package}/{package}_listener.py", name="pointer")
    buffer = TransformListener(graph.client).buffer

    graph.until(lambda: buffer.can_transform("turtle2", "turtle1"))
    start = abs(buffer.lookup_transform("turtle2", "turtle1").translation[0])
    assert start > 1.0
    graph.until(lambda: abs(buffer.lookup_transform("turtle2", "turtle1").translation[0]) < 0.5)


@pytest.mark.parametrize(
    ("package", "launch"),
    [
        ("rospy_tutorials", "talker_listener.launch"),
        ("roscpp_tutorials", "talker_listener.launch"),
        ("turtle_tf", "turtle_tf_demo.launch"),
        ("turtle_tf2", "turtle_tf2_demo.launch"),
    ],
)
def test_every_node_of_the_launch_files_is_found(package: str, launch: str, capsys: pytest.CaptureFixture[str]) -> None:
    folder = Packages({}, start=Path(__file__)).find_package(package)
    assert folder is not None
    assert main(["check", str(folder / "launch" / launch), "--strict"]) == 0
    assert "no findings" in capsys.readouterr().out
    assert any(owner == package for owner, _ in BUILTIN_NODES)
