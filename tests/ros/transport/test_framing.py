"""Byte streams split at any position and decoded into frames."""

import random
import struct

import pytest

from trundle.ros import _message_codec
from trundle.ros.errors import WireError
from trundle.ros.transport.framing import FrameDecoder


def _decode(decoder: FrameDecoder, data: bytes, max_bytes: int) -> list[bytes]:
    """Feed the decoder `max_bytes` of a stream at a time, as a socket does."""
    frames: list[bytes] = []
    while data:
        room = decoder.get_buffer()
        count = min(len(room), len(data), max_bytes)
        room[:count] = data[:count]
        data = data[count:]
        frames += [bytes(frame) for frame in decoder.decode(count)]
    return frames


def _receive(decoder: FrameDecoder, data: bytes, max_bytes: int) -> list[bytes]:
    """Like `_decode`, by `FrameDecoder.receive`."""
    frames: list[bytes] = []
    while data:

        def recv_into(room: memoryview) -> int:
            nonlocal data
            count = min(len(room), len(data), max_bytes)
            room[:count] = data[:count]
            data = data[count:]
            return count

        contents, _, others = decoder.receive(recv_into, _message_codec.receive)
        frames += [*contents, *map(bytes, others)]
    return frames


def _stream(sent: list[bytes]) -> bytes:
    return b"".join(struct.pack("<I", len(frame)) + frame for frame in sent)


@pytest.mark.parametrize("max_bytes", [1, 3, 7_000, 300_000, 10**9])
def test_frames_survive_any_split_of_the_stream(max_bytes: int) -> None:
    seed = random.Random(7)
    sizes = [0, 1, 4_092, 4_096, 4_097, 16_380, 16_384, 16_385, 230_000, 230_000, 5, 230_000, 400_000, 9_000, 0]
    sent = [seed.randbytes(size) for size in sizes if max_bytes > 3 or size < 20_000]
    assert _decode(FrameDecoder(10**6), _stream(sent), max_bytes) == sent
    assert _receive(FrameDecoder(10**6), _stream(sent), max_bytes) == sent


def test_frames_of_two_streams_do_not_mix() -> None:
    """They share a buffer for short frames."""
    streams = [_stream([bytes([letter]) * 1_000] * 3) for letter in b"ab"]
    decoders = [FrameDecoder(10**6) for _ in streams]
    got: list[list[bytes]] = [[], []]
    for at in range(0, len(streams[0]), 700):
        for decoder, stream, frames in zip(decoders, streams, got, strict=True):
            frames += _decode(decoder, stream[at : at + 700], 700)
    assert got == [[b"a" * 1_000] * 3, [b"b" * 1_000] * 3]


def test_a_long_frame_after_another_of_its_length_is_not_copied() -> None:
    decoder = FrameDecoder(10**6)
    data = _stream([b"x" * 50_000])
    assert _decode(decoder, data, 10**9) == [b"x" * 50_000]
    room = decoder.get_buffer()
    room[:] = data
    (frame,) = decoder.decode(len(data))
    assert isinstance(frame, memoryview)
    assert frame.readonly
    room[-1] = ord("y")
    assert frame[-1] == ord("y")


def test_memory_grows_with_the_bytes_received_not_with_the_length_announced() -> None:
    decoder = FrameDecoder(10**9)
    assert _decode(decoder, struct.pack("<I", 10**9) + b"x" * 1_000, 10**9) == []
    assert len(decoder.get_buffer()) < 10**6
    assert _decode(decoder, b"x" * 3_000_000, 10**9) == []
    assert len(decoder.get_buffer()) < 10**7


def test_a_frame_over_the_limit_is_refused_when_announced() -> None:
    decoder = FrameDecoder(100)
    with pytest.raises(WireError, match="a frame of 101 bytes is announced"):
        _decode(decoder, struct.pack("<I", 101), 10**9)
