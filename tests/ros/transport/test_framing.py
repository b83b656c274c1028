"""Byte streams decoded into frames, however they are split."""

import random
import struct

import pytest

from trundle.ros import _message_codec
from trundle.ros.errors import WireError
from trundle.ros.transport.framing import FrameDecoder


def _put(cutter: FrameDecoder, data: bytes, most: int) -> list[bytes]:
    """Feed the decoder at most so many bytes of a stream at a time, as a socket does."""
    frames: list[bytes] = []
    while data:
        room = cutter.get_buffer()
        count = min(len(room), len(data), most)
        room[:count] = data[:count]
        data = data[count:]
        frames += [bytes(frame) for frame in cutter.decode(count)]
    return frames


def _receive(cutter: FrameDecoder, data: bytes, most: int) -> list[bytes]:
    """As `_put`, as a socket is read that only frames are expected from."""
    frames: list[bytes] = []
    while data:

        def recv_into(room: memoryview) -> int:
            nonlocal data
            count = min(len(room), len(data), most)
            room[:count] = data[:count]
            data = data[count:]
            return count

        contents, _, others = cutter.receive(recv_into, _message_codec.receive)
        frames += [*contents, *map(bytes, others)]
    return frames


def _stream(sent: list[bytes]) -> bytes:
    return b"".join(struct.pack("<I", len(frame)) + frame for frame in sent)


@pytest.mark.parametrize("most", [1, 3, 7_000, 300_000, 10**9])
def test_frames_come_out_as_they_went_in(most: int) -> None:
    seed = random.Random(7)
    sizes = [0, 1, 4_092, 4_096, 4_097, 16_380, 16_384, 16_385, 230_000, 230_000, 5, 230_000, 400_000, 9_000, 0]
    sent = [seed.randbytes(size) for size in sizes if most > 3 or size < 20_000]
    assert _put(FrameDecoder(10**6), _stream(sent), most) == sent
    assert _receive(FrameDecoder(10**6), _stream(sent), most) == sent


def test_frames_of_two_streams_do_not_mix() -> None:
    """They share a buffer between whole frames."""
    streams = [_stream([bytes([letter]) * 1_000] * 3) for letter in b"ab"]
    cutters = [FrameDecoder(10**6) for _ in streams]
    got: list[list[bytes]] = [[], []]
    for at in range(0, len(streams[0]), 700):
        for cutter, stream, frames in zip(cutters, streams, got, strict=True):
            frames += _put(cutter, stream[at : at + 700], 700)
    assert got == [[b"a" * 1_000] * 3, [b"b" * 1_000] * 3]


def test_a_long_frame_like_the_one_before_is_not_copied() -> None:
    cutter = FrameDecoder(10**6)
    data = _stream([b"x" * 50_000])
    assert _put(cutter, data, 10**9) == [b"x" * 50_000]
    room = cutter.get_buffer()
    room[:] = data
    (frame,) = cutter.decode(len(data))
    assert isinstance(frame, memoryview)
    assert frame.readonly
    room[-1] = ord("y")
    assert frame[-1] == ord("y")


def test_memory_grows_with_what_has_come_not_with_what_is_announced() -> None:
    cutter = FrameDecoder(10**9)
    assert _put(cutter, struct.pack("<I", 10**9) + b"x" * 1_000, 10**9) == []
    assert len(cutter.get_buffer()) < 10**6
    assert _put(cutter, b"x" * 3_000_000, 10**9) == []
    assert len(cutter.get_buffer()) < 10**7


def test_a_frame_over_the_limit_is_refused_when_announced() -> None:
    cutter = FrameDecoder(100)
    with pytest.raises(WireError, match="a frame of 101 bytes is announced"):
        _put(cutter, struct.pack("<I", 101), 10**9)
