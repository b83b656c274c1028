"""A single whole frame is taken from the receive buffer; all else stays there."""

import gc
import socket
import sys
from collections.abc import Generator

import pytest

from trundle.ros import Messages
from trundle.ros._message_codec import receive

ONE = b"\5\0\0\0\1\0\0\0x"
"""A std_msgs/String as a frame."""


@pytest.fixture
def pair() -> Generator[tuple[socket.socket, socket.socket]]:
    here, there = socket.socketpair()
    with here, there:
        there.setblocking(False)
        yield here, there


@pytest.mark.parametrize(
    ("come", "content"),
    [
        (ONE, ONE[4:]),
        (b"\0\0\0\0", b""),
        (ONE[:3], None),
        (ONE[:-1], None),
        (ONE + ONE, None),
        (ONE + b"\0", None),
        (b"\xff\xff\xff\xff", None),
    ],
)
def test_the_content_of_a_frame_alone(pair: tuple[socket.socket, ...], come: bytes, content: bytes | None) -> None:
    room = memoryview(bytearray(64))
    pair[0].sendall(come)
    assert receive(pair[1].recv_into, room) == (content, len(come))
    assert room[: len(come)] == come


@pytest.mark.parametrize("content", [b"\2\0\0\0x", b"\1\0\0\0\xff", b"\1\0\0\0xy", b""])
def test_what_is_no_message_is_left_for_who_names_it(pair: tuple[socket.socket, ...], content: bytes) -> None:
    read = Messages().codec("std_msgs/String").receive
    room = memoryview(bytearray(64))
    frame = len(content).to_bytes(4, "little") + content
    pair[0].sendall(frame + ONE)
    assert read(pair[1].recv_into, room[: len(frame)]) == (None, len(frame))
    assert room[: len(frame)] == frame
    message, count = read(pair[1].recv_into, room)
    assert (message.data, count) == ("x", len(ONE))


def test_what_a_socket_raises_is_raised(pair: tuple[socket.socket, ...]) -> None:
    room = memoryview(bytearray(64))
    with pytest.raises(BlockingIOError):
        receive(pair[1].recv_into, room)
    pair[0].close()
    assert receive(pair[1].recv_into, room) == (None, 0)


@pytest.mark.parametrize("told", [-1, 65, 2**40])
def test_no_more_is_read_than_there_is_room(told: int) -> None:
    assert receive(lambda _: told, memoryview(bytearray(64))) == (None, told)


def test_nothing_is_left_behind() -> None:
    read = Messages().codec("std_msgs/String").receive
    room = memoryview(bytearray(64))
    frames = [ONE, ONE[:5], b"\5\0\0\0\2\0\0\0x"]

    def put(frame: bytes) -> int:
        room[: len(frame)] = frame
        return len(frame)

    def blocks() -> int:
        for frame in frames * 100:
            for take in (read, receive):
                take(lambda _, frame=frame: put(frame), room)
        gc.collect()
        return sys.getallocatedblocks()

    blocks()
    before = blocks()
    assert blocks() - before < 50
