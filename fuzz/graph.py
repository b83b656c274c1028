"""ROS' sockets: master, a node's slave API, its topics and services, and faulty peers."""

import socket
import struct
from collections.abc import Awaitable, Callable, Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from trundle.ros import Core, GraphLoop, MasterProxy, Message, Node, RosError, RpcServer, blocking_call

from .connection import exchange, send_only
from .target import Execute, Open, Target

_PATIENCE_S = 60.0
_TYPE, _MD5 = "std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1"
_SERVICE, _SERVICE_MD5 = "std_srvs/SetBool", "09fb03525b03e7ea1fd3992bafd87e16"
_WORDS = (
    b"callerid=/x", b"md5sum=*", b"type=*", b"topic=/a", b"service=/s", b"probe=1", b"persistent=1", b"latching=1",
    b"tcp_nodelay=1", b"message_definition=", b"error=no", b"\1", b"\0", _MD5.encode(),
)  # fmt: skip
_XML_WORDS = (
    b"<value><i4>1</i4></value>", b"<value><double>nan</double></value>", b"<value><boolean>2</boolean></value>",
    b"<value><dateTime.iso8601>20200101T00:00:00</dateTime.iso8601></value>", b"<value><base64>aGk=</base64></value>",
    b"<value><array><data></data></array></value>", b"<value><struct></struct></value>", b"<value></value>", b"<nil/>",
    b"Content-Length: 5", b"Transfer-Encoding: chunked", b"Connection: keep-alive",
    b"<?xml version='1.0' encoding='x'?>", b"system.multicall", b"system.listMethods", b"/../x", b"UDPROS",
    b"TCPROS", b"http://127.0.0.1:9/",
)  # fmt: skip


class _Graph:
    """A master and a node with a latched topic /a and a service /s."""

    def __init__(self, loop: GraphLoop) -> None:
        self.loop = loop
        self.core = Core(loop, port=0)
        loop.run(self.core.start(), _PATIENCE_S)
        self.node = Node("n", loop=loop, master_uri=self.core.uri)
        self.node.advertise("/a", _TYPE, latch=True).publish({"data": "latched"})
        self.node.advertise_service("/s", _SERVICE, lambda request: {"success": request.data})
        loop.run(self.node.wait_registered(), _PATIENCE_S)
        reply = blocking_call(self.node.uri, "requestTopic", "/me", "/a", [["TCPROS"]], timeout_s=_PATIENCE_S)
        self.tcpros_port = int(reply[2][2])

    def check(self) -> None:
        """Check that both servers answer."""
        MasterProxy(self.core.uri).call("getPid")
        blocking_call(self.node.uri, "getPid", "/me", timeout_s=_PATIENCE_S)


def _serves(feed: Callable[[_Graph], Execute]) -> Open:
    """Return an `open` that feeds inputs to a graph, which must answer after every input."""

    @contextmanager
    def opened(_: Path) -> Generator[Execute]:
        with GraphLoop() as loop:
            graph = _Graph(loop)
            execute = feed(graph)

            def checked(data: bytes) -> None:
                execute(data)
                graph.check()

            yield checked

    return opened


def _to_node(graph: _Graph) -> Execute:
    port = int(graph.node.uri.rstrip("/").rpartition(":")[2])

    def execute(data: bytes) -> None:
        if b"shutdown" not in data:  # it would shut the node down
            exchange(port, data)

    return execute


def _to_subscriber(graph: _Graph) -> Execute:
    """Let the node connect to a publisher that sends the input."""
    server = socket.create_server(("127.0.0.1", 0))
    server.settimeout(_PATIENCE_S)
    slave_api = RpcServer(lambda _method, _arguments: (1, "", ["TCPROS", "127.0.0.1", server.getsockname()[1]]))
    graph.loop.run(slave_api.start("127.0.0.1", 0))
    graph.node.subscribe("/b", _TYPE, _ignore)
    graph.loop.run(graph.node.wait_registered(), _PATIENCE_S)

    def update(*publishers: str) -> None:
        blocking_call(graph.node.uri, "publisherUpdate", "/master", "/b", list(publishers), timeout_s=_PATIENCE_S)

    def execute(data: bytes) -> None:
        update(f"http://127.0.0.1:{slave_api.port}/")
        _answer(server, data)
        update()

    return execute


def _to_client(graph: _Graph) -> Execute:
    """Let the node call a service that responds with the input."""
    server = socket.create_server(("127.0.0.1", 0))
    server.settimeout(_PATIENCE_S)
    uri = f"rosrpc://127.0.0.1:{server.getsockname()[1]}"
    MasterProxy(graph.core.uri, "/faulty").call("registerService", "/faulty_service", uri, "http://127.0.0.1:9/")

    def execute(data: bytes) -> None:
        call = graph.loop.spawn(
            _ignore_errors(graph.node.call_service("/faulty_service", _SERVICE, timeout_s=_PATIENCE_S))
        )
        _answer(server, data)
        call.result(_PATIENCE_S)

    return execute


async def _ignore_errors(call: Awaitable[object]) -> None:
    with suppress(RosError):
        await call


def _answer(server: socket.socket, data: bytes) -> None:
    """Accept a connection, read the peer's header, and send an input."""
    peer, _ = server.accept()
    with peer, suppress(ConnectionError):
        peer.settimeout(_PATIENCE_S)
        peer.recv(65536)
        peer.sendall(data)
        peer.shutdown(socket.SHUT_WR)
        while peer.recv(65536):
            pass


def _ignore(_: Message) -> None:
    """Callback of the subscription."""


def _header(**fields: str) -> bytes:
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(struct.pack("<I", len(line)) + line for line in lines)
    return struct.pack("<I", len(body)) + body


def _call(method: str, *arguments: Any) -> bytes:
    import xmlrpc.client

    body = xmlrpc.client.dumps(arguments, method).encode()
    return b"POST /RPC2 HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n%b" % (
        len(body),
        body,
    )


def _master_calls() -> list[bytes]:
    uri = "http://127.0.0.1:9/"
    return [
        _call("registerPublisher", "/x", "/t", _TYPE, uri), _call("registerSubscriber", "/x", "/t", "*", uri),
        _call("unregisterPublisher", "/x", "/t", uri),
        _call("registerService", "/x", "/s2", "rosrpc://127.0.0.1:9", uri),
        _call("setParam", "/x", "/p/q", {"a": [1, 2.5, True, "b"], "c": {"d": "e"}}),
        _call("getParam", "/x", "/p"), _call("searchParam", "/x", "p"), _call("deleteParam", "/x", "/p/q"),
        _call("subscribeParam", "/x", uri, "/p"), _call("getSystemState", "/x"),
        _call("lookupNode", "/x", "/n"), _call("getTopicTypes", "/x"),
        _call("system.multicall", [{"methodName": "getPid", "params": ["/x"]}]), b"GET / HTTP/1.1\r\n\r\n",
    ]  # fmt: skip


def _slave_calls() -> list[bytes]:
    udp = ["UDPROS", b"\x04\0\0\0a=bc", "127.0.0.1", 5, 1500]
    return [
        _call("requestTopic", "/x", "/a", [["TCPROS"]]), _call("requestTopic", "/x", "/a", [udp, ["TCPROS"]]),
        _call("requestTopic", "/x", "/a", [["UNIXROS", "x"]]), _call("getBusInfo", "/x"), _call("getBusStats", "/x"),
        _call("paramUpdate", "/x", "/p", {"a": 1}), _call("publisherUpdate", "/master", "/b", ["http://127.0.0.1:9/"]),
        _call("getPublications", "/x"), _call("getMasterUri", "/x"),
    ]  # fmt: skip


def _text(content: str) -> bytes:
    body = struct.pack("<I", len(content)) + content.encode()
    return struct.pack("<I", len(body)) + body


_SUBSCRIBE = _header(topic="/a", md5sum=_MD5, callerid="/x", type=_TYPE, tcp_nodelay="1")
_CALL = _header(service="/s", md5sum=_SERVICE_MD5, callerid="/x", type=_SERVICE, persistent="1")
_PUBLISHER = _header(callerid="/faulty", md5sum=_MD5, type=_TYPE, latching="1", message_definition="string data\n")
_SERVER = _header(callerid="/faulty", md5sum=_SERVICE_MD5, type=_SERVICE)
_ANSWER = struct.pack("<I", 5) + b"\1" + struct.pack("<I", 0)

TARGETS = {
    "xmlrpc": Target(
        open=_serves(lambda graph: lambda data: exchange(graph.core.port, data)), seeds=_master_calls, words=_XML_WORDS
    ),
    "slave": Target(open=_serves(_to_node), seeds=_slave_calls, words=_XML_WORDS),
    "tcpros": Target(
        open=_serves(lambda graph: lambda data: send_only(graph.tcpros_port, data)),
        seeds=lambda: [
            _SUBSCRIBE,
            _CALL + struct.pack("<I", 1) + b"\1" + struct.pack("<I", 1) + b"\0",
            _header(service="/s", probe="1"),
        ],
        words=_WORDS,
    ),
    "tcpros-client": Target(
        open=_serves(_to_subscriber),
        seeds=lambda: [_PUBLISHER + _text("one") + _text("two"), _header(error="no"), _PUBLISHER + _text("x" * 9000)],
        words=_WORDS,
    ),
    "service-client": Target(
        open=_serves(_to_client),
        seeds=lambda: [_SERVER + b"\1" + _ANSWER, _SERVER + b"\0" + struct.pack("<I", 2) + b"no", _header(error="no")],
        words=_WORDS,
    ),
}
