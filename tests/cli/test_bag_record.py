"""`trundle bag record`: what is recorded until when, and under which name."""

import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.cli.conftest import PATIENCE_S

from trundle.ros import open_bag, recovered

STRING = "std_msgs/String"


@contextmanager
def _recording(path: Path, *words: str) -> Iterator[None]:
    """Record into a file until the block ends."""
    record = (sys.executable, "-m", "trundle", "bag", "record", "-q", "-O", str(path), *words)
    with subprocess.Popen(record) as process:
        try:
            yield
            process.send_signal(signal.SIGINT)
            assert process.wait(PATIENCE_S) == 0
        finally:
            process.kill()


def _counts(path: Path) -> dict[str, int]:
    with open_bag(path) as bag:
        return dict(zip([c.topic for c in bag.connections], bag.counts, strict=True))


def test_a_silent_recording_ends_at_its_time_too(graph: Any, tmp_path: Path) -> None:
    """The time is the recording's, as rosbag counts it; not that of its messages."""
    path = tmp_path / "x.bag"
    assert graph.trundle("bag", "record", "-q", "--duration", "0.5", "-O", str(path), "/silent")[0] == 0
    assert _counts(path) == {}


def test_a_silent_recording_is_split_at_its_times(graph: Any, tmp_path: Path) -> None:
    with _recording(tmp_path / "x.bag", "--split", "--duration", "0.5", "/silent"):
        graph.until((tmp_path / "x_1.bag").exists)


def test_a_topic_is_recorded_beside_those_of_a_node(graph: Any, tmp_path: Path) -> None:
    node = graph.node("talker")
    publishers = [node.advertise(topic, STRING, latch=True) for topic in ("/a", "/b", "/c")]
    for publisher in publishers:
        publisher.publish({"data": publisher.topic})
    graph.node("listener").subscribe("/a", STRING, lambda _: None)
    graph.ready(node)
    active = tmp_path / "x.bag.active"
    with _recording(tmp_path / "x.bag", "--node", "/listener", "/b"):
        graph.until(lambda: active.exists() and active.stat().st_size and len(list(recovered(active))) == 2)
    assert _counts(tmp_path / "x.bag") == {"/a": 1, "/b": 1}


@pytest.mark.real_ros
def test_a_prefix_that_ends_in_bag_loses_that(graph: Any, original: Any, tmp_path: Path) -> None:
    node = graph.node("talker")
    node.advertise("/a", STRING, latch=True).publish({"data": "hello"})
    graph.ready(node)
    words = ["record", "-q", "-l", "1", "/a", "-o"]
    assert graph.trundle("bag", *words, str(tmp_path / "ours.bag"))[0] == 0
    original("rosbag", *words, str(tmp_path / "theirs.bag"))
    assert sorted(path.name.partition("_")[0] for path in tmp_path.glob("*.bag")) == ["ours", "theirs"]
