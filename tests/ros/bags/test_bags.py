"""Bags in both formats: written, read, truncated, damaged, recorded and played."""

import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import SeekingReader
from mcap.writer import IndexType, Writer
from tests.ros.conftest import PATIENCE_S

from trundle.app.cli import main
from trundle.ros import (
    BagConnection,
    BagError,
    BagMessage,
    Messages,
    MessageView,
    Player,
    PlayerOptions,
    Recorder,
    RecorderOptions,
    StepRecorder,
    UnindexedBagError,
    create_bag,
    open_bag,
    recover_messages,
)

FORMATS = [
    *[("x.bag", compression) for compression in ("none", "bz2", "lz4")],
    *[("x.mcap", compression) for compression in ("none", "lz4", "zstd")],
]
STRING = "std_msgs/String"


def _connection(messages: Messages, topic: str, *, caller: str = "/n", latching: bool = False) -> BagConnection:
    return BagConnection(
        topic=topic,
        type=STRING,
        md5sum=messages.md5(STRING),
        definition=messages.definition(STRING),
        caller=caller,
        latching=latching,
    )


def _stream(messages: Messages, count: int) -> Iterator[BagMessage]:
    one, two = _connection(messages, "/a"), _connection(messages, "/b", caller="/m", latching=True)
    for i in range(count):
        data = bytes(messages.serialize(messages.new(STRING, {"data": f"text {i} " * 5})))
        yield BagMessage(two if i % 3 == 0 else one, 1_700_000_000_000_000_000 + i * 10_000_000, data)


@pytest.mark.parametrize(("name", "compression"), FORMATS)
def test_written_messages_are_read_back(messages: Messages, tmp_path: Path, name: str, compression: str) -> None:
    written = list(_stream(messages, 200))
    with create_bag(tmp_path / name, compression=compression, chunk_bytes=2000) as out:
        for message in written:
            out.write(message)
    with open_bag(tmp_path / name) as bag:
        assert list(bag.messages()) == written
        assert (bag.start_ns, bag.end_ns) == (written[0].stamp_ns, written[-1].stamp_ns)
        assert dict(zip([c.topic for c in bag.connections], bag.counts, strict=True)) == {"/b": 67, "/a": 133}
        assert {chunk.compression for chunk in bag.chunks} == {compression}
        assert len(bag.chunks) > 3
        some = bag.messages(lambda c: c.topic == "/b", start_ns=written[3].stamp_ns, end_ns=written[9].stamp_ns)
        assert list(some) == [written[3], written[6], written[9]]
    assert list(recover_messages(tmp_path / name)) == written


@pytest.mark.parametrize(("name", "compression"), FORMATS)
def test_times_are_read_from_the_index(
    messages: Messages, tmp_path: Path, name: str, compression: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No message is read."""
    written = list(_stream(messages, 200))
    with create_bag(tmp_path / name, compression=compression, chunk_bytes=2000) as out:
        for message in written:
            out.write(message)
    with open_bag(tmp_path / name) as bag:
        monkeypatch.setattr(type(bag), "messages", None)
        assert bag.stamps_ns() == _times_of(written)


def test_times_are_read_from_the_messages_of_a_file_without_message_indexes(
    messages: Messages, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kinds = IndexType.CHUNK | IndexType.ATTACHMENT | IndexType.METADATA
    monkeypatch.setattr("trundle.ros.bags.mcap.Writer", partial(Writer, index_types=kinds))
    written = list(_stream(messages, 20))
    with create_bag(tmp_path / "x.mcap") as out:
        for message in written:
            out.write(message)
    with open_bag(tmp_path / "x.mcap") as bag:
        assert bag.stamps_ns() == _times_of(written)


def test_overlapping_indexes_are_refused(messages: Messages, tmp_path: Path) -> None:
    """Each could claim the rest of the file as entries, so that a small file had more times than fit into memory."""
    path = tmp_path / "x.mcap"
    with create_bag(path) as out:
        for message in _stream(messages, 20):
            out.write(message)
    with path.open("r+b") as file:
        summary = SeekingReader(file).get_summary()
        assert summary is not None
        first = min(summary.chunk_indexes[0].message_index_offsets.values())
        file.seek(first + 11)  # opcode, length and channel
        file.write((1000).to_bytes(4, "little"))
    with open_bag(path) as bag, pytest.raises(BagError, match="damaged: no index at byte"):
        bag.stamps_ns()


def test_times_beyond_the_year_2262_are_refused(messages: Messages, tmp_path: Path) -> None:
    path = tmp_path / "x.mcap"
    with create_bag(path) as writer:
        writer.write(BagMessage(_connection(messages, "/a"), 2**63, b"\0\0\0\0"))
    with pytest.raises(BagError, match="is damaged: its messages are from"):
        open_bag(path)


def _times_of(written: list[BagMessage]) -> dict[str, list[int]]:
    return {topic: [m.stamp_ns for m in written if m.connection.topic == topic] for topic in ("/a", "/b")}


@pytest.mark.parametrize(("name", "compression"), FORMATS)
def test_flushed_messages_are_recovered_from_a_bag_truncated_anywhere(
    messages: Messages, tmp_path: Path, name: str, compression: str
) -> None:
    written = list(_stream(messages, 30))
    path = tmp_path / name
    out = create_bag(path, compression=compression)
    flushed: list[int] = []
    for i, message in enumerate(written):
        out.write(message)
        if i % 10 == 9:
            out.flush()
            flushed.append(path.stat().st_size)
    out.close()
    whole = path.read_bytes()
    cut = tmp_path / f"cut{path.suffix}"
    for size in range(0, len(whole), 7):
        cut.write_bytes(whole[:size])
        try:
            recovered = list(recover_messages(cut))
        except BagError:
            assert size < 13  # not even the format is known
            continue
        assert recovered == written[: len(recovered)]
        assert len(recovered) >= 10 * sum(size >= end for end in flushed)
        if size < flushed[-1]:
            with pytest.raises(BagError):
                open_bag(cut)


@pytest.mark.parametrize(("name", "compression"), FORMATS)
def test_a_bag_with_a_damaged_byte_raises_only_bag_errors(
    messages: Messages, tmp_path: Path, name: str, compression: str
) -> None:
    path = tmp_path / name
    with create_bag(path, compression=compression) as out:
        for message in _stream(messages, 6):
            out.write(message)
    whole = path.read_bytes()
    for at in [*range(120), *range(max(120, len(whole) - 900), len(whole), 5)]:
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 0xFF]) + whole[at + 1 :])
        for read in (lambda: list(recover_messages(path)), lambda: _messages_in(path), lambda: _times_in(path)):
            with suppress(BagError):
                read()


def _messages_in(path: Path) -> list[BagMessage]:
    with open_bag(path) as bag:
        return list(bag.messages())


def _times_in(path: Path) -> dict[str, list[int]]:
    with open_bag(path) as bag:
        return bag.stamps_ns()


def test_files_that_are_not_bags_are_reported(tmp_path: Path) -> None:
    with pytest.raises(BagError, match="cannot be read: No such file"):
        open_bag(tmp_path / "none.bag")
    (tmp_path / "text.bag").write_text("hello")
    with pytest.raises(BagError, match=r"text\.bag cannot be read: File magic is invalid"):
        open_bag(tmp_path / "text.bag")
    with pytest.raises(BagError, match="zstd compression is not supported"):
        create_bag(tmp_path / "x.bag", compression="zstd")
    with pytest.raises(BagError, match="bz2 compression is not supported"):
        create_bag(tmp_path / "x.mcap", compression="bz2")


@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_a_graph_is_recorded_and_played(graph: Any, tmp_path: Path, name: str) -> None:
    talker, node, listener = graph.node("talker"), graph.node("record"), graph.node("listener")
    publisher = talker.advertise("/a", STRING, queue_size=None)
    fixed = talker.advertise("/fixed", "geometry_msgs/Point", latch=True)
    fixed.publish({"x": 1.5})
    recorder = Recorder(node, RecorderOptions(all_topics=True, path=tmp_path / name), log=lambda _: None)
    recorder.start()
    graph.until(lambda: publisher.has_subscribers and fixed.has_subscribers)
    for i in range(100):
        publisher.publish({"data": str(i)})
    graph.until(lambda: recorder.recorded >= 101)
    assert not (tmp_path / name).exists()
    recorder.stop()
    assert recorder.files == [tmp_path / name]

    got: list[str] = []
    with open_bag(tmp_path / name) as bag:
        assert {(c.topic, c.caller, c.latching) for c in bag.connections} >= {
            ("/a", "/talker", False),
            ("/fixed", "/talker", True),
        }
        listener.subscribe("/again/a", STRING, lambda m: got.append(m.data), queue_size=None)
        player = Player(graph.node("play"), [bag], PlayerOptions(prefix="/again", immediate=True, queue_size=1000))
        publishers = player.advertise()
        graph.until(lambda: any(p.has_subscribers for p in publishers))
        player.play(lambda: None)
        graph.until(lambda: len(got) == 100)
        latched: list[float] = []
        listener.subscribe("/again/fixed", "geometry_msgs/Point", lambda m: latched.append(m.x))
        graph.until(lambda: latched == [1.5])
    assert got == [str(i) for i in range(100)]


def test_a_recording_splits_and_keeps_the_newest(graph: Any, tmp_path: Path) -> None:
    publisher = graph.node("talker").advertise("/a", "std_msgs/UInt8MultiArray", queue_size=None)
    options = RecorderOptions(
        topics=("/a",), path=tmp_path / "x.bag", splits=True, max_bytes=100_000, max_splits=2, chunk_bytes=10_000
    )
    recorder = Recorder(graph.node("record"), options, log=lambda _: None)
    recorder.start()
    graph.until(lambda: publisher.has_subscribers)
    for i in range(50):
        publisher.publish({"data": bytes(10_000)})
        graph.until(lambda i=i: recorder.recorded == i + 1)
    recorder.stop()
    assert len(recorder.files) <= 3
    assert sorted(tmp_path.iterdir()) == sorted(recorder.files)
    assert all(path.name.startswith("x_") for path in recorder.files)


def test_messages_beyond_the_buffer_are_dropped_with_a_warning(graph: Any, tmp_path: Path, capfd: Any) -> None:
    publisher = graph.node("talker").advertise("/a", "std_msgs/UInt8MultiArray", queue_size=None)
    options = RecorderOptions(topics=("/a",), path=tmp_path / "x.bag", buffer_bytes=5_000)
    recorder = Recorder(graph.node("record"), options, log=lambda _: None)
    recorder.start()
    graph.until(lambda: publisher.has_subscribers)
    for size in (10_000, 10_000, 100):
        publisher.publish({"data": bytes(size)})
    graph.until(lambda: recorder.recorded + recorder.dropped == 3)
    recorder.stop()
    assert recorder.dropped == 2
    assert capfd.readouterr().err.count("rosbag record buffer exceeded.  Dropping oldest queued message.") == 1


def test_a_recording_ends_at_its_limit(graph: Any, tmp_path: Path) -> None:
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=None)
    recorder = Recorder(
        graph.node("record"), RecorderOptions(topics=("/a",), path=tmp_path / "x.bag", limit=3), log=lambda _: None
    )
    recorder.start()
    graph.until(lambda: publisher.has_subscribers)
    for i in range(10):
        publisher.publish({"data": str(i)})
    assert recorder.done.wait(PATIENCE_S)
    recorder.stop()
    with open_bag(tmp_path / "x.bag") as bag:
        assert bag.counts == [3]


def test_latched_messages_count_towards_the_limit(graph: Any, tmp_path: Path) -> None:
    """Several publishers each send their latched message once connected."""
    for number in range(5):
        graph.node(f"n{number}").advertise("/a", STRING, latch=True).publish({"data": str(number)})
    recorder = Recorder(
        graph.node("record"), RecorderOptions(topics=("/a",), path=tmp_path / "x.bag", limit=2), log=lambda _: None
    )
    recorder.start()
    assert recorder.done.wait(PATIENCE_S)
    graph.loop.flush_deliveries()
    recorder.stop()
    with open_bag(tmp_path / "x.bag") as bag:
        assert sum(bag.counts) == 2


def test_latched_messages_are_repeated_in_each_new_file(graph: Any, tmp_path: Path) -> None:
    fixed = graph.node("mapper").advertise("/map", STRING, latch=True)
    fixed.publish({"data": "the map"})
    publisher = graph.node("talker").advertise("/a", "std_msgs/UInt8MultiArray", queue_size=None)
    options = RecorderOptions(
        topics=("/a", "/map"),
        path=tmp_path / "x.bag",
        splits=True,
        max_bytes=50_000,
        repeats_latched=True,
        announces=True,
    )
    files: list[str] = []
    node = graph.node("record")
    graph.node("listener").subscribe("/begin_write", STRING, lambda m: files.append(m.data))
    recorder = Recorder(node, options, log=lambda _: None)
    recorder.start()
    graph.until(lambda: publisher.has_subscribers and fixed.has_subscribers and files)
    for i in range(20):
        publisher.publish({"data": bytes(10_000)})
        graph.until(lambda i=i: recorder.recorded == i + 2)
    graph.until(lambda: len(files) > 2)
    recorder.stop()
    assert [str(path) for path in recorder.files] == files
    for path in recorder.files:
        with open_bag(path) as bag:
            assert [m.data[4:] for m in bag.messages(lambda c: c.topic == "/map")] == [b"the map"]


def test_messages_published_too_fast_for_their_queue_are_counted(graph: Any, far: Any) -> None:
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=3)
    got: list[str] = []
    far.node("listener").subscribe("/a", STRING, lambda m: got.append(m.data), queue_size=None)
    graph.until(lambda: publisher.has_subscribers)

    async def burst() -> None:
        for i in range(10):
            publisher.publish({"data": str(i)})

    graph.loop.run(burst())
    graph.until(lambda: got == ["7", "8", "9"])
    assert publisher.dropped == 7


def test_playing_from_an_offset_starts_with_a_message_and_the_latched_ones(graph: Any, tmp_path: Path) -> None:
    """As in rosbag: no initial gap, and latched messages from before the start, such as a map, are published."""
    plain = BagConnection(topic="/a", type=STRING, md5sum=Messages().md5(STRING), definition="string data\n")
    latched = replace(plain, topic="/map", latching=True)
    with create_bag(tmp_path / "x.bag") as out:
        for connection, second in [
            (latched, 1),
            (latched, 2),
            (plain, 3),
            (plain, 500),
            (plain, 501),
        ]:
            out.write(BagMessage(connection, second * 10**9, b"\x01\0\0\0%c" % (second % 100)))
    got: list[str] = []
    clock: list[int] = []
    node = graph.node("listener")
    for topic in ("/a", "/map"):
        node.subscribe(topic, STRING, lambda m: got.append(m.data), queue_size=None)
    following = node.subscribe("/clock", "rosgraph_msgs/Clock", lambda m: clock.append(m.clock.sec))
    with open_bag(tmp_path / "x.bag") as bag:
        assert Player(graph.node("late"), [bag], PlayerOptions(start_s=900.0)).is_empty
        player = Player(graph.node("play"), [bag], PlayerOptions(start_s=5.0, rate=10.0, clock_hz=1000.0))
        publishers = player.advertise()
        graph.until(lambda: following.publishers and all(p.has_subscribers for p in publishers))
        player.play(lambda: None)
    graph.until(lambda: len(got) == 3)
    assert got == ["\x02", "\0", "\x01"]
    assert clock[0] == 500


def test_an_older_type_is_played_with_its_recorded_definition(graph: Any, tmp_path: Path) -> None:
    """A bag is played with its own definitions, not with installed ones of the same name."""
    old = BagConnection(topic="/a", type=STRING, md5sum="0123", definition="uint8 number\n")
    with create_bag(tmp_path / "x.bag") as out:
        out.write(BagMessage(old, 10**9, b"\x07"))
    got: list[Any] = []
    graph.node("listener").subscribe("/a", "*", got.append)
    with open_bag(tmp_path / "x.bag") as bag:
        player = Player(graph.node("play"), [bag], PlayerOptions())
        publishers = player.advertise()
        graph.until(lambda: publishers[0].has_subscribers)
        player.play(lambda: None)
        graph.until(lambda: got)
    assert (got[0].md5sum, got[0].definition, got[0].data) == ("0123", "uint8 number\n", b"\x07")


def test_steps_in_a_pause_play_single_messages_while_time_is_paused(
    graph: Any, messages: Messages, tmp_path: Path
) -> None:
    with create_bag(tmp_path / "x.bag") as out:
        for message in _stream(messages, 5):
            out.write(message)
    clock: list[int] = []
    subscription = graph.node("n").subscribe("/clock", "rosgraph_msgs/Clock", lambda m: clock.append(m.clock.nanosec))
    with open_bag(tmp_path / "x.bag") as bag:
        player = Player(graph.node("play"), [bag], PlayerOptions(clock_hz=1000.0, rate=0.01))
        player.advertise()
        graph.until(lambda: subscription.publishers)
        player.is_paused = True
        polls = 0

        def poll() -> None:
            nonlocal polls
            polls += 1
            if player.steps == 0:
                player.steps = 1

        player.play(poll)
    assert player.played == 5
    assert polls == 5
    graph.until(lambda: clock and clock[-1] == 40_000_000)
    assert player.now_ns == 1_700_000_000_040_000_000


def test_an_unindexed_bag_is_refused_with_the_command_that_recovers_it(messages: Messages, tmp_path: Path) -> None:
    for name in ("x.bag", "x.mcap"):
        out = create_bag(tmp_path / name)
        for message in _stream(messages, 5):
            out.write(message)
        out.flush()
        with pytest.raises(UnindexedBagError, match="Run trundle bag reindex"):
            open_bag(tmp_path / name)
        out.close()
    with create_bag(tmp_path / "y.bag") as out:
        for message in _stream(messages, 5):
            out.write(message)
    os.truncate(tmp_path / "y.bag", (tmp_path / "y.bag").stat().st_size - 100)
    with pytest.raises(UnindexedBagError, match="Run trundle bag reindex"):
        open_bag(tmp_path / "y.bag")


def test_message_views_have_rospys_attributes(messages: Messages) -> None:
    odom = messages.new("nav_msgs/Odometry", {"header": {"stamp": {"secs": 5, "nsecs": 500_000_000}}})
    m: Any = MessageView(odom)
    assert m.header.stamp.to_sec() == 5.5
    assert m.header.stamp.secs == 5
    assert m.header.stamp.nsecs == 500_000_000
    assert m.header.stamp > MessageView(messages.stamp(5_400_000_000))
    assert (m.header.stamp - MessageView(messages.stamp(6_000_000_000))).to_sec() == -0.5
    assert str(m.header.stamp) == "5500000000"
    assert str(MessageView(messages.new("geometry_msgs/Point", {"x": 1}), messages)) == "x: 1.0\ny: 0.0\nz: 0.0"
    tree: Any = MessageView(messages.new("tf2_msgs/TFMessage", {"transforms": [{"child_frame_id": "a"}]}))
    assert tree.transforms[0].child_frame_id == "a"


@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_a_publishers_definition_is_recorded_verbatim(graph: Any, far: Any, tmp_path: Path, name: str) -> None:
    """`rosbag check` compares it with the installed one, comments included."""
    text = "# what it says\n\nstring   data # [ ]\n"
    node = far.node("talker")
    publisher = node.advertise("/a", STRING, raw_type=(node.messages.md5(STRING), text), latch=True)
    publisher.publish(bytes(4))
    recorder = Recorder(graph.node("record"), RecorderOptions(topics=("/a",), path=tmp_path / name), log=lambda _: None)
    recorder.start()
    graph.until(lambda: recorder.recorded == 1)
    recorder.stop()
    with open_bag(tmp_path / name) as bag:
        assert [c.definition for c in bag.connections] == [text]


@contextmanager
def _limited_file_size(size: int) -> Iterator[None]:
    """Limit file sizes [bytes], as if the disk were full."""
    resource = pytest.importorskip("resource", reason="this system does not limit file sizes")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_messages_written_before_the_disk_is_full_are_recoverable(graph: Any, tmp_path: Path, name: str) -> None:
    """Chunks written after a gap, once there is space again, would make the bag unreadable."""
    failures: list[str] = []
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=None)
    options = RecorderOptions(topics=("/a",), path=tmp_path / name, chunk_bytes=10_000)
    recorder = Recorder(graph.node("record"), options, log=lambda _: None, on_failure=failures.append)
    with _limited_file_size(100_000):
        recorder.start()
        graph.until(lambda: publisher.has_subscribers)
        for i in range(300):
            publisher.publish({"data": f"{i}" + 1000 * "."})
        graph.until(recorder.done.is_set)
    recorder.stop()

    active = tmp_path / f"{name}.active"
    reason = f"{active}: File too large; trundle bag reindex --output-dir=FOLDER recovers its messages"
    assert (recorder.error, failures) == (reason, [f"recording failed: {reason}"])
    assert not (tmp_path / name).exists()
    recovered = [message.data[4:].partition(b".")[0] for message in recover_messages(active)]
    assert recovered == [b"%d" % i for i in range(len(recovered))]
    assert len(recovered) > 80


@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_a_second_recording_to_the_same_name_is_refused(
    graph: Any, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It would take over the first one's file."""
    publisher = graph.node("talker").advertise("/a", STRING, latch=True)
    publisher.publish({"data": "kept"})
    options = RecorderOptions(topics=("/a",), path=tmp_path / name)
    recorder = Recorder(graph.node("record"), options, log=lambda _: None)
    recorder.start()
    graph.until(lambda: recorder.recorded == 1)
    refused = rf"{name} cannot be written: .* writes it: end that, or choose another name"
    with pytest.raises(BagError, match=refused):
        Recorder(graph.node("second"), options, log=lambda _: None).start()
    with pytest.raises(BagError, match=refused):
        StepRecorder(graph.loop, tmp_path / name, on_failure=lambda _: None)
    assert main(["bag", "reindex", str(tmp_path / f"{name}.active")]) == 1
    assert "writes it: end that" in capsys.readouterr().err
    recorder.stop()

    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert [message.data[4:] for message in recover_messages(tmp_path / name)] == [b"kept"]
    StepRecorder(graph.loop, tmp_path / name, on_failure=lambda _: None).close()


@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_a_bag_that_cannot_be_finished_is_reported(graph: Any, tmp_path: Path, name: str) -> None:
    """All messages are still in memory when the disk is full."""
    publisher = graph.node("talker").advertise("/a", STRING, latch=True)
    recorder = Recorder(graph.node("record"), RecorderOptions(topics=("/a",), path=tmp_path / name), log=lambda _: None)
    recorder.start()
    publisher.publish({"data": 20_000 * "."})
    graph.until(lambda: recorder.recorded == 1)
    with _limited_file_size(10_000):
        recorder.stop()

    assert recorder.error is not None
    assert "File too large" in recorder.error
    assert not (tmp_path / name).exists()


def test_a_step_recorder_writes_no_more_after_a_failure(graph: Any, tmp_path: Path) -> None:
    failures: list[str] = []
    recorder = StepRecorder(graph.loop, tmp_path / "x.bag", on_failure=failures.append)
    publisher = graph.node("talker").advertise("/a", STRING)
    with _limited_file_size(100_000):
        for step in range(9):
            publisher.publish({"data": f"{step}" + 400_000 * "."})
            graph.loop.flush_deliveries()
            recorder.write(10**18 + step)
    recorder.write(2 * 10**18)
    recorder.close()

    assert len(failures) == 1
    assert failures[0].startswith(f"recording failed: {tmp_path}/x.bag.active: File too large; ")
    assert [path.name for path in tmp_path.iterdir()] == ["x.bag.active"]
    assert (tmp_path / "x.bag.active").stat().st_size == 100_000


@pytest.mark.parametrize("count", [0, 3])
def test_the_bag_header_is_as_long_as_rosbags(messages: Messages, tmp_path: Path, count: int) -> None:
    """`rosbag reindex` expects the first chunk at a fixed offset."""
    path = tmp_path / "x.bag"
    connection = BagConnection(topic="/a", type="std_msgs/Empty", md5sum=messages.md5("std_msgs/Empty"), definition="")
    with create_bag(path) as out:
        for i in range(count):
            out.write(BagMessage(connection, 10**18 + i, b""))
    data = path.read_bytes()
    (header,) = struct.unpack_from("<I", data, 13)
    (padding,) = struct.unpack_from("<I", data, 17 + header)
    assert header + padding == 4096
    assert data[21 + header : 21 + 4096].strip() == b""
    assert sum(1 for _ in recover_messages(path)) == count


def test_a_repeated_connection_id_is_counted_twice(messages: Messages, tmp_path: Path) -> None:
    """One damaged byte in the index gives two connections the same ID."""
    path = tmp_path / "x.bag"
    with create_bag(path) as out:
        for topic in ("/a", "/b"):
            md5sum = messages.md5("std_msgs/Empty")
            connection = BagConnection(topic=topic, type="std_msgs/Empty", md5sum=md5sum, definition="")
            out.write(BagMessage(connection, 10**18, b""))
    head, _, tail = path.read_bytes().rpartition(b"conn=\1\0\0\0")
    path.write_bytes(head + b"conn=\0\0\0\0" + tail)
    with open_bag(path) as bag:
        assert len(bag.connections) == len(bag.counts) == 2
