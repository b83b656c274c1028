"""Long frames in memory that publisher and subscriber share."""

import fcntl
import mmap
import os
import random
import socket
import struct
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trundle.ros.errors import WireError
from trundle.ros.transport.framing import LENGTH
from trundle.ros.transport.shared_ring import LONG_BYTES, SharedRing, SharedRingReader

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="sealed memory files exist on Linux only")


@pytest.fixture
def connected() -> Iterator[socket.socket]:
    """A socket whose peer is this process."""
    sock, peer = socket.socketpair()
    with sock, peer:
        yield sock


@pytest.fixture
def new_ring() -> Iterator[Callable[[int], SharedRing]]:
    with ExitStack() as rings:
        yield lambda frame_bytes: rings.enter_context(closing(SharedRing(frame_bytes)))


def _content(note: bytes) -> bytes:
    return note[LENGTH.size :]


def _framed(content: bytes) -> tuple[bytes, bytes]:
    return LENGTH.pack(len(content)), content


def test_frames_are_read_back_over_many_rounds(connected: socket.socket, new_ring: Callable[[int], SharedRing]) -> None:
    seed = random.Random(5)
    ring = new_ring(200_000)
    reader = SharedRingReader(connected, _content(ring.offer_note()))
    assert not ring.has_room(200_000)
    ring.receive_note(_content(reader.mapped_note()))
    pending: list[tuple[bytes, bytes]] = []
    rounds = refused = 0
    while rounds < 300:
        content = seed.randbytes(seed.choice([LONG_BYTES, 50_000, 200_000, 400_000]))
        assert ring.has_room(len(content))
        note = ring.write(_framed(content), LENGTH.size + len(content))
        if note is not None:
            pending.append((note, content))
            rounds += 1
            continue
        refused += 1
        assert pending, "the ring is empty but has no room"
        note, content = pending.pop(0)
        content_read, answer = reader.read(_content(note))
        assert content_read == content
        if answer is not None:
            ring.receive_note(_content(answer))
    assert refused > 100
    assert [reader.read(_content(note))[0] for note, _ in pending] == [content for _, content in pending]
    reader.close()


def test_a_subscriber_acknowledges_each_half_of_the_ring(
    connected: socket.socket, new_ring: Callable[[int], SharedRing]
) -> None:
    """Each acknowledgement wakes the publisher."""
    ring = new_ring(128 * 1024)
    reader = SharedRingReader(connected, _content(ring.offer_note()))
    ring.receive_note(_content(reader.mapped_note()))
    acknowledged: list[bool] = []
    for _ in range(16):
        note = ring.write(_framed(bytes(128 * 1024 - LENGTH.size)), 128 * 1024)
        assert note is not None
        acknowledged.append(reader.read(_content(note))[1] is not None)
    assert acknowledged == ([False] * 7 + [True]) * 2
    reader.close()


def test_point_clouds_of_depth_cameras_fit_the_ring(
    connected: socket.socket, new_ring: Callable[[int], SharedRing]
) -> None:
    """928 x 800 points of 16 bytes, and the other fields."""
    content = bytes(928 * 800 * 16 + 300)
    size = LENGTH.size + len(content)
    ring = new_ring(size)
    reader = SharedRingReader(connected, _content(ring.offer_note()))
    ring.receive_note(_content(reader.mapped_note()))

    assert ring.has_room(size)
    for _ in range(6):
        note = ring.write(_framed(content), size)
        assert note is not None
        content_read, answer = reader.read(_content(note))
        assert content_read == content
        if answer is not None:
            ring.receive_note(_content(answer))
    reader.close()


def test_no_ring_is_allocated_for_frames_that_are_too_long() -> None:
    with pytest.raises(OSError, match="frames of 20000000 bytes are too long to be shared"):
        SharedRing(20_000_000)


@pytest.mark.parametrize("size", [LONG_BYTES - 1, 10**6])
def test_frames_too_short_or_too_long_go_over_the_socket(
    connected: socket.socket, new_ring: Callable[[int], SharedRing], size: int
) -> None:
    ring = new_ring(100_000)
    ring.receive_note(_content(SharedRingReader(connected, _content(ring.offer_note())).mapped_note()))
    assert ring.has_room(100_000)
    assert not ring.has_room(size)


@pytest.mark.parametrize(
    ("note", "sentence"),
    [
        (b"", "a note has 0 bytes, not 8"),
        (struct.pack("<Q", 1), "position that was never written"),
        (struct.pack("<Q", 2**64 - 1), "position that was never written"),
    ],
)
def test_a_publisher_refuses_an_impossible_acknowledgement(
    new_ring: Callable[[int], SharedRing], note: bytes, sentence: str
) -> None:
    with pytest.raises(WireError, match=sentence):
        new_ring(100_000).receive_note(note)


@pytest.mark.parametrize(
    ("note", "sentence"),
    [
        (b"12345678", "a note has 8 bytes, not 24"),
        (struct.pack("<QQQ", 10**6, 10**6, 0), "outside of the shared memory"),
        (struct.pack("<QQQ", 0, 2**64 - 1, 0), "outside of the shared memory"),
        (struct.pack("<QQQ", 2**64 - 1, 1, 0), "outside of the shared memory"),
    ],
)
def test_a_subscriber_refuses_a_frame_outside_the_ring(
    connected: socket.socket, new_ring: Callable[[int], SharedRing], note: bytes, sentence: str
) -> None:
    reader = SharedRingReader(connected, _content(new_ring(100_000).offer_note()))
    with pytest.raises(WireError, match=sentence):
        reader.read(note)


def _ordinary_file(folder: Path) -> int:
    (folder / "file").write_bytes(bytes(4 * mmap.PAGESIZE))
    return os.open(folder / "file", os.O_RDWR)


def _not_sealed(_: Path) -> int:
    file = os.memfd_create("unsealed", os.MFD_ALLOW_SEALING)
    os.truncate(file, 4 * mmap.PAGESIZE)
    return file


def _shorter(_: Path) -> int:
    file = os.memfd_create("short", os.MFD_ALLOW_SEALING)
    os.truncate(file, mmap.PAGESIZE)
    fcntl.fcntl(file, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK)
    return file


@pytest.mark.parametrize("make", [_ordinary_file, _not_sealed, _shorter])
def test_memory_that_may_shrink_is_refused(
    connected: socket.socket, make: Callable[[Path], int], tmp_path: Path
) -> None:
    file = make(tmp_path)
    with pytest.raises((WireError, OSError)):
        SharedRingReader(connected, struct.pack("<QQ", file, 4 * mmap.PAGESIZE))
    os.close(file)


def test_a_missing_file_is_an_os_error(connected: socket.socket) -> None:
    with pytest.raises(OSError, match="No such file"):
        SharedRingReader(connected, struct.pack("<QQ", 10**6, mmap.PAGESIZE))


def _mapping_count() -> int:
    return Path("/proc/self/maps").read_text().count("trundle-shared-ring")


def _publish_images(graph: Any, far: Any, count: int, size: int) -> tuple[list[tuple[int, int]], int]:
    """Publish images to another loop flat out; return those received, and the number of mappings meanwhile."""
    talker, listener = graph.node("camera"), far.node("screen")
    publisher = talker.advertise("image", "std_msgs/UInt8MultiArray", queue_size=None)
    got: list[tuple[int, int]] = []
    listener.subscribe(
        "image", "std_msgs/UInt8MultiArray", lambda m: got.append((int(m.data[0]), int(m.data.sum()))), queue_size=None
    )
    graph.until(lambda: publisher.has_subscribers)
    for i in range(count):
        pixels = np.full(size, i % 256, "u1")
        publisher.publish({"layout": {}, "data": pixels})
    graph.until(lambda: len(got) == count)
    return got, _mapping_count()


@pytest.mark.parametrize("size", [40_000, 230_400, 5_000_000])
def test_images_arrive_through_shared_memory_in_order(graph: Any, far: Any, size: int) -> None:
    got, shared = _publish_images(graph, far, 100, size)
    assert got == [(i, i * size) for i in range(100)]
    assert shared == 2, "one side each"


@pytest.mark.parametrize(
    "failing_class",
    ["trundle.ros.transport.send_queue.SharedRing", "trundle.ros.node.subscriber_link.SharedRingReader"],
)
def test_images_arrive_without_shared_memory(
    graph: Any, far: Any, failing_class: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError("a sandbox forbids it")

    monkeypatch.setattr(failing_class, refuse)
    got, shared = _publish_images(graph, far, 20, 230_400)
    assert got == [(i, i * 230_400) for i in range(20)]
    assert shared <= 1


def test_the_ring_is_unmapped_when_its_subscriber_ends(graph: Any, far: Any) -> None:
    _publish_images(graph, far, 3, 230_400)
    far.loop.stop()
    graph.until(lambda: _mapping_count() == 0)
