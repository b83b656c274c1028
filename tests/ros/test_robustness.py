"""Slow, dead, broken and hostile peers: nothing they send stops a node or the master."""

import asyncio
import gc
import os
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import Any

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros import Core, GraphLoop, MasterProxy, Node, ServiceError, blocking_call
from trundle.ros.transport.headers import decode_header, encode_header
from trundle.ros.xmlrpc.rpc_server import RpcServer

STRING = "std_msgs/String"
MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"


def _tcpros_port(graph: Any, node: Any, topic: str = "/a") -> int:
    graph.ready(node)
    return blocking_call(node.uri, "requestTopic", "/me", topic, [["TCPROS"]], timeout_s=PATIENCE_S)[2][2]


@contextmanager
def _connected(port: int) -> Iterator[socket.socket]:
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S) as connection:
        yield connection


def _read_header(connection: socket.socket) -> dict[str, str]:
    data = b""
    while len(data) < 4 or len(data) < 4 + struct.unpack("<I", data[:4])[0]:
        chunk = connection.recv(4096)
        assert chunk, "the peer closed the connection"
        data += chunk
    return decode_header(data[4:])


def _is_closed(connection: socket.socket) -> bool:
    """Wait until the peer closes the connection."""
    try:
        while connection.recv(65536):
            pass
    except ConnectionError:
        pass
    return True


def _still_works(graph: Any, node: Any, topic: str = "/a") -> None:
    got: list[str] = []
    publisher = node.advertise(topic, STRING)
    subscription = graph.node("still_works").subscribe(topic, STRING, lambda m: got.append(m.data))
    graph.until(lambda: subscription.publishers)
    publisher.publish({"data": "yes"})
    graph.until(lambda: got == ["yes"])


@pytest.mark.parametrize(
    "request_bytes",
    [
        os.urandom(300) + b"\r\n\r\n",
        b"GET / HTTP/1.1\r\n\r\n",
        b"POST / HTTP/1.1\r\n\r\n",
        b"POST / HTTP/1.1\r\nContent-Length: -5\r\n\r\n",
        b"POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n",
        b"POST / HTTP/1.1\r\nContent-Length: 4294967296\r\n\r\n",
        b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
        b"POST / HTTP/1.1\r\nX: " + b"a" * 200_000 + b"\r\n\r\n",
    ],
    ids=["garbage", "get", "no length", "negative", "huge", "4 GB", "chunked", "endless head"],
)
def test_an_invalid_request_ends_only_its_connection(graph: Any, request_bytes: bytes) -> None:
    with _connected(graph.core.port) as connection:
        with suppress(ConnectionError):
            connection.sendall(request_bytes)
        assert _is_closed(connection)
    assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()


@pytest.mark.parametrize("body", [b"", b"<x/>", b"<?xml version='1.0'?><!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>"])
def test_an_invalid_call_is_answered_with_a_fault(graph: Any, body: bytes) -> None:
    with _connected(graph.core.port) as connection:
        connection.sendall(b"POST / HTTP/1.0\r\nContent-Length: %d\r\n\r\n%b" % (len(body), body))
        answer = b""
        while chunk := connection.recv(65536):
            answer += chunk
    assert answer.startswith(b"HTTP/1.1 200 OK")
    assert b"<fault>" in answer


def test_an_incomplete_request_delays_no_other(graph: Any) -> None:
    with _connected(graph.core.port) as connection:
        connection.sendall(b"POST / HTTP/1.1\r\nContent-Le")
        assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()


def test_five_hundred_connections_come_and_go(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    for port in (graph.core.port, _tcpros_port(graph, node)):
        for _ in range(5):
            connections = [socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S) for _ in range(50)]
            for connection in connections:
                connection.close()
    assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()
    _still_works(graph, node)


@pytest.mark.parametrize(
    "data",
    [
        os.urandom(200),
        b"\xff\xff\xff\xff",
        struct.pack("<I", 8) + struct.pack("<I", 400) + b"abcd",
        struct.pack("<I", 8) + struct.pack("<I", 4) + b"abcd",
        encode_header({"topic": "/a", "md5sum": "*"}),
        encode_header({"callerid": "/x", "md5sum": "*"}),
        encode_header({"topic": "/other", "md5sum": "*", "callerid": "/x"}),
        encode_header({"topic": "/a", "md5sum": "0" * 32, "callerid": "/x", "type": STRING}),
        encode_header({"topic": "/a", "md5sum": "0" * 32, "callerid": "/x", "type": "std_msgs/Int32"}),
        encode_header({"service": "/none", "md5sum": "*", "callerid": "/x"}),
    ],
    ids=[
        "garbage",
        "4 GB",
        "wrong length",
        "no =",
        "no caller",
        "no topic",
        "other topic",
        "md5",
        "type",
        "no service",
    ],
)
def test_an_invalid_header_ends_only_its_connection(graph: Any, data: bytes) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    with _connected(_tcpros_port(graph, node)) as connection:
        connection.sendall(data)
        connection.shutdown(socket.SHUT_WR)
        assert _is_closed(connection)
    _still_works(graph, node)


@pytest.mark.parametrize(
    ("header", "error"),
    [
        ({"topic": "/a", "md5sum": "*"}, "Missing required 'callerid' field"),
        ({"topic": "/b", "md5sum": "*", "callerid": "/x"}, "[/n] is not a publisher of [/b]"),
        (
            {"topic": "/a", "md5sum": "0", "callerid": "/x", "type": "std_msgs/Int32"},
            "topic types do not match: [std_msgs/Int32] vs. [std_msgs/String]",
        ),
        (
            {"topic": "/a", "md5sum": "0", "callerid": "/x", "type": STRING},
            f"Client [/x] wants topic [/a] to have datatype/md5sum [{STRING}/0], but our version has "
            f"[{STRING}/{MD5}] Dropping connection.",
        ),
    ],
)
def test_a_refusal_has_rospys_error_text(graph: Any, header: dict[str, str], error: str) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    with _connected(_tcpros_port(graph, node)) as connection:
        connection.sendall(encode_header(header))
        assert _read_header(connection)["error"].startswith(error)


def test_a_subscriber_that_never_reads_loses_only_its_own_messages(graph: Any, far: Any) -> None:
    node, reader = graph.node("n"), far.node("reader")
    publisher = node.advertise("/a", "std_msgs/UInt8MultiArray", queue_size=3)
    got: list[int] = []
    with _connected(_tcpros_port(graph, node)) as silent:
        silent.sendall(encode_header({"topic": "/a", "md5sum": "*", "callerid": "/deaf", "type": "*"}))
        reader.subscribe("/a", "std_msgs/UInt8MultiArray", lambda m: got.append(int(m.data[0])))
        graph.until(lambda: publisher.subscribers == 2)
        for i in range(40):
            publisher.publish({"data": bytes([i]) * 1_000_000})
            graph.until(lambda i=i: got and got[-1] == i)
        assert publisher.dropped > 0
        links = next(links for topic, _, links in node.endpoints.statistics()[0] if topic == "/a")
        queued = 40 - publisher.dropped - min(sent for _, _, sent, _ in links)
        assert queued <= 3
    assert got == list(range(40))


def test_a_publisher_that_announces_four_gigabytes_is_disconnected(graph: Any, capfd: Any) -> None:
    node = graph.node("n")
    subscription = node.subscribe("/a", STRING, print)
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(PATIENCE_S)
        fake_node = _FakeNode(graph, server.getsockname()[1])
        proxy = MasterProxy(graph.core.uri, "/liar")
        proxy.call("registerPublisher", "/a", STRING, fake_node.uri)
        peer, _ = server.accept()
        with peer:
            peer.settimeout(PATIENCE_S)
            assert _read_header(peer)["callerid"] == "/n"
            peer.sendall(encode_header({"callerid": "/liar", "md5sum": MD5, "type": STRING}) + b"\xff\xff\xff\xff1234")
            assert _is_closed(peer)
        proxy.call("unregisterPublisher", "/a", fake_node.uri)
        graph.until(lambda: subscription.publishers == 0)
        fake_node.stop(graph)
    _still_works(graph, node)


class _FakeNode:
    """Slave API that returns a port of the test as its TCPROS port."""

    def __init__(self, graph: Any, port: int) -> None:
        self._server = RpcServer(lambda _method, _arguments: (1, "", ["TCPROS", "127.0.0.1", port]))
        graph.loop.run(self._server.start("127.0.0.1", 0))
        self.uri = f"http://127.0.0.1:{self._server.port}/"

    def stop(self, graph: Any) -> None:
        graph.loop.run(self._server.stop())


PUBLISHER = """
import sys, time
from trundle.ros import GraphLoop, Node
with GraphLoop() as loop:
    publisher = Node("far", loop=loop, master_uri=sys.argv[1]).advertise("/a", "std_msgs/String")
    while True:
        publisher.publish({"data": sys.argv[2]})
        time.sleep(0.01)
"""


def test_a_killed_publisher_is_connected_again_after_its_restart(graph: Any) -> None:
    got: set[str] = set()
    subscription = graph.node("n").subscribe("/a", STRING, lambda m: got.add(m.data))
    for run in ("first", "second"):
        with subprocess.Popen([sys.executable, "-c", PUBLISHER, graph.core.uri, run]) as process:
            try:
                graph.until(lambda run=run: run in got)
            finally:
                process.send_signal(signal.SIGKILL)
        graph.until(lambda: subscription.publishers == 0)


def test_a_service_that_does_not_answer_or_disconnects_is_an_error(graph: Any) -> None:
    node = graph.node("n")
    graph.ready(node)
    with socket.create_server(("127.0.0.1", 0)) as server:
        uri = f"rosrpc://127.0.0.1:{server.getsockname()[1]}"
        MasterProxy(graph.core.uri, "/broken").call("registerService", "/s", uri, "http://127.0.0.1:9/")
        answer = graph.loop.spawn(node.call_service("/s", "std_srvs/Empty", timeout_s=0.5))
        with pytest.raises(ServiceError, match="did not answer within"):
            answer.result(PATIENCE_S)
        server.settimeout(PATIENCE_S)
        server.accept()[0].close()
        answer = graph.loop.spawn(node.call_service("/s", "std_srvs/Empty"))
        server.accept()[0].close()
        with pytest.raises(ServiceError, match="cannot be called"):
            answer.result(PATIENCE_S)


def test_stopping_a_busy_graph_leaves_no_registration(graph: Any, far: Any) -> None:
    nodes = [far.node(f"n{i}") for i in range(10)]
    for node in nodes:
        node.advertise("/a", STRING)
        node.subscribe("/a", STRING, print)
    far.ready(*nodes)
    far.loop.stop()
    assert all(node.closed.is_set() for node in nodes)
    state = MasterProxy(graph.core.uri).call("getSystemState")
    assert not [name for table in state for name, _ in table if name == "/a"]


def test_a_loop_stopped_during_startup_leaves_nothing_open(messages: Any) -> None:
    """pytest's warning filter catches open servers, accepted connections and unfinished tasks."""
    for _ in range(5):
        loop = GraphLoop(messages=messages)
        loop.start()
        core = Core(loop, port=0)
        loop.run(core.start())
        opening = Node("opening", loop=loop, master_uri=core.uri)
        callers = [socket.create_connection(("127.0.0.1", core.port)) for _ in range(20)]
        late = socket.socket()
        loop.call_soon(lambda late=late, port=core.port: late.connect(("127.0.0.1", port)))
        loop.stop()
        for caller in (*callers, late):
            caller.close()
        del opening, core, loop
        gc.collect()


def test_a_server_is_closed_if_its_start_is_cancelled(messages: Any) -> None:
    """In any pass: asyncio leaks a server that listens already."""

    async def start_and_cancel(passes: int) -> None:
        server = RpcServer(lambda _method, _arguments: (1, "", 0))
        task = asyncio.create_task(server.start("127.0.0.1", 0))
        for _ in range(passes):
            await asyncio.sleep(0)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        await server.stop()

    for passes in range(1, 12):
        with GraphLoop(messages=messages) as loop:
            loop.run(start_and_cancel(passes))
        del loop
        gc.collect()


@pytest.mark.parametrize("server", ["master", "node"])
def test_a_flood_of_silent_connections_blocks_no_client(
    graph: Any, monkeypatch: pytest.MonkeyPatch, server: str
) -> None:
    monkeypatch.setattr("trundle.ros.xmlrpc.rpc_server._MAX_CLIENTS", 20)
    monkeypatch.setattr("trundle.ros.node.slave._MAX_PENDING_PEERS", 20)
    node = graph.node("n")
    node.advertise("/a", STRING)
    port = _tcpros_port(graph, node) if server == "node" else graph.core.port
    with ExitStack() as stack:
        flood = [stack.enter_context(_connected(port)) for _ in range(60)]
        assert all(_is_closed(connection) for connection in flood[:40])
        assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()
        _still_works(graph, node)


def test_udpros_is_refused_unless_tcpros_is_offered_too(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    graph.ready(node)
    udp = ["UDPROS", b"", "127.0.0.1", 5, 1500]
    answer = blocking_call(node.uri, "requestTopic", "/me", "/a", [udp], timeout_s=PATIENCE_S)
    assert answer == [0, "no supported protocol implementations", []]
    answer = blocking_call(node.uri, "requestTopic", "/me", "/a", [udp, ["TCPROS"]], timeout_s=PATIENCE_S)
    assert (answer[0], answer[2][0]) == (1, "TCPROS")


def test_queues_of_two_hundred_topics_stay_bounded(graph: Any, far: Any) -> None:
    """One subscriber reads each topic, another never does: no more messages wait than the queues allow."""
    node, reader = graph.node("n"), far.node("reader")
    topics = [f"/t{i}" for i in range(200)]
    publishers = [node.advertise(topic, "std_msgs/UInt8MultiArray", queue_size=5) for topic in topics]
    got: dict[str, int] = dict.fromkeys(topics, 0)

    def count(topic: str, number: int) -> None:
        got[topic] = number

    for topic in topics:
        reader.subscribe(topic, "std_msgs/UInt8MultiArray", lambda m, t=topic: count(t, int(m.data[0])))
    port = _tcpros_port(graph, node, "/t0")
    with ExitStack() as stack:
        for topic in topics[:50]:
            silent = stack.enter_context(_connected(port))
            silent.sendall(encode_header({"topic": topic, "md5sum": "*", "callerid": "/deaf", "type": "*"}))
        graph.until(lambda: all(p.subscribers == 1 + (p.topic in topics[:50]) for p in publishers))
        for number in range(1, 101):
            for publisher in publishers:
                publisher.publish({"data": bytes([number]) * 20_000})
            graph.until(lambda number=number: all(last == number for last in got.values()))
        for publisher in publishers[:50]:
            links = next(links for topic, _, links in node.endpoints.statistics()[0] if topic == publisher.topic)
            min_sent = min(sent for _, _, sent, _ in links)
            assert 100 - publisher.dropped - min_sent <= 5
    assert all(publisher.dropped == 0 for publisher in publishers[50:])
