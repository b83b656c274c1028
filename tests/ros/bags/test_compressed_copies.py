"""Compressed images beside raw ones, which a launch that records everything leaves out."""

from pathlib import Path
from typing import Any

from trundle.ros import Recorder, RecorderOptions, StepRecorder, open_bag

_RAW, _COMPRESSED = "sensor_msgs/Image", "sensor_msgs/CompressedImage"


def _publishers(graph: Any) -> list[Any]:
    """A camera with both, and one of which there are compressed images alone."""
    node = graph.node("camera")
    topics = (("/eye", _RAW), ("/eye/compressed", _COMPRESSED), ("/web/compressed", _COMPRESSED))
    return [node.advertise(topic, kind, latch=True) for topic, kind in topics]


def test_a_launch_that_records_leaves_compressed_copies_alone(graph: Any, tmp_path: Path) -> None:
    """No subscriber, so that no image is compressed for the bag."""
    recorder = StepRecorder(graph.loop, tmp_path / "x.bag", on_failure=lambda _: None)
    publishers = _publishers(graph)
    for publisher in publishers:
        publisher.publish({})
    graph.loop.flush_deliveries()
    recorder.write(10**9)
    recorder.close()

    with open_bag(tmp_path / "x.bag") as bag:
        assert sorted(connection.topic for connection in bag.connections) == ["/eye", "/web/compressed"]
    assert [publisher.has_subscribers for publisher in publishers] == [True, False, True]


def test_a_recorder_of_all_topics_leaves_them_out_if_told(graph: Any, tmp_path: Path) -> None:
    """`rosbag record -a` has them, as in ROS."""
    for publisher in _publishers(graph):
        publisher.publish({})
    for name, without, count in (("all", False, 3), ("raw", True, 2)):
        options = RecorderOptions(
            all_topics=True, path=tmp_path / f"{name}.bag", without_copies=without, exclude="/rosout.*"
        )
        recorder = Recorder(graph.node(name), options, log=lambda _: None)
        recorder.start()
        graph.until(lambda recorder=recorder, count=count: recorder.recorded == count)
        recorder.stop()

    with open_bag(tmp_path / "raw.bag") as bag:
        assert sorted(connection.topic for connection in bag.connections) == ["/eye", "/web/compressed"]
