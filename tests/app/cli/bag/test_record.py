"""`trundle bag record`: its topics, its end and its file name."""

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

from trundle.ros import open_bag, recover_messages

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


def test_a_recording_without_messages_ends_after_its_duration(graph: Any, tmp_path: Path) -> None:
    """As in rosbag, the duration starts with the recording, not with the first message."""
    path = tmp_path / "x.bag"
    assert graph.trundle("bag", "record", "-q", "--duration", "0.5", "-O", str(path), "/silent")[0] == 0
    assert _counts(path) == {}


def test_a_recording_without_messages_is_split_by_duration(graph: Any, tmp_path: Path) -> None:
    with _recording(tmp_path / "x.bag", "--split", "--duration", "0.5", "/silent"):
        graph.until((tmp_path / "x_1.bag").exists)


def test_a_topic_is_recorded_in_addition_to_a_nodes_topics(graph: Any, tmp_path: Path) -> None:
    node = graph.node("talker")
    publishers = [node.advertise(topic, STRING, latch=True) for topic in ("/a", "/b", "/c")]
    for publisher in publishers:
        publisher.publish({"data": publisher.topic})
    graph.node("listener").subscribe("/a", STRING, lambda _: None)
    graph.ready(node)
    active = tmp_path / "x.bag.active"
    with _recording(tmp_path / "x.bag", "--node", "/listener", "/b"):
        graph.until(lambda: active.exists() and active.stat().st_size and len(list(recover_messages(active))) == 2)
    assert _counts(tmp_path / "x.bag") == {"/a": 1, "/b": 1}


@pytest.mark.real_ros
def test_the_suffix_bag_is_removed_from_a_prefix(graph: Any, original: Any, tmp_path: Path) -> None:
    node = graph.node("talker")
    node.advertise("/a", STRING, latch=True).publish({"data": "hello"})
    graph.ready(node)
    words = ["record", "-q", "-l", "1", "/a", "-o"]
    assert graph.trundle("bag", *words, str(tmp_path / "trundle.bag"))[0] == 0
    original("rosbag", *words, str(tmp_path / "rosbag.bag"))
    assert sorted(path.name.partition("_")[0] for path in tmp_path.glob("*.bag")) == ["rosbag", "trundle"]


@pytest.mark.parametrize("cause", ["full", "removed"])
def test_a_recording_that_cannot_be_written_fails(graph: Any, tmp_path: Path, cause: str) -> None:
    """The disk is full (the largest file is 20 blocks of 512 or 1024 bytes), or the folder was removed."""
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=None)
    folder = tmp_path / "bags"
    folder.mkdir()
    limit = 'ulimit -f 20 && exec "$@"' if cause == "full" else 'exec "$@"'
    trundle = (sys.executable, "-m", "trundle", "bag", "record", "-q", "-O", str(folder / "x.bag"), "-a")
    with subprocess.Popen(["sh", "-c", limit, "sh", *trundle], stderr=subprocess.PIPE, text=True) as process:
        try:
            graph.until(lambda: publisher.has_subscribers)
            if cause == "removed":
                shutil.rmtree(folder)
            while process.poll() is None:
                publisher.publish({"data": 1000 * "."})
                time.sleep(0.005)
            assert process.stderr is not None
            errors = process.stderr.read()
        finally:
            process.kill()
    reason = "File too large" if cause == "full" else "No such file or directory"
    assert process.returncode == 1
    assert f"recording failed: {folder}/x.bag.active: {reason}" in errors
    if cause == "full":
        assert {message.connection.topic for message in recover_messages(folder / "x.bag.active")} >= {"/a"}


@pytest.mark.slow
def test_a_launch_whose_recording_cannot_be_written_fails(tmp_path: Path) -> None:
    file = tmp_path / "a.launch"
    file.write_text(
        '<launch><node pkg="rostopic" type="rostopic" name="talk" '
        f'args="pub -r 100 /a std_msgs/String {3000 * "."}"/></launch>'
    )
    command = [sys.executable, "-m", "trundle", "launch", str(file), "--headless", "--record", str(tmp_path / "x.bag")]
    env = {**os.environ, "HOME": str(tmp_path), "ROS_MASTER_URI": "http://127.0.0.1:0"}
    limited = ["sh", "-c", 'ulimit -f 2000 && exec "$@"', "sh", *command]
    process = subprocess.run(limited, env=env, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    assert process.returncode == 1
    assert f"recording failed: {tmp_path}/x.bag.active: File too large" in process.stderr
