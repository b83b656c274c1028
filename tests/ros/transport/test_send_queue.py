"""Frames to one peer, written in as many parts as the kernel requires."""

import asyncio
import socket
from collections.abc import Callable

import pytest

from trundle.ros.transport.send_queue import SendQueue

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
