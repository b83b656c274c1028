"""`trundle bag`, with rosbag's output; Trundle and rosbag read each other's bags."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.app.cli.conftest import PATIENCE_S

from trundle.app.cli import main
from trundle.ros import BagConnection, BagError, BagMessage, Messages, create_bag, open_bag, recover_messages

STRING = "std_msgs/String"
START_NS = 1_700_000_000_000_000_000


@contextmanager
def _started(*command: str, **environment: str) -> Iterator["subprocess.Popen[str]"]:
    if command[0].startswith("-"):
        command = (sys.executable, *command)
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env={**os.environ, **environment}
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                process.kill()


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Two topics over one second, one of them latched."""
    messages = Messages()
    path = tmp_path / "points.bag"
    with create_bag(path) as out:
        for i in range(21):
            kind, fields = ("geometry_msgs/PointStamped", {"header": {"stamp": {"secs": i}}, "point": {"x": i}})
            topic = "/points"
            if i == 5:
                kind, fields, topic = STRING, {"data": "map"}, "/fixed"
            connection = BagConnection(
                topic=topic,
                type=kind,
                md5sum=messages.md5(kind),
                definition=messages.definition(kind),
                caller="/maker",
                latching=topic == "/fixed",
            )
            data = bytes(messages.serialize(messages.new(kind, fields)))
            out.write(BagMessage(connection, START_NS + i * 50_000_000, data))
    return path


def _on_disk(path: Path) -> int:
    """Number of messages already on disk, which survive SIGKILL."""
    try:
        return sum(1 for _ in recover_messages(path))
    except BagError:  # the file has no message yet
        return 0


def _counts(path: Path) -> dict[str, int]:
    with open_bag(path) as bag:
        return dict(zip([c.topic for c in bag.connections], bag.counts, strict=True))


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
@pytest.mark.parametrize("name", ["x.bag", "x.mcap"])
def test_an_interrupted_recording_can_be_read(graph: Any, tmp_path: Path, name: str, number: signal.Signals) -> None:
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=None)
    path = tmp_path / name
    with _started("-m", "trundle", "bag", "record", "-O", str(path), "/a") as process:
        graph.until(lambda: publisher.has_subscribers)
        for i in range(200):
            publisher.publish({"data": str(i)})
        active = path.with_name(f"{name}.active")
        graph.until(lambda: _on_disk(active) == 200)
        process.send_signal(number)
        process.wait(PATIENCE_S)
        assert process.stdout is not None
        lines = process.stdout.read().splitlines()
    assert [line.partition("]: ")[2] for line in lines] == [f"Recording to '{path}'.", "Subscribing to /a"]
    if number == signal.SIGKILL:
        assert not path.exists()
        assert graph.trundle("bag", "info", str(active))[0] == 1
        code, out, _ = graph.trundle("bag", "reindex", str(active))
        assert (code, out.endswith(" 00:00    \n")) == (0, True)
        path = active
    else:
        assert process.returncode == 0
        assert not active.exists()
    assert _counts(path) == {"/a": 200}


def test_the_deprecated_split_size_is_accepted(graph: Any, tmp_path: Path) -> None:
    """Scripts written before 2012 have `rosbag record --split 1024`."""
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=None)
    record = ["-m", "trundle", "bag", "record", "--split", "1", "/a", "-O", str(tmp_path / "x.bag")]
    with _started(*record) as process:
        graph.until(lambda: publisher.has_subscribers)

        def is_split() -> bool:
            publisher.publish({"data": " " * 100_000})
            return (tmp_path / "x_0.bag").exists()

        graph.until(is_split)
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE_S)
        assert process.stdout is not None
        out = process.stdout.read()
    assert "--split 1: deprecated, use --split --size 1\n" in out
    assert f"]: Closing '{tmp_path / 'x_0.bag'}'.\n" in out


def test_a_background_job_of_a_shell_handles_sigint(graph: Any, tmp_path: Path) -> None:
    """Scripts write `rosbag record … & kill -INT $!`; a shell starts its background jobs with SIGINT ignored."""
    publisher = graph.node("talker").advertise("/a", STRING, queue_size=None)
    path = tmp_path / "x.bag"
    record = f"{sys.executable} -m trundle bag record -q -O {path} /a"
    with _started("/bin/sh", "-c", f"{record} & echo $!; wait $!; echo $?") as shell:
        assert shell.stdout is not None
        process = int(shell.stdout.readline())
        graph.until(lambda: publisher.has_subscribers)
        os.kill(process, signal.SIGINT)
        assert shell.stdout.read() == "0\n"
    assert path.exists()


def test_a_bag_is_played_with_rate_and_clock(graph: Any, bag: Path) -> None:
    messages: list[tuple[str, Any]] = []
    clock: list[int] = []
    node = graph.node("listener")
    subscriptions = [
        node.subscribe("/points", "geometry_msgs/PointStamped", lambda m: messages.append(("/points", m.point.x))),
        node.subscribe("/moved", STRING, lambda m: messages.append(("/moved", m.data))),
        node.subscribe("/clock", "rosgraph_msgs/Clock", lambda m: clock.append(m.clock.sec * 10**9 + m.clock.nanosec)),
    ]
    graph.ready(node)
    options = ["--clock", "-r", "4", "-s", "0.2", "-u", "0.6", "-d", "0", "--pause", "__name:=player", "/fixed:=/moved"]
    with _started("-m", "trundle", "bag", "play", str(bag), *options) as process:
        graph.until(lambda: all(subscription.publishers for subscription in subscriptions))
        graph.loop.run(node.wait_for_service("/player/pause_playback", PATIENCE_S), PATIENCE_S)
        graph.loop.run(node.call_service("/player/pause_playback", "std_srvs/SetBool", {"data": False}), PATIENCE_S)
        assert process.stdout is not None
        out = process.stdout.read()
        assert process.wait(PATIENCE_S) == 0
    assert out.splitlines()[0].endswith(f": Opening {bag}")
    assert out.endswith("\nWaiting 0 seconds after advertising topics... done.\n\n"
                        "Hit space to toggle paused, or 's' to step.\n\nDone.\n")  # fmt: skip
    graph.until(lambda: len(messages) >= 13)
    assert [value for topic, value in messages if topic == "/points"] == [4.0, *map(float, range(6, 17))]
    assert ("/moved", "map") in messages
    assert clock == sorted(clock)
    assert START_NS + 200_000_000 <= clock[0] <= clock[-1] < START_NS + 900_000_000


def test_bags_are_described_filtered_and_compressed(graph: Any, bag: Path, tmp_path: Path) -> None:
    code, out, _ = graph.trundle("bag", "info", str(bag))
    assert code == 0
    assert "duration:    1.0s\n" in out
    assert "topics:      /fixed     1 msg     : std_msgs/String " in out
    assert graph.trundle("bag", "info", "-y", "-k", "topics[1].messages", str(bag))[1] == "20\n"
    some = tmp_path / "some.bag"
    assert graph.trundle("bag", "filter", str(bag), str(some), "m.header.stamp.secs > 10 and t.to_sec() > 0")[0] == 1
    expression = "topic == '/points' and m.header.stamp.secs > 10"
    assert graph.trundle("bag", "filter", str(bag), str(some), expression)[0] == 0
    assert _counts(some) == {"/points": 10}
    for arguments in (["compress"], ["compress", "--lz4", "-f"], ["decompress", "-f"]):
        code, out, _ = graph.trundle("bag", *arguments, str(some))
        assert (code, f"{some.name} " in out, "100%" in out) == (0, True, True)
        assert _counts(some) == {"/points": 10}
    assert graph.trundle("bag", "reindex", "-f", "-q", str(some)) == (0, "", "")
    assert (tmp_path / "some.orig.bag").exists()
    code, _, error = graph.trundle("bag", "compress", str(some))
    assert (code, error.startswith(f"ERROR: Skipping {some}. Backup path")) == (1, True)
    assert graph.trundle("bag", "check", str(some)) == (0, "Bag file does not need any migrations.\n", "")


def test_filter_has_rosbags_output_and_exit_codes(graph: Any, bag: Path, tmp_path: Path) -> None:
    """Scripts use the exit codes."""
    copy = str(tmp_path / "copy.bag")
    assert graph.trundle("bag", "filter", "none.bag", copy, "True")[0] == 2
    assert graph.trundle("bag", "filter", str(bag), str(bag), "True")[0] == 3
    code, out, _ = graph.trundle("bag", "filter", str(bag), copy, "topic == '/fixed'", "-p", "t")
    assert (code, out.splitlines()[0]) == (0, f"NO MATCH {START_NS}")
    late = "topic == '/points' and (t - m.header.stamp).to_sec() < 1699999990"
    assert graph.trundle("bag", "filter", str(bag), copy, late)[0] == 0
    assert _counts(Path(copy)) == {"/points": 10}


@pytest.mark.parametrize("name", ["out.bag", "out.mcap"])
def test_a_full_disk_leaves_the_existing_bag(bag: Path, tmp_path: Path, name: str) -> None:
    """`bag filter` used to replace the existing bag by an incomplete one."""
    last, source, out = (tmp_path / folder / name for folder in ("last", "source", "out"))
    for path in (last, source, out):
        path.parent.mkdir()
        assert main(["bag", "filter", str(bag), str(path), "True"]) == 0
    for words in (
        ["filter", source, out, "True"],
        ["fix", source, out],
        ["decompress", f"--output-dir={out.parent}", source],
    ):
        arguments = [sys.executable, "-m", "trundle", "bag", *map(str, words)]
        limited = ["sh", "-c", 'ulimit -f 1; exec "$@"', "sh", *arguments]
        process = subprocess.run(limited, capture_output=True, text=True, check=False)
        assert process.returncode == 1
        assert re.fullmatch(
            rf"ERROR: {out}(\.part)? cannot be written: File too large", process.stderr.splitlines()[-1]
        )
        assert [path.name for path in out.parent.iterdir()] == [name]
        assert out.read_bytes() == last.read_bytes()


@pytest.mark.real_ros
def test_progress_is_printed_like_rosbag(graph: Any, original: Any, bag: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    options = ["--output-dir", str(tmp_path / "out")]
    cut_off = tmp_path / "cut_off.bag"
    cut_off.write_bytes(bag.read_bytes()[:-500])
    for arguments in (
        ["filter", str(bag), str(tmp_path / "out/x.bag"), "True"],
        ["compress", str(bag), *options],
        ["compress", "-q", str(bag), *options],
        ["decompress", str(bag), *options],
        ["reindex", str(cut_off), *options],
    ):
        output, expected = graph.trundle("bag", *arguments)[1], original("rosbag", *arguments)
        assert _without_time(output) == _without_time(expected)


def _without_time(text: str) -> str:
    return re.sub(r"\d\d:\d\d", "00:00", text.replace("\r", "\n"))


@pytest.mark.real_ros
def test_a_remapped_topic_is_recorded_by_its_given_name(graph: Any, original: Any, tmp_path: Path) -> None:
    """`<remap from="scan" to="/robot/scan"/>` changes the topic that is subscribed to, not the topic in the bag."""
    node = graph.node("talker")
    node.advertise("/robot/scan", STRING, latch=True).publish({"data": "hello"})
    graph.ready(node)
    for topic in ("scan", "/scan"):
        words = ["bag", "record", "-q", "-l", "1", topic, "/scan:=/robot/scan", "-O"]
        assert graph.trundle(*words, str(tmp_path / "trundle.bag"))[0] == 0
        original(f"ros{words[0]}", *words[1:], str(tmp_path / "rosbag.bag"))
        assert _counts(tmp_path / "trundle.bag") == _counts(tmp_path / "rosbag.bag") == {topic: 1}


@pytest.mark.real_ros
def test_a_remapping_after_topics_is_not_a_topic(graph: Any, original: Any, bag: Path) -> None:
    """A launch file's <remap> comes after its args."""
    received: list[str] = []
    graph.node("listener").subscribe("/robot/moved", STRING, lambda m: received.append(m.data))
    words = [
        "-q",
        "--wait-for-subscribers",
        "-r",
        "10",
        str(bag),
        "--topics",
        "/fixed",
        "/fixed:=moved",
        "__ns:=/robot",
    ]
    assert graph.trundle("bag", "play", *words)[0] == 0
    graph.until(lambda: received == ["map"])
    original("rosbag", "play", *words)
    graph.until(lambda: received == ["map", "map"])


def test_udp_is_replaced_by_tcp(graph: Any, tmp_path: Path) -> None:
    node = graph.node("talker")
    node.advertise("/a", STRING, latch=True).publish({"data": "hello"})
    graph.ready(node)
    path = tmp_path / "x.bag"
    code, _, error = graph.trundle("bag", "record", "--udp", "-l", "1", "-O", str(path), "/a")
    assert (code, error) == (0, "--udp: UDPROS is not supported; using TCP\n")
    assert _counts(path) == {"/a": 1}


def test_topics_and_types_are_read_from_a_bag(graph: Any, bag: Path) -> None:
    assert graph.trundle("topic", "list", "-b", str(bag))[1] == "/points\n/fixed\n"
    assert graph.trundle("topic", "list", "-b", str(bag), "/fixed")[1].startswith("1 message(s) from ")
    assert graph.trundle("topic", "echo", "-b", str(bag), "-n", "1", "/points/point/x")[1] == "0.0\n---\n"
    everything = graph.trundle("topic", "echo", "-b", str(bag), "-a", "-p")[1].splitlines()
    assert len(everything) == 22
    assert graph.trundle("msg", "show", "-b", str(bag), STRING)[1] == "string data\n\n"
    code, _, error = graph.trundle("topic", "echo", "-b", str(bag), "/nope")
    assert (code, error) == (1, f"ERROR: no topic [/nope] in {bag}; topics there: /fixed, /points\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["record"], "You must specify a topic name"),
        (["record", "-e", "["], "not a regular expression: '['"),
        (["record", "-a", "--split"], "Split specified without giving"),
        (["play"], "You must specify at least 1 bag file"),
        (["play", "none.bag"], "none.bag] cannot be read"),
        (["play", "-r", "0", "x.bag"], "a number greater than zero is needed, got '0'"),
        (["info", "none.bag"], "none.bag] cannot be read"),
        (["encrypt", "-p", "x", "x.bag"], "encryption of bags is not supported"),
        (["decrypt", "x.bag"], "encryption of bags is not supported"),
        (["filter", "none.bag", "x.bag", "True"], "Cannot locate input bag file [none.bag]"),
    ],
)
def test_errors_are_one_sentence(graph: Any, arguments: list[str], message: str) -> None:
    code, _, error = graph.trundle("bag", *arguments)
    assert code in (1, 2)
    assert message in error
    assert "Traceback" not in error


@pytest.mark.parametrize(
    "arguments",
    [
        ["record"],
        ["record", "-a", "--split"],
        ["play"],
        ["info", "-k", "end", "x.bag"],
        ["check", "-a", "x.bag"],
        ["fix", "x.bag", "x.bmr"],
    ],
)
def test_wrong_usage_exits_like_rosbag(graph: Any, arguments: list[str]) -> None:
    code, _, error = graph.trundle("bag", *arguments)
    assert (code, error.startswith(f"usage: trundle bag {arguments[0]} ")) == (2, True)


def test_a_missing_key_is_an_error_for_each_bag(graph: Any, bag: Path) -> None:
    code, out, error = graph.trundle("bag", "info", "-y", "-k", "topics[9]", str(bag), str(bag))
    assert (code, out, error) == (0, "---\n", 'Error getting key "topics[9]"\n' * 2)


@pytest.mark.slow
@pytest.mark.real_ros
def test_info_prints_the_lines_of_rosbag(graph: Any, original: Any, bag: Path) -> None:
    keys = ("end", "topics", "types", "topics[0]", "topics[-1].type", "nope")
    for compression in (None, "-j", "--lz4"):
        if compression:
            graph.trundle("bag", "compress", "-f", compression, str(bag))
        for arguments in ([], ["-y"], ["--freq"], ["-y", "--freq"], *(["-y", "-k", key] for key in keys)):
            assert graph.trundle("bag", "info", *arguments, str(bag))[1] == original(
                "rosbag", "info", *arguments, str(bag)
            )


@pytest.mark.real_ros
@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_rosbag_reindexes_bags_written_by_trundle(graph: Any, original: Any, bag: Path, compression: str) -> None:
    if compression != "none":
        assert graph.trundle("bag", "compress", "-q", f"--{compression}", str(bag))[0] == 0
        (bag.parent / "points.orig.bag").unlink()
    original("rosbag", "reindex", "-q", str(bag))
    assert (bag.parent / "points.orig.bag").exists()
    assert _counts(bag) == {"/points": 20, "/fixed": 1}


@pytest.mark.real_ros
@pytest.mark.parametrize("compression", ["none", "-j", "--lz4"])
def test_rosbag_plays_bags_written_by_trundle(
    graph: Any, original: Any, bag: Path, tmp_path: Path, compression: str
) -> None:
    points: list[float] = []
    fixed: list[str] = []
    node = graph.node("listener")
    node.subscribe("/points", "geometry_msgs/PointStamped", lambda m: points.append(m.point.x), queue_size=None)
    node.subscribe("/fixed", STRING, lambda m: fixed.append(m.data))
    graph.ready(node)
    if compression != "none":
        graph.trundle("bag", "compress", compression, str(bag))
    play = ["/usr/lib/rosbag/play", "--wait-for-subscribers", "-q", str(bag)]
    with _started(*play, ROS_IP="127.0.0.1", HOME=str(tmp_path)) as process:
        assert process.wait(PATIENCE_S) == 0
    graph.until(lambda: len(points) == 20)
    graph.until(lambda: fixed == ["map"])


@pytest.mark.real_ros
@pytest.mark.parametrize("compression", ["none", "-j", "--lz4"])
def test_trundle_reads_bags_written_by_rosbag(graph: Any, original: Any, tmp_path: Path, compression: str) -> None:
    node = graph.node("talker")
    publisher = node.advertise("/points", "geometry_msgs/PointStamped")
    fixed = node.advertise("/fixed", STRING, latch=True)
    fixed.publish({"data": "map"})
    path = tmp_path / "rosbag.bag"
    options = [] if compression == "none" else [compression]
    record = ["/usr/lib/rosbag/record", *options, "--chunksize=1", "-O", str(path), "/points", "/fixed"]
    with _started(*record, ROS_IP="127.0.0.1", HOME=str(tmp_path)) as process:
        graph.until(lambda: publisher.has_subscribers and fixed.has_subscribers)

        def is_written() -> bool:
            publisher.publish({"point": {"x": 1.5}})
            return _on_disk(path.with_name("rosbag.bag.active")) > 20

        graph.until(is_written)
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 0
    counts = _counts(path)
    assert counts["/fixed"] == 1
    assert counts["/points"] >= 20
    assert graph.trundle("bag", "play", "-i", "-q", str(path))[0] == 0
