"""Slots of pictures that are drawn at the same time; further pictures wait for one."""

import asyncio
from collections.abc import AsyncGenerator
from contextlib import asynccontextmanager


class PictureError(Exception):
    """A picture cannot be drawn; the text is the reason."""


class PictureSlots:
    """A number of slots, and a limit of the pictures that wait for one."""

    def __init__(self, count: int, *, max_waiting: int) -> None:
        self._free = asyncio.Semaphore(count)
        self._max_waiting = max_waiting
        self._waiting = 0

    @asynccontextmanager
    async def slot(self) -> AsyncGenerator[None]:
        """Wait for a slot and occupy it; raises PictureError if too many pictures wait."""
        if self._waiting >= self._max_waiting:
            raise PictureError(f"{self._max_waiting} pictures are waiting already")
        self._waiting += 1
        try:
            await self._free.acquire()
        finally:
            self._waiting -= 1
        try:
            yield
        finally:
            self._free.release()
