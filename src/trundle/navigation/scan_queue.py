"""Scans processed one after the other in a worker thread; simulated time waits for them."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.ros import Node

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_MAX_BEAMS = 100_000


class ScanQueue:
    """Maximum number of waiting scans; beyond it, the oldest is dropped."""

    def __init__(self, node: Node, process: "Callable[[sensor_msgs.LaserScan], Awaitable[None]]", *, size: int) -> None:
        self._node = node
        self._process = process
        self._waiting: deque[sensor_msgs.LaserScan] = deque(maxlen=size)
        self._is_waiting = asyncio.Event()

    def add(self, scan: "sensor_msgs.LaserScan") -> None:
        """Process a scan once the earlier ones are done."""
        self._waiting.append(scan)
        self._is_waiting.set()

    def clear(self) -> None:
        """Drop the waiting scans."""
        self._waiting.clear()

    async def run(self) -> None:
        """Process until cancelled."""
        while True:
            await self._is_waiting.wait()
            work = self._node.loop.work
            with work.pending():  # not only one after the other: time would go on between them
                while self._waiting:
                    with work.pending(f"a scan's processing by {self._node.name}"):
                        await self._process(self._waiting.popleft())
            self._is_waiting.clear()


def beam_ends(scan: "sensor_msgs.LaserScan") -> NDArray[np.float64]:
    """Return the ends (n, 2) of the measured beams in the laser's frame [m], in their order.

    Raises:
        ValueError: its angles or ranges are not finite, or there are too many.
    """
    ranges = np.array(scan.ranges, dtype=np.float64)
    if not np.isfinite(scan.angle_min + scan.angle_increment + scan.range_min):
        raise ValueError("its angles or the bounds of its ranges are not finite")
    if ranges.size > _MAX_BEAMS:
        raise ValueError(f"it has {ranges.size} beams, more than {_MAX_BEAMS}")
    angles = scan.angle_min + scan.angle_increment * np.arange(ranges.size, dtype=np.float64)
    is_measured = (ranges > scan.range_min) & (ranges < scan.range_max)
    return np.stack([ranges * np.cos(angles), ranges * np.sin(angles)], axis=1)[is_measured]
