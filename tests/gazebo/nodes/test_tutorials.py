"""The tutorials' own nodes and launch files."""

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
def test_a_talker_is_heard_by_its_listener(stage, package: str, text: str) -> None:
    heard = stage.listen("/chatter", STRING)
    log = stage.listen("/rosout_agg", "rosgraph_msgs/Log")
    stage.start(f"{package}/listener")
    stage.start(f"{package}/talker")

    stage.until(lambda: len(heard) > 3)
    assert str(heard[-1].data).startswith(text)
    stage.until(lambda: any("I heard" in str(line.msg) and "hello world" in str(line.msg) for line in log))


@pytest.mark.parametrize(("package", "answer"), [("rospy_tutorials", "40 + 2 = 42"), ("roscpp_tutorials", "Sum: 42")])
def test_two_ints_are_added(stage, package: str, answer: str) -> None:
    log = stage.listen("/rosout_agg", "rosgraph_msgs/Log")
    stage.start(f"{package}/add_two_ints_server")

    assert stage.start(f"{package}/add_two_ints_client", "40 2").result(60.0) == 0

    stage.until(lambda: any(str(line.msg) == answer for line in log))
    assert stage.start(f"{package}/add_two_ints_client", "forty two").result(60.0) == 1


@pytest.mark.parametrize("package", ["turtle_tf", "turtle_tf2"])
def test_a_turtle_follows_another_by_their_frames(stage, package: str) -> None:
    stage.start("turtlesim/turtlesim_node", name="sim")
    for turtle in ("turtle1", "turtle2"):
        stage.start(f"{package}/{package}_broadcaster.py", name=f"{turtle}_broadcaster", turtle=turtle)
    stage.start(f"{package}/{package}_listener.py", name="pointer")
    buffer = TransformListener(stage.client).buffer

    stage.until(lambda: buffer.can_transform("turtle2", "turtle1"))
    start = abs(buffer.lookup_transform("turtle2", "turtle1").translation[0])
    assert start > 1.0
    stage.until(lambda: abs(buffer.lookup_transform("turtle2", "turtle1").translation[0]) < 0.5)


@pytest.mark.parametrize(
    ("package", "launch"),
    [
        ("rospy_tutorials", "talker_listener.launch"),
        ("roscpp_tutorials", "talker_listener.launch"),
        ("turtle_tf", "turtle_tf_demo.launch"),
        ("turtle_tf2", "turtle_tf2_demo.launch"),
    ],
)
def test_their_launch_files_have_a_node_for_each_line(
    package: str, launch: str, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = Packages({}, start=Path(__file__)).find_package(package)
    assert folder is not None
    assert main(["check", str(folder / "launch" / launch), "--strict"]) == 0
    assert "no findings" in capsys.readouterr().out
    assert any(owner == package for owner, _ in BUILTIN_NODES)
