"""The server's process: its start, its port, its end."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from urllib.parse import urlsplit

import pytest
from tests.page_client import ProtocolClient, page_url

from trundle.base.diagnostics import UsageError
from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session

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


def test_a_killed_server_is_not_alive() -> None:
    with PageServer.start(SESSION, at=PageAddress(port=0)) as page:
        os.kill(page.process_id, signal.SIGKILL)
        page._process.wait()
        assert not page.alive
        page.put_lines(0, [])
        page.set_session(SESSION)
        assert page.requests() == []


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
