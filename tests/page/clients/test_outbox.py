"""The send queue of a client: queued, dropped and undroppable messages."""

import asyncio
import socket
from collections.abc import Awaitable, Callable, Hashable, Iterator
from contextlib import contextmanager

import pytest

from trundle.page.clients.outbox import BINARY, MAX_BYTES, MAX_STREAM_BYTES, Outbox, frame_header

MB = 1024 * 1024


class Peer:
    """Other end of an outbox's socket."""

    def __init__(self) -> None:
        server, self.socket = socket.socketpair()
        server.setblocking(False)
        self.socket.setblocking(False)
        self.dropped: list[Hashable] = []
        self.broken: list[str] = []
        self.outbox = Outbox(server, broken=self.broken.append, dropped=self.dropped.append)

    async def read(self, count: int) -> list[bytes]:
        """Read frames; return their payloads."""
        data = bytearray()
        payloads: list[bytes] = []
        while len(payloads) < count:
            while (frame := _frame(data)) is None:
                data += await asyncio.get_running_loop().sock_recv(self.socket, 1 << 20)
            payloads.append(frame)
        assert not data
        return payloads


def _frame(data: bytearray) -> bytes | None:
    """Remove a frame from received bytes and return its payload: RFC 6455, 5.2."""
    if len(data) < 2:
        return None
    extra = {126: 2, 127: 8}.get(data[1], 0)
    if len(data) < 2 + extra:
        return None
    size = int.from_bytes(data[2 : 2 + extra], "big") if extra else data[1]
    if len(data) < 2 + extra + size:
        return None
    payload = bytes(data[2 + extra : 2 + extra + size])
    del data[: 2 + extra + size]
    return payload


@contextmanager
def _peer() -> Iterator[Peer]:
    peer = Peer()
    try:
        yield peer
    finally:
        peer.outbox.close()
        peer.socket.close()


def _run(work: Callable[[Peer], Awaitable[None]]) -> None:
    async def body() -> None:
        with _peer() as peer:
            await work(peer)

    asyncio.run(body())


@pytest.mark.parametrize("size", [0, 1, 125, 126, 65535, 65536, 3 * MB])
def test_a_message_arrives_whole(size: int) -> None:
    async def work(peer: Peer) -> None:
        payload = bytes(range(256)) * (size // 256) + bytes(range(size % 256))
        peer.outbox.send(BINARY, (payload[: size // 3], memoryview(payload)[size // 3 :]))
        assert await peer.read(1) == [payload]

    _run(work)


def test_a_frames_length_has_the_shortest_form() -> None:
    assert [len(frame_header(BINARY, size)) for size in (0, 125, 126, 65535, 65536, 2**32)] == [2, 2, 4, 4, 10, 10]


def test_a_slow_client_loses_only_the_oldest_messages_of_streams() -> None:
    async def work(peer: Peer) -> None:
        peer.outbox.send(BINARY, (bytes(8 * MB),))  # fills the kernel's buffer
        for number in range(20):
            peer.outbox.send(BINARY, (bytes([number]) * MB,), "cloud")
            peer.outbox.send(BINARY, (b"keep" + bytes([number]),))
            peer.outbox.send(BINARY, (b"tf" + bytes([number]),), "tf")
        assert set(peer.dropped) == {"cloud"}
        remaining = 20 - len(peer.dropped)
        payloads = (await peer.read(1 + remaining + 40))[1:]

        clouds = [payload[0] for payload in payloads if len(payload) == MB]
        assert clouds == list(range(20 - remaining, 20))
        assert 1 <= remaining <= MAX_STREAM_BYTES // MB
        assert [payload[4] for payload in payloads if payload.startswith(b"keep")] == list(range(20))
        assert [payload[2] for payload in payloads if payload.startswith(b"tf")] == list(range(20))

    _run(work)


def test_the_newest_message_of_a_stream_is_sent_however_long() -> None:
    async def work(peer: Peer) -> None:
        peer.outbox.send(BINARY, (bytes(8 * MB),))
        for number in range(3):
            peer.outbox.send(BINARY, (bytes([number]) * (2 * MAX_STREAM_BYTES),), "cloud")
        payloads = await peer.read(2)
        assert payloads[1][0] == 2
        assert peer.dropped == ["cloud"] * 2

    _run(work)


def test_a_client_that_reads_nothing_is_disconnected() -> None:
    async def work(peer: Peer) -> None:
        message = bytes(16 * MB)
        for _ in range(MAX_BYTES // len(message) + 3):
            peer.outbox.send(BINARY, (message,))
        await asyncio.sleep(0)
        assert len(peer.broken) == 1
        assert "unread" in peer.broken[0]
        assert peer.outbox.waiting_bytes <= MAX_BYTES + 2 * len(message)
        peer.outbox.send(BINARY, (b"late",))

    _run(work)


def test_a_disconnected_client_is_reported_once() -> None:
    async def work(peer: Peer) -> None:
        peer.socket.close()
        for _ in range(3):
            peer.outbox.send(BINARY, (bytes(MB),))
            await asyncio.sleep(0)
        assert len(peer.broken) == 1

    _run(work)


def test_drain_waits_until_everything_is_sent() -> None:
    async def work(peer: Peer) -> None:
        peer.outbox.send(BINARY, (bytes(8 * MB),))
        draining = asyncio.create_task(peer.outbox.drain(60.0))
        await asyncio.sleep(0)
        assert not draining.done()
        await peer.read(1)
        await draining
        await peer.outbox.drain(0.0)

    _run(work)
