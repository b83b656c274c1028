"""Bounded queue of messages to one client."""

import asyncio
from collections import deque

_MAX_BYTES = 32 * 1024 * 1024
"""Maximum of queued bytes; further messages are dropped."""
_BUSY_BYTES = 256 * 1024
"""Queued bytes above which topics with queues hold messages back."""
_PER_MESSAGE = 64


class SendBuffer:
    """Messages of text or bytes, in order; used on the loop."""

    def __init__(self) -> None:
        self._messages: deque[str | bytes] = deque()
        self._bytes = 0
        self._filled = asyncio.Event()
        self._idle = asyncio.Event()
        self._idle.set()

    @property
    def is_busy(self) -> bool:
        """True if the client is slower than its messages."""
        return self._bytes > _BUSY_BYTES

    def put(self, message: str | bytes) -> bool:
        """Queue a message; False: the client is too slow, and the message is dropped."""
        if self._bytes > _MAX_BYTES:
            return False
        self._messages.append(message)
        self._bytes += len(message) + _PER_MESSAGE
        self._filled.set()
        if self.is_busy:
            self._idle.clear()
        return True

    async def get(self) -> str | bytes:
        """Wait for the next message."""
        while not self._messages:
            self._filled.clear()
            await self._filled.wait()
        message = self._messages.popleft()
        self._bytes -= len(message) + _PER_MESSAGE
        if not self.is_busy:
            self._idle.set()
        return message

    async def wait_idle(self) -> None:
        """Wait until the client is not busy."""
        await self._idle.wait()
