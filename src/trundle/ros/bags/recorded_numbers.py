"""Numbers and transforms of a bag's messages over time."""

from array import array
from collections.abc import Iterator
from typing import Any

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from ..errors import MessageError
from ..messages.message_library import Messages
from ..messages.numbers import Layout, NumberReader
from .bag import BagConnection, BagReader

_Array = NDArray[np.float64]
TF_TYPES = ("tf2_msgs/TFMessage", "tf/tfMessage")
_LEFT_OUT = ("rosgraph_msgs/Log", "rosgraph_msgs/Clock")
_MAX_NUMBERS = 4_000_000
"""Maximum number of numbers of a layout; of longer recordings only every second, third, … message is read."""
_SHORTEST = 1e-9


class TopicNumbers(Struct, frozen=True, eq=False, kw_only=True):
    """Numbers of a topic's messages of one layout."""

    topic: str
    layout: Layout
    times: _Array
    """(messages,) ascending [s]: stamps of the headers, or times of recording without one."""
    values: _Array
    """(messages, numbers)"""


class FramePoses(Struct, frozen=True, eq=False, kw_only=True):
    """Poses of a frame in its parent."""

    parent: str
    child: str
    is_static: bool
    times: _Array
    """(poses,) ascending stamps [s]."""
    poses: _Array
    """(poses, 7) x y z [m], qw qx qy qz."""


class RecordedTopic(Struct, frozen=True, kw_only=True):
    """Topic of a bag."""

    type: str
    count: int
    fault: str | None
    """Reason why the topic's numbers were not read; None: they were read."""


class RecordedNumbers(Struct, frozen=True, eq=False, kw_only=True):
    """All numbers and transforms of a bag."""

    start: float
    """Time of the first message [s]."""
    duration: float
    topics: dict[str, RecordedTopic]
    numbers: tuple[TopicNumbers, ...]
    frames: tuple[FramePoses, ...]


def read_numbers(bag: BagReader) -> RecordedNumbers:
    """Read a bag's messages once.

    Raises:
        BagError: the file is damaged.
    """
    messages = Messages(bare=True)
    counts: dict[str, int] = {}
    for connection, count in zip(bag.connections, bag.counts, strict=True):
        counts[connection.topic] = counts.get(connection.topic, 0) + count
    types = {connection.topic: connection.type for connection in bag.connections}
    readers: dict[str, NumberReader] = {}
    faults: dict[str, str] = {}
    for connection in bag.connections:
        try:
            messages.add_definition(connection.type, connection.definition)
            readers.setdefault(connection.topic, NumberReader(messages, connection.type))
        except MessageError as error:
            faults[connection.topic] = str(error)
    rows: dict[str, _Rows] = {}
    frames = _Frames()

    def is_read(connection: BagConnection) -> bool:
        return connection.topic in readers and connection.type not in _LEFT_OUT

    for message in bag.messages(is_read):
        connection = message.connection
        try:
            content = messages.deserialize(message.data, connection.type)
            if connection.type in TF_TYPES:
                frames.add(content, is_static=connection.topic.endswith("/tf_static"))
                continue
            found = readers[connection.topic].read(content)
        except MessageError as error:
            faults.setdefault(connection.topic, str(error))
            continue
        if found is not None and found[1]:
            topic = rows.setdefault(connection.topic, _Rows(counts[connection.topic]))
            topic.add(message_time(content, message.stamp_ns), *found)
    return RecordedNumbers(
        start=bag.start_ns / 1e9,
        duration=(bag.end_ns - bag.start_ns) / 1e9,
        topics={
            topic: RecordedTopic(type=types[topic], count=count, fault=faults.get(topic))
            for topic, count in sorted(counts.items())
        },
        numbers=tuple(block for topic in sorted(rows) for block in rows[topic].blocks(topic)),
        frames=tuple(frames.poses()),
    )


def message_time(message: Any, received_ns: int) -> float:
    """Return the stamp of a message's header [s], or the time of its arrival if it has no header."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    stamp_ns = 0 if stamp is None else stamp.sec * 10**9 + stamp.nanosec
    return (stamp_ns or received_ns) / 1e9


def transform_poses(message: Any) -> Iterator[tuple[str, str, float, list[float]]]:
    """Yield parent, child, stamp [s] and pose (x y z [m], qw qx qy qz) of the valid transforms in a message of tf."""
    for transform in message.transforms:
        at, turn = transform.transform.translation, transform.transform.rotation
        pose: list[float] = [at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z]
        if np.isfinite(pose).all() and max(map(abs, pose[3:])) > _SHORTEST:
            stamp = transform.header.stamp
            names = transform.header.frame_id.lstrip("/"), transform.child_frame_id.lstrip("/")
            yield *names, stamp.sec + stamp.nanosec / 1e9, pose


class _Rows:
    """Rows of a topic by layout."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._rows: dict[Layout, tuple[array[float], array[float]]] = {}
        self._seen = 0

    def add(self, time: float, layout: Layout, values: list[float]) -> None:
        self._seen += 1
        every = -(-self._count * len(layout.paths) // _MAX_NUMBERS)
        if self._seen % max(1, every) == 0:
            times, numbers = self._rows.setdefault(layout, (array("d"), array("d")))
            times.append(time)
            numbers.extend(values)

    def blocks(self, topic: str) -> Iterator[TopicNumbers]:
        for layout, (times, numbers) in self._rows.items():
            order, ascending = _in_order(times)
            values = np.array(numbers).reshape(len(times), -1)[order]
            yield TopicNumbers(topic=topic, layout=layout, times=ascending, values=values)


class _Frames:
    """Transforms by parent and child."""

    def __init__(self) -> None:
        self._rows: dict[tuple[str, str], tuple[array[float], array[float]]] = {}
        self._static: dict[tuple[str, str], bool] = {}

    def add(self, message: Any, *, is_static: bool) -> None:
        for parent, child, time, pose in transform_poses(message):
            times, numbers = self._rows.setdefault((parent, child), (array("d"), array("d")))
            times.append(time)
            numbers.extend(pose)
            self._static[parent, child] = is_static

    def poses(self) -> Iterator[FramePoses]:
        for (parent, child), (times, numbers) in self._rows.items():
            order, ascending = _in_order(times)
            poses = np.array(numbers).reshape(len(times), 7)[order]
            poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
            is_static = self._static[parent, child]
            yield FramePoses(parent=parent, child=child, is_static=is_static, times=ascending, poses=poses)


def _in_order(times: "array[float]") -> tuple[NDArray[np.intp], _Array]:
    """Return the indices that sort the times, only the last one of equal times, and the sorted times."""
    found = np.array(times)
    order = np.argsort(found, kind="stable")
    is_last = np.append(np.diff(found[order]) > 0.0, True)
    return order[is_last], found[order][is_last]
