"""`trundle bag` with bags of format 1.2, and rosbag with the same files."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.ros.bags.rosrecord_bags import rosrecord_bag

from trundle.ros import BagConnection, BagMessage, Messages, open_bag

STRING = "std_msgs/String"


@pytest.fixture
def written() -> list[BagMessage]:
    messages = Messages()
    made = [
        BagConnection(topic=topic, type=STRING, md5sum=messages.md5(STRING), definition=messages.definition(STRING))
        for topic in ("/a", "/b")
    ]
    return [
        BagMessage(made[i % 4 == 3], 1_200_000_000_000_000_000 + i * 50_000_000, b"\x02\0\0\0%02d" % i)
        for i in range(12)
    ]


@pytest.mark.parametrize("has_index", [True, False])
@pytest.mark.parametrize("command", ["filter", "fix", "compress", "decompress", "reindex"])
def test_an_old_bag_becomes_a_new_one(
    graph: Any, tmp_path: Path, written: list[BagMessage], command: str, has_index: bool
) -> None:
    old, new = tmp_path / "old.bag", tmp_path / "out/old.bag"
    new.parent.mkdir()
    old.write_bytes(rosrecord_bag(written, has_index=has_index))
    words = {"filter": [old, new, "topic == '/a' or m.data > '00'"], "fix": [old, new]}
    arguments = [str(word) for word in words.get(command, ["--output-dir", new.parent, old])]
    assert graph.trundle("bag", command, *arguments)[0] == 0
    assert new.read_bytes().startswith(b"#ROSBAG V2.0\n")
    with open_bag(new) as bag:
        assert list(bag.messages()) == written


@pytest.mark.parametrize("has_index", [True, False])
def test_an_old_bag_is_checked_and_played(
    graph: Any, tmp_path: Path, written: list[BagMessage], has_index: bool
) -> None:
    old = tmp_path / "old.bag"
    old.write_bytes(rosrecord_bag(written, has_index=has_index))
    assert graph.trundle("bag", "check", str(old)) == (0, "Bag file does not need any migrations.\n", "")
    got: list[str] = []
    node = graph.node("listener")
    for topic in ("/a", "/b"):
        node.subscribe(topic, STRING, lambda m: got.append(m.data), queue_size=None)
    graph.ready(node)
    assert graph.trundle("bag", "play", "-q", "--wait-for-subscribers", str(old))[0] == 0
    graph.until(lambda: len(got) == len(written))
    assert sorted(got) == [f"{i:02}" for i in range(12)]


@pytest.mark.parametrize("command", ["info", "filter", "check", "fix", "compress"])
def test_a_bag_whose_index_was_never_written_is_to_be_reindexed(
    graph: Any, tmp_path: Path, written: list[BagMessage], command: str
) -> None:
    old, new = tmp_path / "old.bag", tmp_path / "new.bag"
    old.write_bytes(rosrecord_bag(written, is_closed=False))
    more = {"filter": [str(new), "True"], "fix": [str(new)]}.get(command, [])
    code, _, error = graph.trundle("bag", command, str(old), *more)
    assert (code, error) == (1, f"ERROR: bag unindexed: {old}.  Run trundle bag reindex.\n")
    assert graph.trundle("bag", "reindex", "-q", str(old)) == (0, "", "")
    with open_bag(old) as bag:
        assert list(bag.messages()) == written


@pytest.mark.slow
@pytest.mark.real_ros
def test_the_original_reads_the_same(
    graph: Any, original: Callable[..., str], tmp_path: Path, written: list[BagMessage]
) -> None:
    """It reads a bag with an index in C++, and one without in Python."""
    old, copy, ours = (tmp_path / f"{name}.bag" for name in ("old", "copy", "ours"))
    old.write_bytes(rosrecord_bag(written))
    assert graph.trundle("bag", "info", str(old))[1] == original("rosbag", "info", str(old))
    got: list[str] = []
    node = graph.node("listener")
    for topic in ("/a", "/b"):
        node.subscribe(topic, STRING, lambda m: got.append(m.data), queue_size=None)
    graph.ready(node)
    original("rosbag", "play", "-q", "--wait-for-subscribers", str(old))
    graph.until(lambda: len(got) == len(written))
    assert sorted(got) == [f"{i:02}" for i in range(12)]
    old.write_bytes(rosrecord_bag(written, has_index=False))
    original("rosbag", "filter", str(old), str(copy), "m.data > '04'")
    graph.trundle("bag", "filter", str(old), str(ours), "m.data > '04'")
    for path in (copy, ours):
        with open_bag(path) as bag:
            assert [(m.connection.topic, m.stamp_ns, m.data) for m in bag.messages()] == [
                (m.connection.topic, m.stamp_ns, m.data) for m in written[5:]
            ]
