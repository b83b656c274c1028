"""The server's process: its start, its port, its end."""

import contextlib
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from urllib.parse import urlsplit

import pytest
from tests.graphs import until
from tests.manifests import empty_manifest
from tests.page_client import ProtocolClient, page_url
from websockets.exceptions import ConnectionClosed, WebSocketException

from trundle.base.diagnostics import UsageError
from trundle.base.http.page_address import PageAddress
from trundle.page import ClockState, PageServer, Session, server_process

SESSION = Session(title="test", kind="graph")


def test_a_port_in_use_is_named_in_the_error() -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        with pytest.raises(UsageError, match=f"cannot serve the page at 127.0.0.1:{port}: .*leave out the port"):
            PageServer.start(SESSION, at=PageAddress(port=port))


def test_the_next_free_port_from_8080_is_used() -> None:
    with PageServer.start(SESSION) as one, PageServer.start(SESSION) as two:
        ports = [urlsplit(page.url).port or 0 for page in (one, two)]

    assert 8080 <= ports[0] < ports[1] < 8280


def test_an_unknown_host_is_named_in_the_error() -> None:
    with pytest.raises(UsageError, match="cannot serve the page at host 'no such host'"):
        PageServer.start(SESSION, at=PageAddress(host="no such host"))


def test_closing_frees_the_port_and_can_be_repeated() -> None:
    page = PageServer.start(SESSION, at=PageAddress(port=0))
    port = urlsplit(page.url).port
    with ProtocolClient(page.url):
        page.close()
        page.close()

    assert not page.alive
    socket.create_server(("127.0.0.1", port)).close()


def test_a_killed_server_comes_back_with_its_links_and_all_that_it_showed() -> None:
    lines: list[str] = []
    with PageServer.start(SESSION, at=PageAddress(port=0), say=lines.append) as page:
        url, view_url = page.url, page.view_url
        page.set_session(Session(title="another", kind="simulation"))
        for notice, text in (("physics", "it is unstable"), ("over", "a past warning"), ("over", None)):
            page.set_notice(notice, text)
        page.set_world(empty_manifest(generation=3, name="yard"), {})
        page.put_state(ClockState(time_ns=5, paused=True))
        with ProtocolClient(url) as client:
            client.send("trundle/request", id="first", request="play")
            until(lambda: [request.id for request in page.requests()] == [1])
            os.kill(page.process_id, signal.SIGKILL)
            with pytest.raises(ConnectionClosed):
                client.settle(60)
        page.put_state(ClockState(time_ns=7, paused=True))

        with _connected_again(url) as client, _connected_again(view_url) as viewer:
            for topic in ("trundle/session", "trundle/world", "trundle/state"):
                client.subscribe(topic)
            client.until(lambda: client.payloads("trundle/state"))
            session, world, state = (
                json.loads(client.payloads(f"trundle/{t}")[-1]) for t in ("session", "world", "state")
            )
            assert (session["title"], world["name"], world["generation"], state["time_ns"]) == ("another", "yard", 3, 7)
            assert [status["message"] for status in client.statuses] == ["it is unstable"]
            viewer.until(lambda: viewer.channels)
            page.respond(1)  # of a client that is gone
            client.send("trundle/request", id="second", request="pause")
            until(lambda: [request.id for request in page.requests()] == [2])
            page.respond(2)
            assert client.last("trundle/response")["id"] == "second"
        assert (page.alive, page.url, page.view_url) == (True, url, view_url)
    assert lines == ["the page's server has ended with exit code -9; it is started again, its links stay"]
    assert not page.alive


def _connected_again(url: str) -> ProtocolClient:
    end = time.monotonic() + 60
    while time.monotonic() < end:
        with contextlib.suppress(OSError, WebSocketException):  # the killed server may still have listened
            return ProtocolClient(url)
        time.sleep(0.02)
    raise AssertionError("the server does not come back")


def test_a_server_that_keeps_ending_is_given_up_with_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_process, "_MAX_ENDS", 2)
    lines: list[str] = []
    with PageServer.start(SESSION, at=PageAddress(port=0), say=lines.append) as page:
        for _ in range(2):
            with _connected_again(page.url):
                killed = page.process_id
                os.kill(killed, signal.SIGKILL)
            until(lambda: page.process_id != killed or not page.alive)  # noqa: B023
        page.put_lines(0, [])
        page.set_session(SESSION)
        assert page.requests() == []
        assert not page.alive
    assert lines[-1] == (
        "the page is closed: its server has ended 2 times, the last time with exit code -9. "
        "To see it again, end this with Ctrl-C and start it anew"
    )


@pytest.mark.slow
def test_a_port_that_another_program_took_meanwhile_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server_process, "_MAX_ENDS", 2)
    monkeypatch.setattr(server_process, "_PORT_RETRY_S", 0.01)
    lines: list[str] = []
    with (
        socket.create_server(("127.0.0.1", 0)) as other,
        PageServer.start(SESSION, at=PageAddress(port=0), say=lines.append) as page,
    ):
        page._process._change_start(port=other.getsockname()[1])
        os.kill(page.process_id, signal.SIGKILL)
        until(lambda: not page.alive)
    assert re.match("the page is closed: cannot serve the page at 127.0.0.1:.* in use.* end this", lines[-1])


def test_the_server_ends_when_its_owner_is_killed() -> None:
    program = (
        "import time; from trundle.page import PageServer, Session\n"
        "from trundle.base.http.page_address import PageAddress\n"
        "page = PageServer.start(Session(title='test', kind='graph'), at=PageAddress(port=0))\n"
        "print(page.process_id, page.url, flush=True); time.sleep(60)"
    )
    owner = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert owner.stdout is not None
    server, url = owner.stdout.readline().split()
    with urllib.request.urlopen(url):
        owner.kill()
    owner.wait()
    owner.stdout.close()

    end = time.monotonic() + 30
    while os.path.exists(f"/proc/{server}") and time.monotonic() < end:
        time.sleep(0.01)
    assert not os.path.exists(f"/proc/{server}")


def test_clients_follow_the_session() -> None:
    with PageServer.start(SESSION, at=PageAddress(port=0)) as page, ProtocolClient(page.url) as client:
        client.subscribe("trundle/session")
        client.until(lambda: len(client.payloads("trundle/session")) == 1)
        page.set_session(Session(title="another", kind="graph", panels=("rqt_graph",)))
        client.until(lambda: len(client.payloads("trundle/session")) == 2)
        with urllib.request.urlopen(page_url(page.url, "/session.json")) as answer:
            fetched = json.load(answer)

    first, second = map(json.loads, client.payloads("trundle/session"))
    assert (first["title"], second["title"], second["panels"]) == ("test", "another", ["rqt_graph"])
    assert second == fetched


def test_a_notice_is_shown_until_it_is_removed(page: PageServer) -> None:
    page.set_notice("physics", "it is unstable")
    with ProtocolClient(page.url) as client:
        client.until(lambda: client.statuses)
        page.set_notice("physics", None)
        removed = client.last("removeStatus")

    assert (client.statuses[0]["message"], client.statuses[0]["id"]) == ("it is unstable", "physics")
    assert removed["statusIds"] == ["physics"]


def test_a_page_without_a_graph_has_no_graph_capabilities(page: PageServer) -> None:
    with ProtocolClient(page.url) as client:
        client.until(lambda: client.jsons)

    assert client.jsons[0]["capabilities"] == ["assets", "time"]
