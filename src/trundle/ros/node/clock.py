"""ROS time: wall time, or simulated time that advances in ticks."""

import asyncio
import heapq
import itertools
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from .loop import GraphLoop

if TYPE_CHECKING:
    from ..message_types import Time

NS = 1_000_000_000


class Clock(Protocol):
    """Reads and awaits ROS time."""

    def now_ns(self) -> int:
        """ROS time [ns]; simulated time is 0 until first set."""
        ...

    async def sleep_until(self, ns: int) -> None:
        """Wait until ROS time is at least `ns`."""
        ...

    async def sleep(self, seconds: float) -> None:
        """Sleep in ROS time."""
        ...


class WallClock:
    """Clock of wall time, since 1970."""

    def now_ns(self) -> int:
        """Nanoseconds since 1970."""
        return time.time_ns()

    async def sleep_until(self, ns: int) -> None:
        """Sleep until a point in time."""
        await asyncio.sleep(max(0, ns - time.time_ns()) / NS)

    async def sleep(self, seconds: float) -> None:
        """Sleep."""
        await asyncio.sleep(max(0.0, seconds))


class SimClock:
    """Clock of simulated time, set by a simulation in this process or from /clock."""

    def __init__(self, loop: GraphLoop) -> None:
        self._loop = loop
        self._now_ns = 0
        self._sleepers: list[tuple[int, int, asyncio.Future[None]]] = []
        self._order = itertools.count()
        self._listeners: list[Callable[[], None]] = []
        self._is_wake_scheduled = False
        self.jumps = 0
        """Number of jumps back in time."""

    def now_ns(self) -> int:
        """ROS time [ns]; 0 until first set."""
        return self._now_ns

    def set(self, ns: int) -> None:
        """Set the time; thread-safe. A jump back wakes all sleepers, since their time may never come."""
        back = ns < self._now_ns
        self._now_ns = ns
        if back:
            self.jumps += 1
            self._loop.call_soon(self._jump)
        elif self._sleepers and not self._is_wake_scheduled and self._sleepers[0][0] <= ns:
            self._is_wake_scheduled = True
            self._loop.call_soon(self._wake)

    def on_jump(self, callback: Callable[[], None]) -> None:
        """Register a function to be called on the loop when time jumps back."""
        self._listeners.append(callback)

    async def sleep_until(self, ns: int) -> None:
        """Wait until the time is at least `ns`, or jumps back."""
        if ns <= self._now_ns:
            await asyncio.sleep(0)
            return
        future = asyncio.get_running_loop().create_future()
        heapq.heappush(self._sleepers, (ns, next(self._order), future))
        if ns <= self._now_ns:  # set() in another thread may have missed this sleeper
            self._wake()
        await future

    async def sleep(self, seconds: float) -> None:
        """Sleep in simulated time; waits for the first tick."""
        if self._now_ns == 0:
            await self.sleep_until(1)
        await self.sleep_until(self._now_ns + round(seconds * NS))

    def _wake(self) -> None:
        self._is_wake_scheduled = False
        while self._sleepers and self._sleepers[0][0] <= self._now_ns:
            _, _, future = heapq.heappop(self._sleepers)
            if not future.done():
                future.set_result(None)

    def _jump(self) -> None:
        sleepers, self._sleepers = self._sleepers, []
        for _, _, future in sleepers:
            if not future.done():
                future.set_result(None)
        for listener in self._listeners:
            listener()


def to_nsec(stamp: "Time") -> int:
    """Convert a `time` or `duration` to nanoseconds."""
    return stamp.sec * NS + stamp.nanosec
