"""Scans processed one after the other in a worker thread; simulated time waits for them."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING

from trundle.ros import Node

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs


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
