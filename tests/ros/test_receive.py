"""Whole frames are split off a receive buffer in one call; all else stays there."""

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
    here, there = socket.socketpair()
    with here, there:
        there.setblocking(False)
        yield here, there


@pytest.mark.parametrize(
    ("come", "contents"),
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
def test_the_contents_of_the_whole_frames(pair: tuple[socket.socket, ...], come: bytes, contents: list[bytes]) -> None:
    room = memoryview(bytearray(64))
    pair[0].sendall(come)
    parsed = sum(4 + len(content) for content in contents)
    assert receive(pair[1].recv_into, room, room, 0, _LIMIT) == (contents, parsed, len(come))
    assert room[: len(come)] == come


def test_a_frame_that_began_before_is_finished(pair: tuple[socket.socket, ...]) -> None:
    room = memoryview(bytearray(64))
    room[:3] = ONE[:3]
    pair[0].sendall(ONE[3:] + ONE[:2])
    assert receive(pair[1].recv_into, room[3:], room, 3, _LIMIT) == ([ONE[4:]], len(ONE), len(ONE) - 1)


@pytest.mark.parametrize("content", [b"\2\0\0\0x", b"\1\0\0\0\xff", b"\1\0\0\0xy", b""])
def test_what_is_no_message_is_left_for_who_names_it(pair: tuple[socket.socket, ...], content: bytes) -> None:
    read = Messages().codec("std_msgs/String").receive
    room = memoryview(bytearray(64))
    frame = len(content).to_bytes(4, "little") + content
    pair[0].sendall(ONE + frame + ONE)
    messages, parsed, count = read(pair[1].recv_into, room, room, 0, _LIMIT)
    assert [message.data for message in messages] == ["x"]
    assert (parsed, count) == (len(ONE), 2 * len(ONE) + len(frame))


def test_what_a_socket_raises_is_raised(pair: tuple[socket.socket, ...]) -> None:
    room = memoryview(bytearray(64))
    with pytest.raises(BlockingIOError):
        receive(pair[1].recv_into, room, room, 0, _LIMIT)
    pair[0].close()
    assert receive(pair[1].recv_into, room, room, 0, _LIMIT) == ([], 0, 0)


@pytest.mark.parametrize(("filled", "told"), [(0, -1), (0, 65), (60, 5), (0, 2**40), (-1, 8)])
def test_no_more_is_read_than_there_is_room(filled: int, told: int) -> None:
    room = memoryview(bytearray(64))
    assert receive(lambda _: told, room, room, filled, _LIMIT) == ([], 0, told)


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
                take(lambda _, frame=frame: put(frame), room, room, 0, _LIMIT)
        gc.collect()
        return sys.getallocatedblocks()

    blocks()
    before = blocks()
    assert blocks() - before < 50
