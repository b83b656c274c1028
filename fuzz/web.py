"""The page's server and rosbridge: WebSockets, HTTP, uploads and archives."""

import io
import socket
import zipfile
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from trundle.base.http.page_address import PageAddress
from trundle.gazebo.nodes import BuiltinReplacement, NodeHost, run_builtin_node
from trundle.gazebo.nodes.catalog import BUILTIN_NODES
from trundle.page import GraphAddress, Request, Session
from trundle.page.http.listening import listen
from trundle.page.server import _serve as serve_page  # pyright: ignore[reportPrivateUsage]  # its process in this one
from trundle.page.wire import Respond, Start
from trundle.ros import Core, GraphLoop, Node

from .connection import SEPARATOR, exchange, send_only, send_web_socket
from .seeds import seed
from .target import Execute, Open, Target

_PATIENCE_S = 60.0
_HOST, _TOKEN = b"@HOST@", b"@TOKEN@"
_BOUNDARY = "----fuzz"
_STRING = "std_msgs/String"


class _Server:
    """A server with its port and the query that authorizes clients."""

    def __init__(self, port: int, query: str = "") -> None:
        self.port = port
        self.target = f"/?{query}" if query else "/"

    def fill(self, data: bytes) -> bytes:
        """Return an input with the server's address and token."""
        token = self.target.partition("token=")[2].encode()
        return data.replace(_HOST, b"127.0.0.1:%d" % self.port).replace(_TOKEN, token)


class _Owner:
    """Owner of the page, in place of its pipe, which answers all requests."""

    def __init__(self, loop: GraphLoop) -> None:
        self._loop = loop
        self.page: Any = None

    def send(self, message: object) -> None:
        if isinstance(message, Request):
            answer = Respond(message.id, picture=b"\x89PNG")
            self._loop.call_soon(lambda: self.page.receive_from_owner(answer))


@contextmanager
def _graph(loop: GraphLoop) -> Generator[str]:
    """Run a master and a node with a topic and a service."""
    core = Core(loop, port=0)
    loop.run(core.start(), _PATIENCE_S)
    node = Node("ours", loop=loop, master_uri=core.uri)
    node.advertise("/chat", _STRING, latch=True).publish({"data": "latched"})
    node.advertise_service("/set", "std_srvs/SetBool", lambda request: {"success": request.data})
    loop.run(node.wait_registered(), _PATIENCE_S)
    yield core.uri


def _page(feed: Callable[[_Server, bytes], object], *, joins_graph: bool = True) -> Open:
    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        with GraphLoop() as loop, _graph(loop) as uri:
            start = Start(
                host="127.0.0.1", port=0, hosts=(), origins=(), session=Session(title="t", kind="simulation"),
                graph=GraphAddress(master_uri=uri) if joins_graph else None, source=bytes(folder),
                token="control", view_token="view",
            )  # fmt: skip
            address = PageAddress(port=0)
            owner, listening = _Owner(loop), listen(address)
            owner.page = loop.run(serve_page(start, loop, listening, address, owner))  # pyright: ignore[reportArgumentType]
            server = _Server(int(listening.getsockname()[1]), urlsplit(owner.page.addresses.foxglove_url).query)
            yield lambda data: feed(server, data)

    return opened


def _bridge(executable: str, feed: Callable[[_Server, bytes], object]) -> Open:
    @contextmanager
    def opened(_: Path) -> Generator[Execute]:
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = int(free.getsockname()[1])
        with GraphLoop() as loop, _graph(loop) as uri:
            node = Node("bridge", loop=loop, master_uri=uri, params={"port": port})
            replacement = BuiltinReplacement(BUILTIN_NODES["rosbridge_server", executable])
            loop.spawn(run_builtin_node(replacement, node, [], NodeHost()))
            _wait_for(port)
            server = _Server(port)
            yield lambda data: feed(server, data)

    return opened


def _wait_for(port: int) -> None:
    import time

    end = time.monotonic() + _PATIENCE_S
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), timeout=_PATIENCE_S).close()
        except ConnectionRefusedError:
            if time.monotonic() > end:
                raise
            time.sleep(0.05)
        else:
            return


def _form(*files: tuple[str, bytes]) -> bytes:
    """Return the body of an upload."""
    body = b""
    for name, content in files:
        head = f'Content-Disposition: form-data; name="{name}"; filename="{name}"'
        body += (
            f"--{_BOUNDARY}\r\n{head}\r\nContent-Type: application/octet-stream\r\n\r\n".encode() + content + b"\r\n"
        )
    return body + f"--{_BOUNDARY}--\r\n".encode()


def _post(server: _Server, body: bytes) -> None:
    head = (
        f"POST /models{server.target[1:]} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nConnection: close\r\n"
        f"Content-Type: multipart/form-data; boundary={_BOUNDARY}\r\nContent-Length: {len(body)}\r\n\r\n"
    )
    exchange(server.port, head.encode() + body)


def _zip(*files: tuple[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", method) as packed:
        for name, content in files:
            packed.writestr(name, content)
    return buffer.getvalue()


def _model() -> tuple[tuple[str, bytes], ...]:
    config = b"<model><name>cart</name><sdf version='1.6'>model.sdf</sdf></model>"
    return (
        ("cart/model.config", config),
        ("cart/model.sdf", seed("model.sdf")),
        ("cart/meshes/car.obj", seed("car.obj")),
    )


def _sessions(file: str) -> list[bytes]:
    """Return the sessions in a file: one message per line, bytes in hexadecimal, an empty line between sessions."""
    sessions = [session.splitlines() for session in seed(file).split(b"\n\n")]
    return [
        SEPARATOR.join(bytes.fromhex(line[4:].decode()) if line.startswith(b"hex ") else line for line in lines)
        for lines in sessions
    ]


def _http_requests() -> list[bytes]:
    targets = (
        "/", "/session.json", "/world/a.glb", "/camera.png?width=8&height=8&position=0&position=0&position=1",
        "/model.png?uri=model://box", "/model.glb?uri=model://box", "/assets/index.js", "/..%2f..%2fetc/passwd",
    )  # fmt: skip
    token = b"token=" + _TOKEN
    gets = [
        b"GET %b%b%b HTTP/1.1\r\nHost: %b\r\nOrigin: http://%b\r\nConnection: close\r\n\r\n"
        % (target.encode(), b"&" if "?" in target else b"?", token, _HOST, _HOST)
        for target in targets
    ]
    body = _form(*_model())
    fields = b"Content-Type: multipart/form-data; boundary=%b\r\nContent-Length: %d" % (_BOUNDARY.encode(), len(body))
    head = b"POST /models?%b HTTP/1.1\r\nHost: %b\r\nConnection: close\r\n%b\r\n\r\n"
    upload = head % (token, _HOST, fields) + body
    upgrade = (
        b"GET /?%b HTTP/1.1\r\nHost: %b\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n"
        b"Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n\x81\x82\0\0\0\0{}\x88\x82\0\0\0\0\x03\xe8"
    ) % (token, _HOST)
    return [*gets, upload, upgrade]


_JSON_WORDS = (
    b"null", b"1e999", b"-1", b"[]", b"{}", b'"\\u0000"', b'"\\ud800"', b"NaN", b"18446744073709551616",
    b"4294967295", SEPARATOR, b"/cmd_vel", b"geometry_msgs/Twist", b"std_msgs/None", b"file:///etc/passwd",
    b"trundle/request", b"ros1", b"json", b"cdr",
)  # fmt: skip
_HTTP_WORDS = (
    b"Transfer-Encoding: chunked", b"Content-Length: 9", b"Range: bytes=0-1", b"Expect: 100-continue", b"HEAD",
    b"OPTIONS", b"Content-Encoding: gzip", b"%00", b"%2e%2e/", b"Host: evil", b"Cookie: a=b",
    b"multipart/form-data; boundary=x", _HOST, _TOKEN, b'filename="../x"', b"Content-Transfer-Encoding: base64",
    b"name*=utf-8''%ff",
)  # fmt: skip

TARGETS = {
    "foxglove": Target(
        open=_page(lambda server, data: send_web_socket(server.port, server.target, "trundle.v1", data)),
        seeds=lambda: _sessions("foxglove.txt"),
        words=_JSON_WORDS,
    ),
    "http": Target(
        open=_page(lambda server, data: exchange(server.port, server.fill(data)), joins_graph=False),
        seeds=_http_requests,
        words=_HTTP_WORDS,
    ),
    "upload": Target(
        open=_page(_post, joins_graph=False),
        seeds=lambda: [_form(*_model()), _form(("cart.zip", _zip(*_model()))), _form(("model.sdf", seed("model.sdf")))],
        words=_HTTP_WORDS,
    ),
    "zip": Target(
        open=_page(lambda server, data: _post(server, _form(("cart.zip", data))), joins_graph=False),
        seeds=lambda: [_zip(*_model()), _zip(*_model(), method=zipfile.ZIP_STORED), _zip(("../x", b"y"))],
        words=(b"PK\1\2", b"PK\3\4", b"PK\5\6", b"PK\6\6", b"PK\6\7", b"../", b"cart/model.config", b"C:", b"\\"),
    ),
    "rosbridge": Target(
        open=_bridge("rosbridge_websocket", lambda server, data: send_web_socket(server.port, "/", None, data)),
        seeds=lambda: _sessions("rosbridge.txt"),
        words=_JSON_WORDS,
    ),
    "rosbridge-tcp": Target(
        open=_bridge("rosbridge_tcp", lambda server, data: send_only(server.port, data)),
        seeds=lambda: [session.replace(SEPARATOR, b"") for session in _sessions("rosbridge.txt")],
        words=_JSON_WORDS,
    ),
}
