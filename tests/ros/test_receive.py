"""Complete frames are split off a receive buffer in one call; the rest stays in the buffer."""

import gc
import socket
import sys
from collections.abc import Generator

import pytest

from trundle.ros import Messages
from trundle.ros._message_codec import receive

ONE = b"\5\0\0\0\1\0\0\0x"
"""A std_msgs/String as a frame."""


_LIMIT = 32


@pytest.fixture
def pair() -> Generator[tuple[socket.socket, socket.socket]]:
    sender, receiver = socket.socketpair()
    with sender, receiver:
        receiver.setblocking(False)
        yield sender, receiver


@pytest.mark.parametrize(
    ("received", "contents"),
    [
        (ONE, [ONE[4:]]),
        (b"\0\0\0\0", [b""]),
        (ONE[:3], []),
        (ONE[:-1], []),
        (ONE + b"\0\0\0\0" + ONE, [ONE[4:], b"", ONE[4:]]),
        (ONE + b"\0", [ONE[4:]]),
        (b"\xff\xff\xff\xff", []),
        (ONE + b"\x21\0\0\0" + b"x" * 33 + ONE, [ONE[4:]]),
    ],
)
def test_contents_of_complete_frames_are_returned(
    pair: tuple[socket.socket, ...], received: bytes, contents: list[bytes]
) -> None:
    room = memoryview(bytearray(64))
    pair[0].sendall(received)
    parsed = sum(4 + len(content) for content in contents)
    assert receive(pair[1].recv_into, room, room, 0, _LIMIT) == (contents, parsed, len(received))
    assert room[: len(received)] == received


def test_a_partly_received_frame_is_completed(pair: tuple[socket.socket, ...]) -> None:
    room = memoryview(bytearray(64))
    room[:3] = ONE[:3]
    pair[0].sendall(ONE[3:] + ONE[:2])
    assert receive(pair[1].recv_into, room[3:], room, 3, _LIMIT) == ([ONE[4:]], len(ONE), len(ONE) - 1)


@pytest.mark.parametrize("content", [b"\2\0\0\0x", b"\1\0\0\0\xff", b"\1\0\0\0xy", b""])
def test_an_invalid_message_is_left_in_the_buffer(pair: tuple[socket.socket, ...], content: bytes) -> None:
    read = Messages().codec("std_msgs/String").receive
    room = memoryview(bytearray(64))
    frame = len(content).to_bytes(4, "little") + content
    pair[0].sendall(ONE + frame + ONE)
    messages, parsed, count = read(pair[1].recv_into, room, room, 0, _LIMIT)
    assert [message.data for message in messages] == ["x"]
    assert (parsed, count) == (len(ONE), 2 * len(ONE) + len(frame))


def test_socket_errors_are_raised(pair: tuple[socket.socket, ...]) -> None:
    room = memoryview(bytearray(64))
    with pytest.raises(BlockingIOError):
        receive(pair[1].recv_into, room, room, 0, _LIMIT)
    pair[0].close()
    assert receive(pair[1].recv_into, room, room, 0, _LIMIT) == ([], 0, 0)


@pytest.mark.parametrize(("filled", "count"), [(0, -1), (0, 65), (60, 5), (0, 2**40), (-1, 8)])
def test_an_invalid_count_of_received_bytes_returns_no_frame(filled: int, count: int) -> None:
    room = memoryview(bytearray(64))
    assert receive(lambda _: count, room, room, filled, _LIMIT) == ([], 0, count)


def test_receiving_leaks_no_memory() -> None:
    read = Messages().codec("std_msgs/String").receive
    room = memoryview(bytearray(64))
    frames = [ONE, ONE[:5], b"\5\0\0\0\2\0\0\0x"]

    def write(frame: bytes) -> int:
        room[: len(frame)] = frame
        return len(frame)

    def blocks() -> int:
        for frame in frames * 100:
            for read_frames in (read, receive):
                read_frames(lambda _, frame=frame: write(frame), room, room, 0, _LIMIT)
        gc.collect()
        return sys.getallocatedblocks()

    blocks()
    before = blocks()
    assert blocks() - before < 50
