"""Bytes to one peer, however many the kernel takes at a time."""

import asyncio
import socket
from collections.abc import Callable

import pytest

from trundle.ros.transport.send_queue import SendQueue

_FRAMES = [(bytes([i % 200]) * 10, bytes([i % 100 + 100]) * 30_000) for i in range(1000)]
"""More than the kernel takes without a reader, and each short enough for a socket."""


def _tcp_pair() -> tuple[socket.socket, socket.socket]:
    with socket.create_server(("127.0.0.1", 0)) as server:
        near = socket.create_connection(server.getsockname())
        return near, server.accept()[0]


@pytest.mark.parametrize("pair", [socket.socketpair, _tcp_pair], ids=["nearby", "TCP"])
@pytest.mark.parametrize("at_a_time", [1, 7])
def test_frames_the_kernel_takes_in_parts_arrive_whole_and_in_order(
    pair: "Callable[[], tuple[socket.socket, socket.socket]]", at_a_time: int
) -> None:
    async def exchange(ours: socket.socket, theirs: socket.socket) -> bytes:
        ours.setblocking(False)
        theirs.setblocking(False)
        drained = asyncio.Event()
        out = SendQueue(ours, drained=drained.set, broken=lambda: None)
        for first in range(0, len(_FRAMES), at_a_time):
            out.send(_FRAMES[first : first + at_a_time], None)
        assert out.is_congested
        got = bytearray()
        while len(got) < sum(map(len, sent)):
            got += await asyncio.get_running_loop().sock_recv(theirs, 65536)
        await drained.wait()
        assert (out.frames_sent, out.bytes_sent, out.dropped) == (len(_FRAMES), len(got), 0)
        out.close()
        return bytes(got)

    sent = [piece for frame in _FRAMES for piece in frame]
    ours, theirs = pair()
    with ours, theirs:
        assert asyncio.run(exchange(ours, theirs)) == b"".join(sent)


def test_a_peer_that_has_gone_is_told_once() -> None:
    async def send() -> int:
        ours, theirs = socket.socketpair()
        with ours:
            ours.setblocking(False)
            gone = asyncio.Event()
            told = 0

            def broken() -> None:
                nonlocal told
                told += 1
                gone.set()

            out = SendQueue(ours, drained=lambda: None, broken=broken)
            out.send([(b"warm",)], None)
            theirs.close()
            out.send([(b"lost",)], None)
            await gone.wait()
            assert not out.is_congested
            out.close()
        return told

    assert asyncio.run(send()) == 1
