"""The page's server: CPU time of relaying clouds of a million points to a client, and poses of moving robots.

The peer is a process that copies the same bytes from one socket to another. Times are of the server processes' CPU.
"""

import io
import multiprocessing
import os
import socket
import statistics
import struct
import threading
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from urllib.parse import urlsplit

import numpy as np

from bench.table import Row
from trundle.base.http.page_address import PageAddress
from trundle.page import GraphAddress, PageServer, Session
from trundle.page.world.manifest import Manifest, PhysicsSettings, SceneSettings
from trundle.ros import Core, GraphLoop

_POINTS, _POINT_BYTES = 1_000_000, (16, 32)
_RATE_HZ, _MESSAGES, _PAIRS = 5.0, 15, 3
_ROBOTS, _LINKS, _POSE_BYTES, _POSES_HZ, _POSES = 50, 12, 32, 30.0, 300
_PART, _MARK = 0x80, 0x82
"""First bytes of parts of messages and of marks."""
_HEAD_BYTES = 13
_KEY = "AAAAAAAAAAAAAAAAAAAAAA=="


def run() -> list[Row]:
    """Alternate server and relay, so that a varying machine speed affects both equally."""
    if not os.path.exists("/proc/self/stat"):
        return []  # the CPU time of other processes is unknown
    rows = [_relay_row(size * _POINTS) for size in _POINT_BYTES]
    return [*rows, _poses_row()]


def _relay_row(size: int) -> Row:
    pairs = [(_page_cpu(size), _relay_cpu(size)) for _ in range(_PAIRS)]
    ratio = statistics.median(page_s / relay_s for page_s, relay_s in pairs)
    page_ms = 1e3 * statistics.median(page_s for page_s, _ in pairs)
    return Row(f"cloud of {size // 10**6} MB, page's server", page_ms, "ms CPU", "a socket relay", ratio)


def _page_cpu(size: int) -> float:
    """Return the CPU time of the page's server for one cloud [s]."""
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        with process(_publish_clouds, core.uri, size) as publisher:
            address = GraphAddress(master_uri=core.uri)
            with PageServer.start(Session(title="b", kind="graph"), at=PageAddress(port=0), graph=address) as page:
                received = subscribe(page.url, "/cloud", size)
                publisher.send("go")
                cpu_s = _cpu_per_message(page.process_id, received)
        loop.run(core.stop())
    return cpu_s


def _relay_cpu(size: int) -> float:
    """Return the CPU time of a plain relay for one cloud [s]."""
    with _running_relay() as (process_id, source, sink):
        threading.Thread(target=_feed, args=(source, size, _RATE_HZ, _MESSAGES + 3), daemon=True).start()
        return _cpu_per_message(process_id, lambda count: _discard(sink, count * size))


def _cpu_per_message(process_id: int, receive: Callable[[int], None]) -> float:
    """Return the CPU time of a process per message [s], without the first few."""
    receive(3)
    before = cpu_s(process_id)
    receive(_MESSAGES)
    return (cpu_s(process_id) - before) / _MESSAGES


def _poses_row() -> Row:
    pairs = [(_poses_share(), _poses_relay_share()) for _ in range(_PAIRS)]
    share = statistics.median(page for page, _ in pairs)
    ratio = statistics.median(page / relay for page, relay in pairs)
    return Row("50 robots at 30 Hz, page's server", share, "% of core", "a socket relay", ratio)


def _empty_world() -> Manifest:
    grey = (0.5, 0.5, 0.5)
    scene = SceneSettings(ambient=grey, background=grey, sky=False, shadows=False, grid=False, fog=None)
    physics = PhysicsSettings(gravity=(0.0, 0.0, -9.8), wind=(0.0, 0.0, 0.0), step=0.001)
    return Manifest(generation=1, name="empty", scene=scene, physics=physics)


def _poses_share() -> float:
    """Return the CPU time of the page's server while bodies move, in percent of a core."""
    rows = np.random.default_rng(0).normal(size=(_ROBOTS * _LINKS, 7))
    with PageServer.start(Session(title="b", kind="simulation"), at=PageAddress(port=0)) as page:
        page.set_world(_empty_world(), {})
        receive = subscribe(page.url, "trundle/poses", 100)
        reader = threading.Thread(target=receive, args=(_POSES,))
        reader.start()
        started, before = time.monotonic(), cpu_s(page.process_id)
        for number in range(_POSES):
            page.put_poses(number, rows + number)
            time.sleep(max(0.0, started + number / _POSES_HZ - time.monotonic()))
        share = (cpu_s(page.process_id) - before) / (time.monotonic() - started)
    reader.join()
    return 100.0 * share


def _poses_relay_share() -> float:
    """Return the CPU time of a plain relay of the same number of bytes, in percent of a core."""
    size = _ROBOTS * _LINKS * _POSE_BYTES
    with _running_relay() as (process_id, source, sink):
        started, before = time.monotonic(), cpu_s(process_id)
        threading.Thread(target=_feed, args=(source, size, _POSES_HZ, _POSES), daemon=True).start()
        _discard(sink, _POSES * size)
        return 100.0 * (cpu_s(process_id) - before) / (time.monotonic() - started)


@contextmanager
def _running_relay() -> Generator[tuple[int, socket.socket, socket.socket]]:
    """Run a relay; yield its process id, its source and its sink."""
    with (
        socket.create_server(("127.0.0.1", 0)) as inward,
        socket.create_server(("127.0.0.1", 0)) as outward,
        process(_relay, inward.getsockname()[1], outward.getsockname()[1]) as relay,
    ):
        source, sink = inward.accept()[0], outward.accept()[0]
        with source, sink:
            yield relay.recv(), source, sink


def subscribe(url: str, topic: str, min_size: int) -> Callable[[int], None]:
    """Subscribe to a topic; return a function that reads a number of messages longer than `min_size`."""
    host, port = str(urlsplit(url).hostname), int(urlsplit(url).port or 0)
    sock = socket.create_connection((host, port))
    sock.sendall(
        f"GET /?{urlsplit(url).query} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Key: {_KEY}\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: trundle.v1\r\n\r\n".encode()
    )
    stream = sock.makefile("rb")
    while stream.readline().strip():
        pass
    topic_field = f'"topic":"{topic}"'.encode()
    while topic_field not in (text := _read_message(stream)):
        pass
    number = int(text[: text.index(topic_field)].rpartition(b'"id":')[2].partition(b",")[0])
    body = b'{"op":"subscribe","subscriptions":[{"id":1,"channelId":%d}]}' % number
    _send(sock, body)

    def receive(count: int) -> None:
        while count and (size := _skip_message(stream, sock)):
            count -= size > min_size

    return receive


def _send(sock: socket.socket, text: bytes) -> None:
    sock.sendall(struct.pack("!BBI", 0x81, 0x80 | len(text), 0) + text)  # masked with zeros


def _read_message(stream: io.BufferedReader) -> bytes:
    return stream.read(_read_size(stream))


def _skip_message(stream: io.BufferedReader, sock: socket.socket) -> int:
    """Read a message in all its parts, and echo marks; return its length, or 0 at the stream's end."""
    whole = 0
    while size := _read_size(stream):
        head = stream.read(min(size, _HEAD_BYTES))
        if head[0] == _MARK:
            _send(sock, b'{"op":"trundle/echo","mark":%d}' % struct.unpack_from("<I", head, 1))
        left = size - len(head)
        while left and (piece := stream.read1(min(left, 1 << 20))):
            left -= len(piece)
        whole += size
        if head[0] != _PART or head[5]:
            return whole
    return 0


def _read_size(stream: io.BufferedReader) -> int:
    short = stream.read(2)[-1:]
    if not short or short[0] < 126:
        return short[0] if short else 0
    return int.from_bytes(stream.read(2 if short[0] == 126 else 8), "big")


def _discard(sock: socket.socket, count: int) -> None:
    buffer = bytearray(1 << 20)
    while count:
        count -= sock.recv_into(buffer, min(count, len(buffer)))


def _feed(sock: socket.socket, size: int, rate_hz: float, count: int) -> None:
    """Send messages at a rate."""
    message = bytes(size)
    started = time.monotonic()
    for number in range(count):
        sock.sendall(message)
        time.sleep(max(0.0, started + (number + 1) / rate_hz - time.monotonic()))


def _relay(pipe: Connection, inward: int, outward: int) -> None:
    """Copy bytes from one socket to another."""
    source, sink = (socket.create_connection(("127.0.0.1", port)) for port in (inward, outward))
    pipe.send(os.getpid())
    buffer = memoryview(bytearray(1 << 20))
    while count := source.recv_into(buffer):
        sink.sendall(buffer[:count])


def _publish_clouds(pipe: Connection, master_uri: str, size: int) -> None:
    """Publish clouds at a fixed rate after "go"."""
    from trundle.ros import Node

    with GraphLoop() as loop:
        node = Node("clouds", loop=loop, master_uri=master_uri)
        publisher = node.advertise("/cloud", "sensor_msgs/PointCloud2", queue_size=1)
        cloud = node.new("sensor_msgs/PointCloud2", {"width": _POINTS, "height": 1, "data": np.zeros(size, np.uint8)})
        pipe.recv()
        while not publisher.has_subscribers:
            time.sleep(0.01)
        while True:
            started = time.monotonic()
            publisher.publish(cloud)
            time.sleep(max(0.0, started + 1 / _RATE_HZ - time.monotonic()))


@contextmanager
def process(target: Callable[..., None], *arguments: object) -> Generator[Connection]:
    """Run a function in a new process, and yield the pipe to it."""
    context = multiprocessing.get_context("spawn")
    pipe, child_pipe = context.Pipe()
    running = context.Process(target=target, args=(child_pipe, *arguments), daemon=True)
    running.start()
    try:
        yield pipe
    finally:
        running.kill()
        running.join()


def cpu_s(process_id: int) -> float:
    """Return the CPU time of all threads of a process [s]."""
    with open(f"/proc/{process_id}/stat", encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
