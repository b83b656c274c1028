"""`trundle bag` and rosbag with bags of format 1.2."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.ros.bags.rosrecord_bags import rosrecord_bag

from trundle.ros import BagConnection, BagMessage, Messages, open_bag

STRING = "std_msgs/String"


@pytest.fixture
def recorded() -> list[BagMessage]:
    messages = Messages()
    connections = [
        BagConnection(topic=topic, type=STRING, md5sum=messages.md5(STRING), definition=messages.definition(STRING))
        for topic in ("/a", "/b")
    ]
    return [
        BagMessage(connections[i % 4 == 3], 1_200_000_000_000_000_000 + i * 50_000_000, b"\x02\0\0\0%02d" % i)
        for i in range(12)
    ]


@pytest.mark.parametrize("has_index", [True, False])
@pytest.mark.parametrize("command", ["filter", "fix", "compress", "decompress", "reindex"])
def test_an_old_bag_is_converted_to_format_2(
    graph: Any, tmp_path: Path, recorded: list[BagMessage], command: str, has_index: bool
) -> None:
    old, new = tmp_path / "old.bag", tmp_path / "out/old.bag"
    new.parent.mkdir()
    old.write_bytes(rosrecord_bag(recorded, has_index=has_index))
    words = {"filter": [old, new, "topic == '/a' or m.data > '00'"], "fix": [old, new]}
    arguments = [str(word) for word in words.get(command, ["--output-dir", new.parent, old])]
    assert graph.trundle("bag", command, *arguments)[0] == 0
    assert new.read_bytes().startswith(b"#ROSBAG V2.0\n")
    with open_bag(new) as bag:
        assert list(bag.messages()) == recorded


@pytest.mark.parametrize("has_index", [True, False])
def test_an_old_bag_is_checked_and_played(
    graph: Any, tmp_path: Path, recorded: list[BagMessage], has_index: bool
) -> None:
    old = tmp_path / "old.bag"
    old.write_bytes(rosrecord_bag(recorded, has_index=has_index))
    assert graph.trundle("bag", "check", str(old)) == (0, "Bag file does not need any migrations.\n", "")
    received: list[str] = []
    node = graph.node("listener")
    for topic in ("/a", "/b"):
        node.subscribe(topic, STRING, lambda m: received.append(m.data), queue_size=None)
    graph.ready(node)
    assert graph.trundle("bag", "play", "-q", "--wait-for-subscribers", str(old))[0] == 0
    graph.until(lambda: len(received) == len(recorded))
    assert sorted(received) == [f"{i:02}" for i in range(12)]


@pytest.mark.parametrize("command", ["info", "filter", "check", "fix", "compress"])
def test_a_bag_without_its_index_must_be_reindexed(
    graph: Any, tmp_path: Path, recorded: list[BagMessage], command: str
) -> None:
    old, new = tmp_path / "old.bag", tmp_path / "new.bag"
    old.write_bytes(rosrecord_bag(recorded, is_closed=False))
    arguments = {"filter": [str(new), "True"], "fix": [str(new)]}.get(command, [])
    code, _, error = graph.trundle("bag", command, str(old), *arguments)
    assert (code, error) == (1, f"ERROR: bag unindexed: {old}.  Run trundle bag reindex.\n")
    assert graph.trundle("bag", "reindex", "-q", str(old)) == (0, "", "")
    with open_bag(old) as bag:
        assert list(bag.messages()) == recorded


@pytest.mark.slow
@pytest.mark.real_ros
def test_rosbag_reads_the_same_messages(
    graph: Any, original: Callable[..., str], tmp_path: Path, recorded: list[BagMessage]
) -> None:
    """rosbag reads indexed bags in C++ and unindexed bags in Python."""
    old, expected, filtered = (tmp_path / f"{name}.bag" for name in ("old", "expected", "filtered"))
    old.write_bytes(rosrecord_bag(recorded))
    assert graph.trundle("bag", "info", str(old))[1] == original("rosbag", "info", str(old))
    received: list[str] = []
    node = graph.node("listener")
    for topic in ("/a", "/b"):
        node.subscribe(topic, STRING, lambda m: received.append(m.data), queue_size=None)
    graph.ready(node)
    original("rosbag", "play", "-q", "--wait-for-subscribers", str(old))
    graph.until(lambda: len(received) == len(recorded))
    assert sorted(received) == [f"{i:02}" for i in range(12)]
    old.write_bytes(rosrecord_bag(recorded, has_index=False))
    original("rosbag", "filter", str(old), str(expected), "m.data > '04'")
    graph.trundle("bag", "filter", str(old), str(filtered), "m.data > '04'")
    for path in (expected, filtered):
        with open_bag(path) as bag:
            assert [(m.connection.topic, m.stamp_ns, m.data) for m in bag.messages()] == [
                (m.connection.topic, m.stamp_ns, m.data) for m in recorded[5:]
            ]
