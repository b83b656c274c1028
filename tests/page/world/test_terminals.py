"""Terminals of nodes over the protocol: the end of the output, then new output; input from clients."""

import struct
from collections.abc import Iterator

import pytest
from tests.graphs import until
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.base.supervisor import Terminal
from trundle.page import TERMINAL, PageServer, Session
from trundle.page.shared_page import SharedPage
from trundle.page.terminals import PageTerminals

TOPIC = f"{TERMINAL}0"


@pytest.fixture
def server() -> Iterator[PageServer]:
    with PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0)) as server:
        yield server


@pytest.fixture
def terminals(server: PageServer) -> PageTerminals:
    return PageTerminals(SharedPage(say=lambda _: None, server=server))


@pytest.fixture
def terminal(terminals: PageTerminals, server: PageServer) -> Terminal:
    terminal = terminals.add("/node")
    terminals.update(server)
    return terminal


def _read(client: ProtocolClient, terminals: PageTerminals, server: PageServer, end: int) -> list[tuple[int, bytes]]:
    """Wait for the output up to byte `end`; return its pieces, each with the number of its first byte."""

    def has_all() -> bool:
        terminals.update(server)
        payloads = client.payloads(TOPIC)
        return bool(payloads) and _first(payloads[-1]) + len(payloads[-1]) - 12 == end

    client.until(has_all)
    return [(_first(payload), payload[12:]) for payload in client.payloads(TOPIC)]


def _first(payload: bytes) -> int:
    return int(struct.unpack_from("<QHH", payload)[0])


def test_a_client_gets_the_end_of_the_output_and_then_new_output(
    terminals: PageTerminals, terminal: Terminal, server: PageServer
) -> None:
    terminal.write("a" * 300_000)
    length = len(terminal.scrollback)
    with ProtocolClient(server.view_url) as client:
        client.subscribe(TOPIC)
        assert _read(client, terminals, server, 300_000)[-1] == (300_000 - length, b"a" * length)
        terminal.write("news")
        assert _read(client, terminals, server, 300_004)[-1] == (300_000, b"news")
        with ProtocolClient(server.url) as later:
            later.subscribe(TOPIC)
            assert _read(later, terminals, server, 300_004)[-1][1].endswith(b"aanews")


def test_input_and_sizes_reach_their_terminal(terminals: PageTerminals, terminal: Terminal, server: PageServer) -> None:
    keys: list[str] = []
    terminal.listen(keys.append)
    with ProtocolClient(server.url) as client:
        client.send("trundle/terminal", number=7, text="nobody's")
        client.send("trundle/terminal", number=0, text="i", size=[100, 30])
        client.send("trundle/terminal", number=0, text="x" * 4097)
        client.send("trundle/terminal", number=0, size=[1, 10**6])
        client.send("trundle/terminal", number=0, text="k")
        client.until(lambda: len(client.statuses) == 2)

    until(lambda: terminals.update(server) or "k" in keys)

    assert keys == ["i", "k"]
    assert (terminal.columns, terminal.rows) == (100, 30)


def test_the_session_lists_the_terminals_and_their_ends(
    terminals: PageTerminals, terminal: Terminal, server: PageServer
) -> None:
    with ProtocolClient(server.url) as client:
        client.subscribe("trundle/session")
        terminal.end("/node has died")
        terminals.update(server)
        client.until(lambda: client.payloads("trundle/session"))
        client.until(
            lambda: b'"terminals":[{"name":"/node","ended":"/node has died"}]' in client.payloads("trundle/session")[-1]
        )
