"""Streams of files, one after the other, in multipart/x-mixed-replace."""

import asyncio
from collections.abc import AsyncGenerator, Callable

from trundle.ros import Message, Node, to_nsec

from .pictures import PictureError

BOUNDARY = "boundarydonotcross"
MULTIPART = f"multipart/x-mixed-replace;boundary={BOUNDARY}"
_END = f"\r\n--{BOUNDARY}\r\n".encode()

Encode = Callable[[Message], tuple[str, bytes]]
"""Message → content type, file; raises PictureError. Called on another thread."""


class NewestMessage:
    """Newest message of a topic; older ones are dropped."""

    def __init__(self, node: Node, topic: str, kind: str) -> None:
        self._message: Message = None
        self._arrived = asyncio.Event()
        self._subscription = node.subscribe(topic, kind, self._receive, queue_size=1, on_loop=True)

    async def get(self, timeout_s: float | None) -> Message:
        """Wait for a message; TimeoutError after the timeout."""
        async with asyncio.timeout(timeout_s):
            await self._arrived.wait()
        self._arrived.clear()
        return self._message

    def close(self) -> None:
        """Unsubscribe."""
        self._subscription.unregister()

    def _receive(self, message: Message) -> None:
        self._message = message
        self._arrived.set()


async def stream(
    node: Node, topic: str, kind: str, encode: Encode, *, repeat_s: float | None
) -> AsyncGenerator[bytes, None]:
    """Stream a topic until closed, or until an image cannot be shown.

    Args:
        node: node that subscribes.
        topic: topic of images.
        kind: topic's type.
        encode: encodes a message.
        repeat_s: time after which the last file is repeated; None: never.
    """
    newest = NewestMessage(node, topic, kind)
    last: bytes | None = None
    try:
        yield f"--{BOUNDARY}\r\n".encode()
        while True:
            try:
                message = await newest.get(repeat_s)
                content_type, data = await asyncio.to_thread(encode, message)
            except TimeoutError:
                if last is not None:
                    yield last
                continue
            except PictureError as error:
                node.log.error(f"{topic}: {error}")
                return
            stamp = timestamp(message)
            head = f"Content-type: {content_type}\r\nX-Timestamp: {stamp}\r\nContent-Length: {len(data)}\r\n\r\n"
            last = head.encode() + data + _END
            yield last
    finally:
        newest.close()


def timestamp(message: Message) -> str:
    """Return the stamp of a message's header [s]."""
    return f"{to_nsec(message.header.stamp) / 1e9:.6f}"
