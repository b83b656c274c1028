"""Command line tools run where launch files start them as nodes."""

from pathlib import Path

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.ros import MasterProxy


def test_rostopic_publishes(stage) -> None:
    heard = stage.listen("/told", "std_msgs/String")
    stage.start("rostopic/rostopic", "pub -r 10 /said std_msgs/String hello said:=told", name="pub")
    stage.until(lambda: heard)
    assert heard[0].data == "hello"


def test_rosparam_ends_with_its_exit_code(stage) -> None:
    assert stage.start("rosparam/rosparam", "set /a 5", name="set").result(PATIENCE_S) == 0
    assert stage.loop.run(stage.client.params.get("/a")) == 5
    assert stage.start("rosparam/rosparam", "get /none", name="get").result(PATIENCE_S) == 1


def test_what_was_recorded_is_played(stage, tmp_path: Path) -> None:
    bag = tmp_path / "a.bag"
    source = stage.client.advertise("/said", "std_msgs/String")
    recorder = stage.start("rosbag/record", f"-O {bag} -l 3 /said", name="record")
    while not recorder.done():
        stage.until(lambda: source.has_subscribers or recorder.done())
        source.publish({"data": "hello"})
    assert recorder.result() == 0
    source.unregister()
    heard = stage.listen("/repeated", "std_msgs/String")
    stage.start("rosbag/play", f"-l {bag} said:=repeated", name="play")

    stage.until(lambda: heard)
    assert heard[0].data == "hello"
    # One node, which has what the launch file's has.
    publishers, _, services = map(dict, MasterProxy(stage.uri).call("getSystemState"))
    assert publishers["/repeated"] == services["/play/pause_playback"] == ["/play"]


@pytest.mark.slow
def test_frames_are_drawn_where_view_frames_is_run(stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    stage.start("tf2_ros/static_transform_publisher", "1 2 3 0 0 0 base camera", name="still")
    assert stage.start("tf/view_frames").result(PATIENCE_S) == 0
    assert "camera" in (tmp_path / "frames.svg").read_text()
    assert stage.start("tf/tf_echo", "-n 1 base camera").result(PATIENCE_S) == 0
