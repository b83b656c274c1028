"""The send queue of a client: queued, dropped and undroppable messages."""

import asyncio
import socket
from collections.abc import Awaitable, Callable, Hashable, Iterator
from contextlib import contextmanager

import pytest

from trundle.page.clients.frames import BINARY, PING, TEXT, frame_header
from trundle.page.clients.outbox import MAX_BYTES, MAX_STREAM_BYTES, Outbox, pong_number
from trundle.page.clients.send_flow import NEWEST

MB = 1024 * 1024
PART = 0x80


class Peer:
    """Other end of an outbox's socket."""

    def __init__(self) -> None:
        server, self.socket = socket.socketpair()
        server.setblocking(False)
        self.socket.setblocking(False)
        self._data = bytearray()
        self.dropped: list[Hashable] = []
        self.broken: list[str] = []
        self.outbox = Outbox(server, broken=self.broken.append, dropped=self.dropped.append)

    async def read(self, count: int) -> list[bytes]:
        """Read messages and echo marks; return the messages' payloads."""
        return await self.read_until(lambda payloads: len(payloads) == count)

    async def read_until(self, is_done: Callable[[list[bytes]], object]) -> list[bytes]:
        """Read messages and echo marks until a condition is true; return the messages' payloads."""
        payloads: list[bytes] = []
        while not is_done(payloads):
            while (frame := _frame(self._data)) is None:
                self._data += await asyncio.get_running_loop().sock_recv(self.socket, 1 << 20)
            first_byte, payload = frame
            if first_byte == PING:
                self.outbox.echo(pong_number(payload))
            else:
                payloads.append(payload)
        return payloads


def _frame(data: bytearray) -> tuple[int, bytes] | None:
    """Remove a frame from received bytes; return its first byte and payload: RFC 6455, 5.2."""
    if len(data) < 2:
        return None
    extra = {126: 2, 127: 8}.get(data[1], 0)
    if len(data) < 2 + extra:
        return None
    size = int.from_bytes(data[2 : 2 + extra], "big") if extra else data[1]
    if len(data) < 2 + extra + size:
        return None
    first_byte, payload = data[0], bytes(data[2 + extra : 2 + extra + size])
    del data[: 2 + extra + size]
    return first_byte, payload


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
            peer.outbox.send(BINARY, (bytes([number]) * MB,), "cloud", NEWEST)
            peer.outbox.send(BINARY, (b"keep" + bytes([number]),))
            peer.outbox.send(BINARY, (b"tf" + bytes([number]),), "tf", NEWEST)
        assert set(peer.dropped) == {"cloud"}
        assert peer.outbox.waiting_bytes < 8 * MB + MAX_STREAM_BYTES + MB
        last = {bytes([19]) * MB, b"keep\x13", b"tf\x13"}
        payloads = await peer.read_until(lambda payloads: last <= set(payloads))

        clouds = [payload[0] for payload in payloads if len(payload) == MB]
        assert clouds == sorted(clouds)
        assert 1 <= len(clouds) <= MAX_STREAM_BYTES // MB
        assert [payload[4] for payload in payloads if payload.startswith(b"keep")] == list(range(20))

    _run(work)


def test_streams_share_a_slow_connection_by_their_bytes() -> None:
    """Images are thinned so that transforms are not."""

    async def work(peer: Peer) -> None:
        peer.outbox.splits = True
        peer.outbox.send(BINARY, (b"first",))
        await peer.read(1)  # tells the pace
        for number in range(50):
            peer.outbox.send(BINARY, (bytes([number]) * 200_000,), "image", NEWEST)
            peer.outbox.send(BINARY, (b"tf" + bytes([number]),), "tf", NEWEST)
            await asyncio.sleep(0)
        payloads = await peer.read_until(lambda payloads: b"tf\x31" in payloads)

        assert sum(len(payload) for payload in payloads if payload[0] == PART) < 10 * 200_000

    _run(work)


def test_parts_of_a_long_message_alternate_with_other_messages() -> None:
    async def work(peer: Peer) -> None:
        peer.outbox.splits = True
        peer.outbox.send(BINARY, (b"first",))
        await peer.read(1)
        content = bytes(range(256)) * 400
        peer.outbox.send(BINARY, (content[:1000], content[1000:]), "map")
        await asyncio.sleep(0)
        peer.outbox.send(TEXT, (b"answer",))
        payloads = await peer.read_until(lambda payloads: payloads and payloads[-1][0] == PART and payloads[-1][5])

        assert b"answer" in payloads[1:-1]
        assert b"".join(payload[7:] for payload in payloads if payload[0] == PART) == content

    _run(work)


def test_the_newest_message_of_a_stream_is_sent_however_long() -> None:
    async def work(peer: Peer) -> None:
        peer.outbox.send(BINARY, (bytes(8 * MB),))
        for number in range(3):
            peer.outbox.send(BINARY, (bytes([number]) * (2 * MAX_STREAM_BYTES),), "cloud", NEWEST)
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
