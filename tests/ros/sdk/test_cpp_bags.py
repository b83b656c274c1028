"""rosbag's C++ library and messages of any type, in compiled programs, beside Trundle's own readers."""

import subprocess
from pathlib import Path

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros import BagConnection, BagMessage, Messages, create_bag, open_bag

pytestmark = pytest.mark.slow

_TEXTS = ["early", *(f"text {i}" for i in range(0, 200, 10))]


def _run(workspace: Path, *arguments: str) -> str:
    program = str(workspace / "devel/lib/cpp_bags/bags")
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False, timeout=WAIT_S)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_a_written_bag_is_read_by_both(workspace: Path, tmp_path: Path, compression: str) -> None:
    file = tmp_path / "a.bag"
    assert _run(workspace, "write", str(file), compression) == "open 221\n", "a bag is viewed while it is written"
    assert _run(workspace, "append", str(file)) == ""

    with open_bag(file) as bag:
        messages = list(bag.messages())
        assert {connection.topic: connection.type for connection in bag.connections} == {
            "/number": "std_msgs/Float64",
            "/text": "std_msgs/String",
        }
    assert len(messages) == 222
    assert [message.stamp_ns for message in messages] == sorted(message.stamp_ns for message in messages)

    lines = _run(workspace, "read", str(file)).splitlines()
    assert [" ".join(line.split()[2:]) for line in lines[:-2]] == [*_TEXTS, "late /writer"]
    assert lines[0].startswith("50.000000000 /text")
    assert lines[-2] == "sum 72.5 of 10", "numbers at 110 s … 119 s and 500 ns"
    assert _run(workspace, "fast", str(file)) == "6 texts, 50 numbers to 160.000000000\n"
    assert lines[-1].startswith("all 222 from 50.000000000 to 1000.000000000 /number=std_msgs/Float64 /text=")


@pytest.mark.parametrize("compression", ["none", "bz2", "lz4"])
def test_a_bag_of_trundles_is_read_and_published(
    workspace: Path, running: Running, graph: Graph, messages: Messages, tmp_path: Path, compression: str
) -> None:
    file = tmp_path / "b.bag"
    connection = BagConnection(
        topic="/text",
        type="std_msgs/String",
        md5sum=messages.md5("std_msgs/String"),
        definition=messages.definition("std_msgs/String"),
    )
    with create_bag(file, compression=compression, chunk_bytes=300) as bag:
        for i in range(40):
            data = messages.serialize(messages.new("std_msgs/String", {"data": f"long text {i}"}))
            bag.write(BagMessage(connection, (i + 1) * 10**9, data))
    lines = _run(workspace, "read", str(file)).splitlines()
    assert [line.split(" ", 2)[2].strip() for line in lines[:40]] == [f"long text {i}" for i in range(40)]

    played: list[str] = []
    graph.node("tester").subscribe("/played", "std_msgs/String", lambda message: played.append(message.data))
    running.start("bags", "play", str(file), package="cpp_bags")
    until(lambda: len(played) == 40)
    assert played[7] == "long text 7"


def test_damaged_bags_end_in_a_sentence(workspace: Path, tmp_path: Path) -> None:
    file = tmp_path / "a.bag"
    _run(workspace, "write", str(file), "bz2")
    whole = file.read_bytes()
    expected = {
        b"": "not a bag",
        b"#ROSBAG V1.2\n" + whole[13:]: "only bags of version 2.0 are read",
        whole[:5000]: "the file ends within a record",
        whole.replace(b"BZh9", b"BZh0"): "compressed bytes are damaged",
        whole.replace(b"op=\x06", b"op=\x09"): "the index of chunks is damaged",
        whole.replace(b"compression=bz2", b"compression=zip"): "compression is unknown: zip",
    }
    for data, sentence in expected.items():
        file.write_bytes(data)
        assert sentence in _run(workspace, "read", str(file)), sentence
    for position in range(13, len(whole), 97):  # any byte
        file.write_bytes(whole[:position] + bytes([whole[position] ^ 0x55]) + whole[position + 1 :])
        _run(workspace, "read", str(file))
    file.unlink()
    assert "cannot open" in _run(workspace, "read", str(file))


def test_messages_of_any_type_are_passed_on(running: Running, graph: Graph, messages: Messages) -> None:
    node = graph.node("tester")
    texts: list[str] = []
    node.subscribe("/out", "std_msgs/String", lambda message: texts.append(message.data))
    publisher = node.advertise("/in", "std_msgs/String")
    process = running.start("any", package="cpp_bags")
    until(lambda: publisher.has_subscribers)
    publisher.publish(messages.new("std_msgs/String", {"data": "hello"}))
    assert process.stdout is not None
    md5sum = messages.md5("std_msgs/String")
    assert process.stdout.readline() == f"std_msgs/String {md5sum} 9 defined 'hello'\n"
    until(lambda: texts == ["hello"])
