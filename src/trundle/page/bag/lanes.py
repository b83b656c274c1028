"""Channel of a bag's lanes: times of each topic's messages, from the bag's index."""

import asyncio
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import msgspec
import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.ros import open_bag

from ..clients.channel import Channel, Client
from ..world.streams import LANES

_BUCKETS = 600
"""Number of intervals of the bag's duration; an interval with a message is drawn whole."""


class Lane(msgspec.Struct, frozen=True):
    """A topic's messages over time."""

    count: int
    bands: list[tuple[int, int]]
    """First and last bucket of each run of nonempty buckets."""


class Lanes(msgspec.Struct, frozen=True):
    """Content of the channel."""

    start_ns: int
    bucket_ns: int
    topics: Mapping[str, Lane]


class LanesChannel(Channel):
    """Lanes of a bag; the index is read for the first client, with its own reader and thread."""

    def __init__(self, path: Path) -> None:
        super().__init__(LANES, encoding="json", is_droppable=False, trundle_only=True)
        self._path = path
        self._lanes: bytes | None = None
        self._reading: asyncio.Task[None] | None = None

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        if self._lanes is not None:
            client.send_message(self, 0, (self._lanes,))
        elif self._reading is None:
            self._reading = asyncio.get_running_loop().create_task(self._read())

    async def _read(self) -> None:
        with ThreadPoolExecutor(1, thread_name_prefix="trundle-bag-lanes") as thread:
            lanes = await asyncio.get_running_loop().run_in_executor(thread, read_lanes, self._path)
        self._lanes = msgspec.json.encode(lanes)
        self.publish(0, (self._lanes,))


def read_lanes(path: Path) -> Lanes:
    """Read the times of a bag's messages; in a damaged file, no topic has a lane."""
    try:
        with open_bag(path) as bag:
            bucket_ns = (bag.end_ns - bag.start_ns) // _BUCKETS + 1
            topics = {topic: _lane(stamps, bag.start_ns, bucket_ns) for topic, stamps in bag.stamps_ns().items()}
            return Lanes(bag.start_ns, bucket_ns, topics)
    except (TrundleError, OSError):  # playback reports the error
        return Lanes(0, 1, {})


def _lane(stamps_ns: Sequence[int], start_ns: int, bucket_ns: int) -> Lane:
    """Return the lane of a topic's ascending stamps [ns]."""
    buckets = np.unique((np.array(stamps_ns, dtype=np.int64) - start_ns) // bucket_ns)
    runs = np.split(buckets, np.flatnonzero(np.diff(buckets) > 1) + 1)
    return Lane(len(stamps_ns), [(int(run[0]), int(run[-1])) for run in runs if len(run)])
