"""Frames to one peer, written in as many parts as the kernel requires."""

import asyncio
import contextlib
import socket
import sys
from collections.abc import Callable

import pytest

from trundle.ros.transport.framing import FrameDecoder
from trundle.ros.transport.send_queue import SendQueue
from trundle.ros.transport.shared_ring import SharedRingReader

_FRAMES = [(bytes([i % 200]) * 10, bytes([i % 100 + 100]) * 30_000) for i in range(1000)]
"""More than the kernel buffers without a reader, and each short enough for a socket."""


def _tcp_pair() -> tuple[socket.socket, socket.socket]:
    with socket.create_server(("127.0.0.1", 0)) as server:
        near = socket.create_connection(server.getsockname())
        return near, server.accept()[0]


@pytest.mark.parametrize("pair", [socket.socketpair, _tcp_pair], ids=["nearby", "TCP"])
@pytest.mark.parametrize("batch_size", [1, 7])
def test_partly_written_frames_arrive_complete_and_in_order(
    pair: "Callable[[], tuple[socket.socket, socket.socket]]", batch_size: int
) -> None:
    async def exchange(sender: socket.socket, receiver: socket.socket) -> bytes:
        sender.setblocking(False)
        receiver.setblocking(False)
        drained = asyncio.Event()
        out = SendQueue(sender, drained=drained.set, broken=lambda: None)
        for first in range(0, len(_FRAMES), batch_size):
            out.send(_FRAMES[first : first + batch_size], None)
        assert out.is_congested
        got = bytearray()
        while len(got) < sum(map(len, sent)):
            got += await asyncio.get_running_loop().sock_recv(receiver, 65536)
        await drained.wait()
        assert (out.frames_sent, out.bytes_sent, out.dropped) == (len(_FRAMES), len(got), 0)
        out.close()
        return bytes(got)

    sent = [piece for frame in _FRAMES for piece in frame]
    sender, receiver = pair()
    with sender, receiver:
        assert asyncio.run(exchange(sender, receiver)) == b"".join(sent)


def test_a_broken_connection_is_reported_once() -> None:
    async def send() -> int:
        sender, receiver = socket.socketpair()
        with sender:
            sender.setblocking(False)
            is_broken = asyncio.Event()
            calls = 0

            def broken() -> None:
                nonlocal calls
                calls += 1
                is_broken.set()

            out = SendQueue(sender, drained=lambda: None, broken=broken)
            out.send([(b"warm",)], None)
            receiver.close()
            out.send([(b"lost",)], None)
            await is_broken.wait()
            assert not out.is_congested
            out.close()
        return calls

    assert asyncio.run(send()) == 1


@pytest.mark.skipif(sys.platform != "linux", reason="sealed memory files exist on Linux only")
def test_a_long_frame_waits_for_a_full_socket_although_the_shared_memory_has_room() -> None:
    short, long = (b"\1\0\0\0x",), (b"\0\0\1\0", bytes(range(256)) * 256)

    async def exchange(sender: socket.socket, receiver: socket.socket) -> list[bytes]:
        sender.setblocking(False)
        receiver.setblocking(False)
        out = SendQueue(sender, drained=lambda: None, broken=lambda: None)
        rings: list[SharedRingReader] = []

        def read_note(note: bytes) -> bytes | None:
            if rings:
                content, answer = rings[0].read(note)
                assert answer is None
                return content
            rings.append(SharedRingReader(receiver, note))
            out.receive_note(rings[0].mapped_note()[4:])
            return None

        decoder = FrameDecoder(10**6)
        decoder.on_note = read_note
        frames: list[bytes] = []

        async def receive(count: int) -> None:
            while len(frames) < count:
                room = decoder.get_buffer()
                size = await asyncio.get_running_loop().sock_recv_into(receiver, room)
                frames.extend(map(bytes, decoder.decode(size)))

        out.send([long], None)
        await receive(1)
        out.send([long], None)
        assert not out.is_congested
        await receive(2)
        filled = 0
        with contextlib.suppress(BlockingIOError):
            while True:
                sender.send(short[0])
                filled += 1
        out.send([long], None)
        assert out.is_congested
        out.send([short], None)
        await receive(filled + 4)
        assert (out.frames_sent, out.is_congested) == (4, False)
        out.close()
        rings[0].close()
        return frames

    near, far = socket.socketpair()
    with near, far:
        frames = asyncio.run(exchange(near, far))
    assert frames == [long[1], long[1], *[b"x"] * (len(frames) - 4), long[1], b"x"]
