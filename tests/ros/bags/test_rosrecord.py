"""Bags of format 1.2: read with and without an index, truncated and damaged anywhere."""

import tracemalloc
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import pytest
from tests.ros.bags.rosrecord_bags import record, rosrecord_bag

from trundle.ros import BagConnection, BagError, BagMessage, UnindexedBagError, open_bag, recover_messages

A = BagConnection(topic="/a", type="std_msgs/String", md5sum="992c", definition="string data\n")
B = replace(A, topic="/b")
WRITTEN = [BagMessage(B if i % 3 == 2 else A, 10**18 + i * 10**7, b"\x01\0\0\0%d" % i) for i in range(9)]


@pytest.mark.parametrize(("has_index", "version"), [(True, "1.2"), (False, "1.2 (unindexed)")])
@pytest.mark.parametrize("magic", [b"#ROSRECORD", b"#ROSBAG"])
def test_bags_of_rosrecord_are_read(tmp_path: Path, magic: bytes, has_index: bool, version: str) -> None:
    path = tmp_path / "x.bag"
    path.write_bytes(rosrecord_bag(WRITTEN, has_index=has_index).replace(b"#ROSRECORD", magic))
    with open_bag(path) as bag:
        assert list(bag.messages()) == WRITTEN
        assert (bag.version, bag.connections, bag.counts, bag.chunks) == (version, [A, B], [6, 3], [])
        assert (bag.start_ns, bag.end_ns) == (WRITTEN[0].stamp_ns, WRITTEN[-1].stamp_ns)
        some = bag.messages(lambda c: c == A, start_ns=WRITTEN[3].stamp_ns, end_ns=WRITTEN[7].stamp_ns)
        assert list(some) == [WRITTEN[i] for i in (3, 4, 6, 7)]
    assert list(recover_messages(path)) == WRITTEN


def test_messages_are_read_by_time_and_recovered_in_file_order(tmp_path: Path) -> None:
    mixed = [WRITTEN[i] for i in (4, 0, 8, 2)]
    (tmp_path / "x.bag").write_bytes(rosrecord_bag(mixed, has_index=False))
    with open_bag(tmp_path / "x.bag") as bag:
        assert list(bag.messages()) == [WRITTEN[i] for i in (0, 2, 4, 8)]
    assert list(recover_messages(tmp_path / "x.bag")) == mixed


def test_a_topic_without_a_definition_uses_another_of_its_type(tmp_path: Path) -> None:
    orphan = record({"op": b"\x02", "topic": "/b", "type": A.type, "sec": bytes(4), "nsec": bytes(4)}, b"data")
    (tmp_path / "x.bag").write_bytes(rosrecord_bag(WRITTEN[:1], has_index=False) + orphan)
    assert list(recover_messages(tmp_path / "x.bag")) == [WRITTEN[0], BagMessage(B, 0, b"data")]


def test_an_empty_bag_is_read(tmp_path: Path) -> None:
    (tmp_path / "x.bag").write_bytes(rosrecord_bag([]))
    with open_bag(tmp_path / "x.bag") as bag:
        assert (list(bag.messages()), bag.connections, bag.start_ns, bag.end_ns) == ([], [], 0, 0)


def test_a_bag_without_its_index_is_recovered(tmp_path: Path) -> None:
    path = tmp_path / "x.bag"
    path.write_bytes(rosrecord_bag(WRITTEN, is_closed=False))
    with pytest.raises(UnindexedBagError):
        open_bag(path)
    assert list(recover_messages(path)) == WRITTEN


@pytest.mark.parametrize("has_index", [True, False])
def test_complete_messages_are_recovered_from_a_bag_truncated_anywhere(tmp_path: Path, has_index: bool) -> None:
    path = tmp_path / "x.bag"
    whole = rosrecord_bag(WRITTEN, has_index=has_index)
    for size in range(16, len(whole), 11):
        path.write_bytes(whole[:size])
        recovered = list(recover_messages(path))
        assert recovered == WRITTEN[: len(recovered)]
        with suppress(UnindexedBagError), open_bag(path) as bag:
            assert list(bag.messages()) == recovered


@pytest.mark.parametrize("damage", [0x00, 0x7F, 0xFF])
def test_a_bag_with_a_damaged_byte_raises_only_bag_errors(tmp_path: Path, damage: int) -> None:
    path = tmp_path / "x.bag"
    whole = rosrecord_bag(WRITTEN, has_index=False)
    for at in range(len(whole)):
        path.write_bytes(whole[:at] + bytes([damage]) + whole[at + 1 :])
        with suppress(BagError):
            list(recover_messages(path))
        with suppress(BagError), open_bag(path) as bag:
            list(bag.messages())


def test_a_length_beyond_the_file_allocates_no_memory(tmp_path: Path) -> None:
    path = tmp_path / "x.bag"
    for end in (b"\xff\xff\xff\x7f", record({"op": b"\x02"})[:-4] + b"\xff\xff\xff\x7f"):
        path.write_bytes(rosrecord_bag(WRITTEN, has_index=False) + end)
        tracemalloc.start()
        assert list(recover_messages(path)) == WRITTEN
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert peak < 10**6
        with pytest.raises(UnindexedBagError):
            open_bag(path)


def test_unsupported_versions_are_reported(tmp_path: Path) -> None:
    (tmp_path / "x.bag").write_bytes(b"#ROSRECORD V1.1\n")
    with pytest.raises(BagError, match=r"x\.bag is a bag of format 1\.1; only 1\.2 and 2\.0 are supported"):
        open_bag(tmp_path / "x.bag")
