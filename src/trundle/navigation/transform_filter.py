"""Messages held until the transform at their stamp has arrived, as by tf's message filter."""

from collections import deque
from collections.abc import Callable
from typing import Any

from trundle.ros import Node, TransformBuffer, TransformError, TransformListener, to_nsec


class TransformFilter:
    """Passes stamped messages on in order, each once the transform from its frame to `target` is known at its stamp.

    A message that is older than one passed on is dropped: its transform will not arrive any more.
    """

    def __init__(self, node: Node, target: str, callback: Callable[[Any], None], *, queue_size: int) -> None:
        """Listen to tf.

        Args:
            node: node that subscribes; the filter is used on its loop only.
            target: frame into which messages must be transformable.
            callback: called with each message.
            queue_size: maximum number of messages held; the oldest is dropped.
        """
        self.target = target
        self._callback = callback
        self._waiting: deque[tuple[str, int, Any]] = deque(maxlen=queue_size)
        """Frame, stamp [ns], message."""
        self._listener = TransformListener(node, on_change=self._retry)

    @property
    def buffer(self) -> TransformBuffer:
        """Buffer of the transforms."""
        return self._listener.buffer

    def add(self, message: Any, frame: str | None = None) -> None:
        """Pass a message on now or later; `frame` overrides that of its header."""
        self._waiting.append((frame or message.header.frame_id, to_nsec(message.header.stamp), message))
        self._retry()

    def _retry(self) -> None:
        ready = [item for item in self._waiting if self._is_ready(item[0], item[1])]
        if not ready:
            return
        newest_ns = max(stamp_ns for _, stamp_ns, _ in ready)
        kept = [item for item in self._waiting if item[1] > newest_ns]
        self._waiting.clear()
        self._waiting.extend(kept)
        for _, _, message in sorted(ready, key=lambda item: item[1]):
            self._callback(message)

    def _is_ready(self, frame: str, stamp_ns: int) -> bool:
        try:
            self.buffer.lookup_transform(self.target, frame, stamp_ns)
        except TransformError:
            return False
        return True
