"""Peers that are slow, gone, broken or hostile: nothing they send stops a node or the master."""

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


def _ends(connection: socket.socket) -> bool:
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
def test_what_is_no_request_ends_that_connection_only(graph: Any, request_bytes: bytes) -> None:
    with _connected(graph.core.port) as connection:
        with suppress(ConnectionError):
            connection.sendall(request_bytes)
        assert _ends(connection)
    assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()


@pytest.mark.parametrize("body", [b"", b"<x/>", b"<?xml version='1.0'?><!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>"])
def test_a_body_that_is_no_call_is_answered_with_a_fault(graph: Any, body: bytes) -> None:
    with _connected(graph.core.port) as connection:
        connection.sendall(b"POST / HTTP/1.0\r\nContent-Length: %d\r\n\r\n%b" % (len(body), body))
        answer = b""
        while chunk := connection.recv(65536):
            answer += chunk
    assert answer.startswith(b"HTTP/1.1 200 OK")
    assert b"<fault>" in answer


def test_half_a_request_waits_for_nobody(graph: Any) -> None:
    with _connected(graph.core.port) as connection:
        connection.sendall(b"POST / HTTP/1.1\r\nContent-Le")
        assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()


def test_five_hundred_connections_come_and_go(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    for port in (graph.core.port, _tcpros_port(graph, node)):
        for _ in range(5):
            several = [socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S) for _ in range(50)]
            for connection in several:
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
    ids=["garbage", "4 GB", "lies", "no =", "no caller", "no topic", "not here", "md5", "type", "no service"],
)
def test_a_header_that_does_not_fit_ends_that_connection_only(graph: Any, data: bytes) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    with _connected(_tcpros_port(graph, node)) as connection:
        connection.sendall(data)
        connection.shutdown(socket.SHUT_WR)
        assert _ends(connection)
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
def test_a_refusal_says_why_in_rospys_words(graph: Any, header: dict[str, str], error: str) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    with _connected(_tcpros_port(graph, node)) as connection:
        connection.sendall(encode_header(header))
        assert _read_header(connection)["error"].startswith(error)


def test_a_subscriber_that_never_reads_costs_only_its_own_messages(graph: Any, far: Any) -> None:
    node, reader = graph.node("n"), far.node("reader")
    publisher = node.advertise("/a", "std_msgs/UInt8MultiArray", queue_size=3)
    got: list[int] = []
    with _connected(_tcpros_port(graph, node)) as deaf:
        deaf.sendall(encode_header({"topic": "/a", "md5sum": "*", "callerid": "/deaf", "type": "*"}))
        reader.subscribe("/a", "std_msgs/UInt8MultiArray", lambda m: got.append(int(m.data[0])))
        graph.until(lambda: publisher.subscribers == 2)
        for i in range(40):
            publisher.publish({"data": bytes([i]) * 1_000_000})
            graph.until(lambda i=i: got and got[-1] == i)
        assert publisher.dropped > 0
        links = next(links for topic, _, links in node.endpoints.statistics()[0] if topic == "/a")
        waiting = 40 - publisher.dropped - min(sent for _, _, sent, _ in links)
        assert waiting <= 3
    assert got == list(range(40))


def test_a_publisher_that_promises_four_gigabytes_is_dropped(graph: Any, capfd: Any) -> None:
    node = graph.node("n")
    subscription = node.subscribe("/a", STRING, print)
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(PATIENCE_S)
        liar = _LyingNode(graph, server.getsockname()[1])
        proxy = MasterProxy(graph.core.uri, "/liar")
        proxy.call("registerPublisher", "/a", STRING, liar.uri)
        peer, _ = server.accept()
        with peer:
            peer.settimeout(PATIENCE_S)
            assert _read_header(peer)["callerid"] == "/n"
            peer.sendall(encode_header({"callerid": "/liar", "md5sum": MD5, "type": STRING}) + b"\xff\xff\xff\xff1234")
            assert _ends(peer)
        proxy.call("unregisterPublisher", "/a", liar.uri)
        graph.until(lambda: subscription.publishers == 0)
        liar.stop(graph)
    _still_works(graph, node)


class _LyingNode:
    """Node that states a port of the test's as that of its topics."""

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


def test_a_publisher_that_is_killed_is_found_again_when_it_comes_back(graph: Any) -> None:
    got: set[str] = set()
    subscription = graph.node("n").subscribe("/a", STRING, lambda m: got.add(m.data))
    for life in ("first", "second"):
        with subprocess.Popen([sys.executable, "-c", PUBLISHER, graph.core.uri, life]) as process:
            try:
                graph.until(lambda life=life: life in got)
            finally:
                process.send_signal(signal.SIGKILL)
        graph.until(lambda: subscription.publishers == 0)


def test_a_service_that_breaks_off_is_an_error_in_time(graph: Any) -> None:
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


def test_stopping_a_busy_graph_leaves_nothing_behind(graph: Any, far: Any) -> None:
    nodes = [far.node(f"n{i}") for i in range(10)]
    for node in nodes:
        node.advertise("/a", STRING)
        node.subscribe("/a", STRING, print)
    far.ready(*nodes)
    far.loop.stop()
    assert all(node.closed.is_set() for node in nodes)
    state = MasterProxy(graph.core.uri).call("getSystemState")
    assert not [name for table in state for name, _ in table if name == "/a"]


def test_a_loop_that_is_left_in_the_middle_leaves_nothing_open(messages: Any) -> None:
    """Half-opened servers, accepted connections and unfinished tasks: pytest's filter catches each."""
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


def test_a_server_whose_opening_is_cancelled_is_closed(messages: Any) -> None:
    """At any moment: asyncio forgets a server that listens already."""

    async def open_and_give_up(passes: int) -> None:
        server = RpcServer(lambda _method, _arguments: (1, "", 0))
        task = asyncio.create_task(server.start("127.0.0.1", 0))
        for _ in range(passes):
            await asyncio.sleep(0)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        await server.stop()

    for passes in range(1, 12):
        with GraphLoop(messages=messages) as loop:
            loop.run(open_and_give_up(passes))
        del loop
        gc.collect()


@pytest.mark.parametrize("server", ["master", "node"])
def test_a_flood_of_silent_connections_shuts_nobody_out(
    graph: Any, monkeypatch: pytest.MonkeyPatch, server: str
) -> None:
    monkeypatch.setattr("trundle.ros.xmlrpc.rpc_server._MAX_CLIENTS", 20)
    monkeypatch.setattr("trundle.ros.node.slave._MAX_NEWCOMERS", 20)
    node = graph.node("n")
    node.advertise("/a", STRING)
    port = _tcpros_port(graph, node) if server == "node" else graph.core.port
    with ExitStack() as stack:
        flood = [stack.enter_context(_connected(port)) for _ in range(60)]
        assert all(_ends(connection) for connection in flood[:40])
        assert MasterProxy(graph.core.uri).call("getPid") == os.getpid()
        _still_works(graph, node)


def test_udpros_is_refused_politely(graph: Any) -> None:
    node = graph.node("n")
    node.advertise("/a", STRING)
    graph.ready(node)
    udp = ["UDPROS", b"", "127.0.0.1", 5, 1500]
    answer = blocking_call(node.uri, "requestTopic", "/me", "/a", [udp], timeout_s=PATIENCE_S)
    assert answer == [0, "no supported protocol implementations", []]
    answer = blocking_call(node.uri, "requestTopic", "/me", "/a", [udp, ["TCPROS"]], timeout_s=PATIENCE_S)
    assert (answer[0], answer[2][0]) == (1, "TCPROS")


def test_two_hundred_topics_at_once_stay_bounded(graph: Any, far: Any) -> None:
    """One subscriber reads each topic, another never does: nothing piles up but what the queues allow."""
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
            deaf = stack.enter_context(_connected(port))
            deaf.sendall(encode_header({"topic": topic, "md5sum": "*", "callerid": "/deaf", "type": "*"}))
        graph.until(lambda: all(p.subscribers == 1 + (p.topic in topics[:50]) for p in publishers))
        for number in range(1, 101):
            for publisher in publishers:
                publisher.publish({"data": bytes([number]) * 20_000})
            graph.until(lambda number=number: all(last == number for last in got.values()))
        for publisher in publishers[:50]:
            links = next(links for topic, _, links in node.endpoints.statistics()[0] if topic == publisher.topic)
            fewest = min(sent for _, _, sent, _ in links)
            assert 100 - publisher.dropped - fewest <= 5
    assert all(publisher.dropped == 0 for publisher in publishers[50:])
