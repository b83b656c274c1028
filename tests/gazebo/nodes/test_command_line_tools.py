"""Command line tools run where launch files start them as nodes."""

from pathlib import Path

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.ros import MasterProxy


def test_rostopic_publishes(graph) -> None:
    messages = graph.listen("/greeting", "std_msgs/String")
    graph.start("rostopic/rostopic", "pub -r 10 /chatter std_msgs/String hello chatter:=greeting", name="pub")
    graph.until(lambda: messages)
    assert messages[0].data == "hello"


def test_rosparam_ends_with_its_exit_code(graph) -> None:
    assert graph.start("rosparam/rosparam", "set /a 5", name="set").result(PATIENCE_S) == 0
    assert graph.loop.run(graph.client.params.get("/a")) == 5
    assert graph.start("rosparam/rosparam", "get /none", name="get").result(PATIENCE_S) == 1


def test_a_recorded_bag_is_played(graph, tmp_path: Path) -> None:
    bag = tmp_path / "a.bag"
    source = graph.client.advertise("/chatter", "std_msgs/String")
    recorder = graph.start("rosbag/record", f"-O {bag} -l 3 /chatter", name="record")
    while not recorder.done():
        graph.until(lambda: source.has_subscribers or recorder.done())
        source.publish({"data": "hello"})
    assert recorder.result() == 0
    source.unregister()
    messages = graph.listen("/repeated", "std_msgs/String")
    graph.start("rosbag/play", f"-l {bag} chatter:=repeated", name="play")

    graph.until(lambda: messages)
    assert messages[0].data == "hello"
    # One node, with the topics and services of the launch file's node.
    publishers, _, services = map(dict, MasterProxy(graph.uri).call("getSystemState"))
    assert publishers["/repeated"] == services["/play/pause_playback"] == ["/play"]


@pytest.mark.slow
def test_view_frames_draws_into_the_working_directory(graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    graph.start("tf2_ros/static_transform_publisher", "1 2 3 0 0 0 base camera", name="still")
    assert graph.start("tf/view_frames").result(PATIENCE_S) == 0
    assert "camera" in (tmp_path / "frames.svg").read_text()
    assert graph.start("tf/tf_echo", "-n 1 base camera").result(PATIENCE_S) == 0
