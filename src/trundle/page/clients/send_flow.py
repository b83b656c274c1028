"""Messages of one stream in a client's send queue."""

from collections import deque
from collections.abc import Callable, Hashable, Sequence
from enum import Enum
from typing import Final

from .frames import BINARY, TEXT, Buffer, frame_header
from .protocol import part_header
from .thinning import Thin

Keys = Callable[[], frozenset[Hashable]]
"""Returns the parts of a state that a message holds."""
_OVERHEAD_BYTES = 512
"""Memory of a queued message in addition to its buffers."""
_MAX_AGE_S = 0.1
"""Age of a stream's queued message above which only the newest are sent."""


def _kept() -> frozenset[Hashable]:
    """Keys of a message that is never dropped."""
    return frozenset((object(),))


def _newest() -> frozenset[Hashable]:
    return frozenset((None,))


KEPT: Final[Keys] = _kept
NEWEST: Final[Keys] = _newest
"""Keys of a message that any newer one of its stream replaces."""


class Reduction(Enum):
    """Reduction of a stream whose messages are too long for the connection."""

    THINNED = "thinned"
    HELD = "held"


class Message:
    """Queued message."""

    __slots__ = ("_first_byte", "_pieces", "_sent", "_thin", "keys", "number", "queued_s", "size")

    def __init__(
        self,
        number: int,
        first_byte: int,
        pieces: Sequence[Buffer],
        keys: Keys,
        queued_s: float,
        thin: Thin | None = None,
    ) -> None:
        self.number = number
        """Order among all messages."""
        self.keys = keys
        self.queued_s = queued_s
        self._first_byte = first_byte
        self._pieces = pieces
        """A header, and the content."""
        self._thin = thin
        self._sent = 0
        self.size = sum(map(len, pieces)) + _OVERHEAD_BYTES

    @property
    def is_begun(self) -> bool:
        """True if a part was sent."""
        return self._sent > 0

    def shrink(self, max_bytes: int) -> bool:
        """Replace the content by a smaller version of about that many bytes; False: there is none."""
        smaller = None if self._thin is None else self._thin(max_bytes)
        if smaller is None:
            return False
        self._pieces = (self._pieces[0], smaller)
        self.size = sum(map(len, self._pieces)) + _OVERHEAD_BYTES
        return True

    def part(self, max_bytes: int, flow: int) -> tuple[Sequence[Buffer], bool]:
        """Return the frame of the next part, or of the whole message if it is short; True: it is the last one."""
        total = self.size - _OVERHEAD_BYTES
        if not self._sent and (total <= 2 * max_bytes or self._first_byte not in (TEXT, BINARY)):
            return (frame_header(self._first_byte, total), *self._pieces), True
        end = min(self._sent + max_bytes, total)
        header = part_header(flow, is_last=end == total, is_text=self._first_byte == TEXT)
        pieces = _slice(self._pieces, self._sent, end)
        frame = frame_header(BINARY, len(header) + end - self._sent)
        self._sent = end
        return (frame, header, *pieces), end == total


class Flow:
    """Queued messages of one stream, in order."""

    __slots__ = ("droppable_bytes", "finish", "messages", "number", "reduction", "start", "stream")

    def __init__(self, stream: Hashable, number: int) -> None:
        self.stream = stream
        self.number = number
        """Number in the headers of parts."""
        self.messages: deque[Message] = deque()
        self.droppable_bytes = 0
        self.reduction: Reduction | None = None
        self.start = self.finish = 0.0
        """Start tags of the oldest message and of the last one sent [bytes]; the flow with the smallest tag is next."""

    @property
    def has_older(self) -> bool:
        """True if a message may be dropped regardless of its keys: it is not the stream's newest."""
        return next((m for m in self.messages if _may_drop(m)), self.messages[-1]) is not self.messages[-1]

    def drop_oldest(self) -> list[Message]:
        """Remove the oldest message that may be dropped."""
        message = next(m for m in self.messages if _may_drop(m))
        self.messages.remove(message)
        return [message]

    def drop_late(self, now_s: float) -> list[Message]:
        """Remove the messages that newer ones replace, if one has waited for too long; return them, oldest first."""
        oldest = next((m for m in self.messages if _may_drop(m)), None)
        if oldest is None or oldest is self.messages[-1] or now_s - oldest.queued_s < _MAX_AGE_S:
            return []
        newer: set[Hashable] = set()
        kept: deque[Message] = deque()
        dropped: list[Message] = []
        for message in reversed(self.messages):
            keys = message.keys()
            if _may_drop(message) and keys <= newer:
                dropped.append(message)
            else:
                kept.appendleft(message)
                newer |= keys
        self.messages = kept
        return dropped[::-1]

    def remove_unsent(self) -> list[Message]:
        """Remove the messages of which nothing was sent."""
        removed = [message for message in self.messages if not message.is_begun]
        self.messages = deque(message for message in self.messages if message.is_begun)
        return removed


def _may_drop(message: Message) -> bool:
    return message.keys is not KEPT and not message.is_begun


def _slice(pieces: Sequence[Buffer], start: int, end: int) -> list[Buffer]:
    """Return bytes `start` to `end` of buffers."""
    sliced: list[Buffer] = []
    for piece in pieces:
        if start < len(piece) and end > 0:
            sliced.append(memoryview(piece)[max(start, 0) : end])
        start -= len(piece)
        end -= len(piece)
    return sliced
