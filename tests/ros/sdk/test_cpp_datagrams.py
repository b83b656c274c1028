"""UDPROS: messages in datagrams between the kit's nodes, Debian's roscpp, and peers that lie."""

import random
import socket
import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xmlrpc.client import Binary, ServerProxy
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running
from tests.ros.sdk.hostile_peers import listening_ports
from tests.ros.test_real_tools import Real

from trundle.ros.errors import MasterError
from trundle.ros.xmlrpc.rpc_client import call_value

pytestmark = pytest.mark.slow
MD5SUM = "992ce8a1687cec8c8bd883ec73ca41d1"
"""MD5 sum of std_msgs/String."""
FIRST, LATER, PING, ERROR = range(4)


@pytest.fixture
def reports(graph: Graph) -> list[str]:
    """Texts on /report."""
    texts: list[str] = []
    graph.node("listener").subscribe("/report", "std_msgs/String", lambda message: texts.append(message.data))
    return texts


def transports(graph: Graph, node: str, topic: str) -> set[str]:
    """Return the protocols of a node's connections for a topic; none before the node has registered."""
    try:
        uri = graph.loop.run(call_value(graph.core.uri, "lookupNode", "/test", node))
    except MasterError:
        return set()
    return {row[3] for row in graph.loop.run(call_value(uri, "getBusInfo", "/test")) if row[4] == topic}


@pytest.mark.parametrize(("size", "datagram"), [(0, 0), (5, 64), (1480, 0), (1489, 0), (70_000, 0), (70_000, 65_507)])
def test_messages_arrive_in_datagrams(
    size: int, datagram: int, running: Running, graph: Graph, reports: list[str]
) -> None:
    running.start("datagrams", str(size), "__name:=sender", "out:=data", "report:=none", "in:=nothing")
    running.start("datagrams", "1", "__name:=receiver", "in:=data", f"_datagram:={datagram}")
    until(lambda: len(reports) > 3)

    assert set(reports) == {f"{size} bytes from /sender"}
    assert transports(graph, "/sender", "/data") == transports(graph, "/receiver", "/data") == {"UDPROS"}


def test_datagrams_of_debians_roscpp_are_understood(
    running: Running, graph: Graph, reports: list[str], tmp_path: Path
) -> None:
    if not Path("/usr/lib/topic_tools/relay").exists():
        pytest.skip("Debian's topic-tools is not installed")
    running.start("datagrams", "4000", "__name:=sender", "out:=data", "report:=none", "in:=nothing")
    running.start("datagrams", "1", "__name:=receiver", "in:=copy")
    relay = Real(graph.core.uri, tmp_path)
    with relay.started("../lib/topic_tools/relay", "/data", "/copy", "_unreliable:=true", "__name:=relay"):
        until(lambda: len(reports) > 3)

        assert set(reports) == {"4000 bytes from /relay"}
        assert transports(graph, "/relay", "/data") == transports(graph, "/relay", "/copy") == {"UDPROS"}
    until(lambda: not transports(graph, "/sender", "/data"))


def test_a_publisher_without_udpros_sends_by_tcpros(running: Running, graph: Graph, reports: list[str]) -> None:
    node = graph.node("talker")
    node.advertise("/data", "std_msgs/String", latch=True).publish({"data": "abc"})
    graph.ready(node)
    receiver = running.start("datagrams", "1", "__name:=receiver", "in:=data")
    until(lambda: reports)

    assert reports[0] == "3 bytes from /talker"
    receiver.terminate()
    assert "does not speak UDPROS; its messages come by TCPROS" in receiver.communicate(timeout=WAIT_S)[0]


def header(topic: str, md5sum: str = MD5SUM) -> Binary:
    fields = (f"topic={topic}", f"md5sum={md5sum}", "type=std_msgs/String", "callerid=/peer")
    return Binary(b"".join(struct.pack("<I", len(field)) + field.encode() for field in fields))


def datagram(operation: int, message: int, block: int, payload: bytes = b"", identity: int = 77) -> bytes:
    return struct.pack("<IBBH", identity, operation, message, block) + payload


def text(content: bytes) -> bytes:
    """A std_msgs/String after its length, as on a connection."""
    return struct.pack("<II", len(content) + 4, len(content)) + content


def test_a_message_is_cut_as_the_protocol_says(running: Running, graph: Graph) -> None:
    running.start("datagrams", "200", "__name:=sender", "out:=data", "in:=nothing")
    node = graph.node("tester")
    seen: list[object] = []
    node.subscribe("/data", "std_msgs/String", seen.append)
    until(lambda: seen)
    uri = graph.loop.run(call_value(graph.core.uri, "lookupNode", "/test", "/sender"))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer, ServerProxy(uri) as sender:
        peer.bind(("127.0.0.1", 0))
        peer.settimeout(60)
        offer = ["UDPROS", header("/data"), "127.0.0.1", peer.getsockname()[1], 100]
        answer: Any = sender.requestTopic("/peer", "/data", [offer])
        _, _, (protocol, _, _, identity, size, fields) = answer
        parts = [peer.recv(2000) for _ in range(6)]

    assert (protocol, size) == ("UDPROS", 100)
    assert b"md5sum=" + MD5SUM.encode() in fields.data
    heads = [struct.unpack("<IBBH", part[:8]) for part in parts]
    assert heads == [
        *((identity, FIRST, 1, 3), (identity, LATER, 1, 1), (identity, LATER, 1, 2)),
        *((identity, FIRST, 2, 3), (identity, LATER, 2, 1), (identity, LATER, 2, 2)),
    ]
    assert [len(part) for part in parts[:3]] == [100, 100, 8 + 208 - 2 * 92]
    assert b"".join(part[8:] for part in parts[:3]) == text(bytes(97 + i % 23 for i in range(200)))
    until(lambda: transports(graph, "/sender", "/data") == {"TCPROS"})


def test_requests_that_lie_are_refused(running: Running, graph: Graph) -> None:
    server = running.start("datagrams", "200", "__name:=sender", "out:=data", "in:=nothing")
    seen: list[object] = []
    graph.node("tester").subscribe("/data", "std_msgs/String", seen.append)
    until(lambda: seen)
    uri = graph.loop.run(call_value(graph.core.uri, "lookupNode", "/test", "/sender"))
    offers: list[list[object]] = [
        ["UDPROS"],
        ["UDPROS", "text", "127.0.0.1", 9, 1500],
        ["UDPROS", header("/data"), "127.0.0.1", 0, 1500],
        ["UDPROS", header("/data"), "127.0.0.1", 70_000, 1500],
        ["UDPROS", header("/data"), "127.0.0.1", 9, 8],
        ["UDPROS", header("/data"), "127.0.0.1", 9, -1],
        ["UDPROS", header("/data", "0" * 32), "127.0.0.1", 9, 1500],
        ["UDPROS", header("/other"), "127.0.0.1", 9, 1500],
        ["UDPROS", Binary(b"\xff" * 9), "127.0.0.1", 9, 1500],
    ]
    for offer in offers:
        with ServerProxy(uri) as sender:
            answer: Any = sender.requestTopic("/peer", "/data", [offer])
        assert answer[0] != 1, offer
    with ServerProxy(uri) as sender:
        for host in ("", "no.such.host.invalid", "127.0.0.1"):
            sender.requestTopic("/peer", "/data", [["UDPROS", header("/data"), host, 9, 2**31 - 1]])
    count = len(seen)
    until(lambda: len(seen) > count + 5)
    assert server.poll() is None


@contextmanager
def publisher(graph: Graph) -> Iterator[None]:
    """A node that publishes /data, with connection id 77."""
    answer = [1, "", ["UDPROS", "127.0.0.1", 9, 77, 1500, header("/data")]]
    with SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False) as server:
        server.register_function(lambda *_: answer, "requestTopic")
        server.register_function(lambda *_: [1, "", 0], "publisherUpdate")
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        uri = f"http://127.0.0.1:{server.server_address[1]}/"
        graph.loop.run(call_value(graph.core.uri, "registerPublisher", "/peer", "/data", "std_msgs/String", uri))
        yield
        server.shutdown()
        thread.join()


def test_hostile_datagrams_are_dropped(running: Running, graph: Graph, reports: list[str]) -> None:
    """Lengths that lie, parts that are missing, twice or late, other connections, random bytes."""
    receiver = running.start("datagrams", "1", "__name:=receiver", "in:=data")
    rng = random.Random(4)
    good = text(bytes(97 + i % 23 for i in range(60)))
    cases = [
        *(b"", b"\x01", datagram(FIRST, 1, 1)[:7], datagram(FIRST, 1, 0, good), datagram(FIRST, 1, 1, good[:3])),
        *(datagram(FIRST, 1, 1, good[:-1]), datagram(FIRST, 1, 1, good + b"x"), datagram(FIRST, 1, 2, good)),
        datagram(FIRST, 1, 65_535, struct.pack("<I", 2**32 - 1) + b"a"),
        datagram(FIRST, 1, 65_535, struct.pack("<I", 999_999_999) + bytes(1400)),
        *(datagram(LATER, 1, 1, bytes(65_000)), datagram(LATER, 9, 1, good), datagram(LATER, 1, 65_535, good)),
        *(datagram(FIRST, 2, 3, good[:30]), datagram(LATER, 2, 2, good[30:]), datagram(LATER, 2, 1, good[30:])),
        *(datagram(FIRST, 3, 2, good[:30]), datagram(LATER, 3, 1, good), datagram(PING, 0, 0), datagram(9, 0, 0)),
        datagram(FIRST, 1, 1, good, identity=78),
        *(datagram(rng.randrange(3), 1, rng.randrange(3), rng.randbytes(rng.randrange(90))) for _ in range(300)),
    ]
    with publisher(graph), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as peer:
        until(lambda: transports(graph, "/receiver", "/data") == {"UDPROS"})
        (port,) = listening_ports(receiver.pid, "udp")
        for case in cases:
            peer.sendto(case, ("127.0.0.1", port))

        def is_reported() -> bool:
            peer.sendto(datagram(FIRST, 200, 2, good[:40]), ("127.0.0.1", port))
            peer.sendto(datagram(LATER, 200, 1, good[40:]), ("127.0.0.1", port))
            return bool(reports)

        until(is_reported)

        assert set(reports) == {"60 bytes from /peer"}
        peer.sendto(datagram(ERROR, 0, 0), ("127.0.0.1", port))
        until(lambda: listening_ports(receiver.pid, "udp") not in ([port], []))
    assert receiver.poll() is None
