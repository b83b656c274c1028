"""Bytes that are neither HTTP nor frames: the server closes the connection and prints nothing."""

import contextlib
import os
import random
import socket
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from tests.graphs import until
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, Session

CONNECTIONS = 300
REQUEST = (
    b"GET /?%b HTTP/1.1\r\nHost: %b\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n"
    b"Sec-WebSocket-Protocol: trundle.v1\r\n\r\n"
)


def _broken(source: random.Random, query: bytes, host: bytes) -> bytes:
    request = REQUEST % (query, host)
    match source.randrange(5):
        case 0:
            return source.randbytes(source.randrange(1, 2000))
        case 1:
            return request[: source.randrange(len(request))]
        case 2:
            at = source.randrange(len(request))
            return request[:at] + source.randbytes(3) + request[at + 1 :]
        case 3:
            return request + source.randbytes(source.randrange(1, 300))
        case _:
            frame = bytes((source.choice((0x81, 0x82, 0x01, 0x00, 0x88, 0x89, 0xC1)), 0x80 | source.randrange(128)))
            return request + (frame + source.randbytes(20)) * source.randrange(1, 5)


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="needs /proc")
def test_invalid_bytes_end_only_their_own_connection(capfd: pytest.CaptureFixture[str]) -> None:
    with PageServer.start(Session(title="t", kind="log"), at=PageAddress(port=0)) as page:
        _break_connections(page)
    assert capfd.readouterr().err == ""


def _break_connections(page: PageServer) -> None:
    source = random.Random(0)
    address = urlsplit(page.url)
    descriptors = Path(f"/proc/{page.process_id}/fd")
    with ProtocolClient(page.url) as other:
        other.until(lambda: other.channels)
        before = len(os.listdir(descriptors))
        for _ in range(CONNECTIONS):
            with socket.create_connection((address.hostname, address.port)) as sock:
                sock.sendall(_broken(source, address.query.encode(), address.netloc.encode()))
                if source.random() < 0.5:
                    sock.settimeout(0.02)
                    with contextlib.suppress(TimeoutError, ConnectionError):
                        sock.recv(1000)
        until(lambda: len(os.listdir(descriptors)) <= before)
        other.send("trundle/request", id=1, request="definition", type="std_msgs/String")
        assert other.last("trundle/response")["ok"]
