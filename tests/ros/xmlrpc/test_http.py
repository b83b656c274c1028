"""HTTP of the master and the nodes: serves programs of every client library, refuses web pages."""

import os
import socket
from contextlib import suppress
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.ros.conftest import PATIENCE_S

from trundle.ros import blocking_call
from trundle.ros.errors import WireError
from trundle.ros.xmlrpc.http import browser_refusal, host_and_port, parse_head
from trundle.ros.xmlrpc.xmlrpc_text import encode_call

_ELECTRON = "Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/537.36 foxglove/1.87 Chrome/120.0 Electron/28.1 Safari/537.36"
_FIREFOX = "Mozilla/5.0 (X11; Linux x86_64; rv:140.0) Gecko/20100101 Firefox/140.0"

PROGRAMS = {
    "rospy": ("User-Agent: Python-xmlrpc/3.8", "Content-Type: text/xml", "Accept-Encoding: gzip"),
    "roscpp": ("User-Agent: XMLRPC++ 0.7", "Content-Type: text/xml"),
    "rosnodejs": ("User-Agent: NodeJS XML-RPC Client", "Content-Type: text/xml", "Accept: text/xml"),
    "goroslib": ("User-Agent: Go-http-client/1.1", "Content-Type: text/xml"),
    "foxglove/ros1": ("User-Agent: node-fetch", "Content-Type: text/xml", "Accept: text/xml"),
    "rosjava": ("User-Agent: Apache XML RPC 3.0", "Content-Type: text/xml"),
    "roslibrust": ("Accept: */*",),
    "rosrust": ("ContentType: xml",),
    "with a charset": ("Content-Type: Text/XML; charset=utf-8",),
    "fetch of Node": ("User-Agent: node", "Sec-Fetch-Mode: cors", "Content-Type: text/xml"),
    "Electron": (f"User-Agent: {_ELECTRON}", "Content-Type: text/xml", "Sec-Fetch-Site: cross-site"),
    "older Electron": (f"User-Agent: {_ELECTRON}", "Content-Type: text/xml", "Origin: file://"),
}
PAGES = {
    "of another origin": ("Origin: http://evil.example", "Content-Type: text/plain;charset=UTF-8"),
    "after rebinding": ("Host: evil.example:11311", "Origin: http://evil.example:11311", "Content-Type: text/xml"),
    "without a type": ("Origin: null",),
    "with metadata": ("Sec-Fetch-Site: cross-site", "Content-Type: text/xml"),
    "with a mode": (f"User-Agent: {_FIREFOX}", "Sec-Fetch-Mode: no-cors"),
    "text": ("Content-Type: text/plain",),
    "a form": ("Content-Type: application/x-www-form-urlencoded",),
    "an empty type": ("Content-Type: ",),
    "in Electron": (f"User-Agent: {_ELECTRON}", "Content-Type: text/xml", "Origin: https://evil.example"),
    "in Electron, without a type": (f"User-Agent: {_ELECTRON}", "Origin: file://"),
}


def _head(fields: tuple[str, ...], method: str = "POST") -> bytes:
    return "\r\n".join([f"{method} / HTTP/1.1", *fields, "", ""]).encode()


@pytest.mark.parametrize("fields", PROGRAMS.values(), ids=PROGRAMS)
def test_programs_are_served(fields: tuple[str, ...]) -> None:
    assert browser_refusal(parse_head(_head(fields))) is None


@pytest.mark.parametrize("fields", PAGES.values(), ids=PAGES)
def test_web_pages_are_refused(fields: tuple[str, ...]) -> None:
    assert browser_refusal(parse_head(_head(fields)))


def _exchange(port: int, data: bytes) -> bytes:
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S) as connection:
        connection.sendall(data)
        answer = b""
        while chunk := connection.recv(65536):
            answer += chunk
    return answer


def _post(port: int, body: bytes, *fields: str) -> bytes:
    return _exchange(port, _head((*fields, f"Content-Length: {len(body)}", "Connection: close")) + body)


def test_a_page_cannot_set_a_parameter_and_is_logged_once(graph: Any, caplog: pytest.LogCaptureFixture) -> None:
    call = encode_call("setParam", ["/page", "/evil", 1])

    fields = ("Origin: http://evil.example", "Content-Type: text/plain")
    answer, _ = [_post(graph.core.port, call, *fields) for _ in range(2)]

    assert answer.startswith(b"HTTP/1.1 403 Forbidden\r\n")
    assert b"a page of 'http://evil.example' sent it, and web pages may not call ROS nodes" in answer
    assert not graph.core.parameters.has("/evil")
    assert [record.levelname for record in caplog.records if "web pages" in record.getMessage()] == ["WARNING"]


def test_a_page_cannot_shut_down_a_node(graph: Any) -> None:
    node = graph.node("n")
    graph.ready(node)
    call = encode_call("shutdown", ["/master", "evil"])

    port = urlsplit(node.uri).port
    assert port is not None
    answer = _post(port, call, "Origin: http://evil.example", "Content-Type: text/xml")

    assert answer.startswith(b"HTTP/1.1 403 Forbidden\r\n")
    assert not node.is_shut_down


def test_the_master_answers_at_any_host_name(graph: Any) -> None:
    """Compose, Kubernetes, mDNS and NAT give a master names that are unknown to it."""
    call = encode_call("getPid", ["/robot"])

    answer = _post(graph.core.port, call, "Host: ros-master.fleet-7.svc:31311", "Content-Type: text/xml")

    assert answer.startswith(b"HTTP/1.1 200 OK\r\n")
    assert f"<int>{os.getpid()}</int>".encode() in answer


@pytest.mark.parametrize("method", ["OPTIONS", "GET"])
def test_a_preflight_request_is_refused(graph: Any, method: str) -> None:
    preflight = ("Origin: http://evil.example", "Access-Control-Request-Method: POST")
    for fields in (preflight, ()):
        answer = _exchange(graph.core.port, _head(fields, method))

        assert answer.startswith((b"HTTP/1.1 403 ", b"HTTP/1.1 501 "))
        assert b"access-control" not in answer.lower()


@pytest.mark.parametrize("method", ["GET", "POST", "OPTIONS", "PUT", "HEAD"])
def test_http_at_a_topics_port_is_disconnected(graph: Any, method: str) -> None:
    """The first four bytes announce a header of over 100 MB."""
    node = graph.node("n")
    node.advertise("/a", "std_msgs/String")
    graph.ready(node)

    port = blocking_call(node.uri, "requestTopic", "/me", "/a", [["TCPROS"]], timeout_s=PATIENCE_S)[2][2]
    answer = b""
    with suppress(ConnectionError):  # it may be reset before all was read
        answer = _exchange(port, _head(("Origin: http://evil.example",), method))
    assert answer == b""


@pytest.mark.parametrize(
    "uri",
    [f"http://{'a' * 70}.example:80/", "http://a..b:80/", "rosrpc://\udcff:80", "http://a:99999/", "http://a:-1/"],
)
def test_an_address_that_sockets_reject_is_refused(uri: str) -> None:
    with pytest.raises(WireError):
        host_and_port(uri)
