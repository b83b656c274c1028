"""A foreign web page in a real browser: it reaches neither the robot's graph nor the page, which goes on working."""

import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.graphs import running_graph
from tests.viewer.conftest import make_scene, make_state

from trundle.ros import MasterProxy, Messages
from trundle.ros.xmlrpc.xmlrpc import encode_call
from trundle.viewer import Viewer

pytestmark = [pytest.mark.browser, pytest.mark.slow]

_CALL = """
async ({master, body}) => {
  const types = ["text/plain", "application/x-www-form-urlencoded", "", "text/xml"];
  for (const type of types) {
    const blob = new Blob([body.replace("NAME", "from_" + (type || "none").replace(/\\W/g, "_"))], {type});
    await fetch(master, {method: "POST", mode: "no-cors", body: blob}).catch(() => 0);
    await fetch(master, {method: "POST", headers: type ? {"Content-Type": type} : {}, body: blob}).catch(() => 0);
  }
  navigator.sendBeacon(master, body.replace("NAME", "from_beacon"));
}
"""
_CONNECT = """
({url, protocol}) => new Promise(resolve => {
  const socket = new WebSocket(url, protocol);
  socket.onopen = () => resolve("opened");
  socket.onerror = () => resolve("refused");
})
"""
_READ = "url => fetch(url).then(answer => answer.text()).catch(() => 'unreadable')"


class _Page(BaseHTTPRequestHandler):
    """An empty page; `asked` counts requests to its server."""

    asked: list[str]

    def do_GET(self) -> None:
        self.asked.append(self.headers.get("Upgrade", self.path))
        body = b"<!doctype html><title>foreign</title>"
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing."""


@pytest.fixture
def foreign(chromium: Any) -> Iterator[Any]:
    """Open a page of another port; its `asked` counts that server's requests."""
    asked: list[str] = []
    server = ThreadingHTTPServer(("127.0.0.1", 0), type("Page", (_Page,), {"asked": asked}))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    page = chromium.new_page()
    page.goto(f"http://localhost:{server.server_address[1]}/")
    page.asked = asked
    yield page
    page.close()
    server.shutdown()
    server.server_close()


def test_it_sets_no_parameter(foreign: Any) -> None:
    with running_graph(Messages()) as graph:
        body = encode_call("setParam", ["/page", "/NAME", 1]).decode()
        before = MasterProxy(graph.core.uri).call("getParamNames")

        foreign.evaluate(_CALL, {"master": graph.core.uri, "body": body})
        foreign.evaluate(_READ, graph.core.uri)  # the beacon came before

        assert MasterProxy(graph.core.uri).call("getParamNames") == before


def test_it_neither_connects_to_the_page_nor_reads_nor_frames_it(foreign: Any, page: Any, viewer: Viewer) -> None:
    from importlib.metadata import version

    url = f"ws://{urlsplit(viewer.url).netloc}"
    asked = {"url": url, "protocol": f"viser-v{version('viser')}"}

    assert foreign.evaluate(_CONNECT, asked) == "refused"
    assert page.evaluate(_CONNECT, asked) == "opened"
    assert foreign.evaluate(_READ, viewer.url) == "unreadable"
    assert "refused" not in page.evaluate(_READ, viewer.url)

    foreign.evaluate(
        "url => { const f = document.createElement('iframe'); f.src = url; document.body.append(f) }", viewer.url
    )
    for _ in range(100):  # the browser's own page takes the place of a refused one
        if [frame.url for frame in foreign.frames[1:]] != [""]:
            break
        foreign.wait_for_timeout(100)
    assert [frame.url for frame in foreign.frames[1:]] == ["chrome-error://chromewebdata/"]


def test_a_link_cannot_have_the_page_obey_another_server(chromium: Any, foreign: Any, viewer: Viewer) -> None:
    """viser's client connects to the server in its address, whose messages would run as this page."""
    server = f"ws://{urlsplit(foreign.url).netloc}"
    page = chromium.new_page()
    page.goto(f"{viewer.url}/?websocket={server}")
    page.wait_for_timeout(1500)
    page.close()

    assert "websocket" not in [asked.lower() for asked in foreign.asked]


def test_the_page_works_with_its_token_where_others_reach_it(chromium: Any) -> None:
    with Viewer.start(make_scene(), host="0.0.0.0", port=0, state=make_state()) as viewer:
        page = chromium.new_page()
        page.goto(viewer.url)
        page.wait_for_selector("text=real-time factor")
        page.goto(viewer.url.partition("?")[0])  # the cookie opens, too
        page.wait_for_selector("text=real-time factor")
        page.close()
