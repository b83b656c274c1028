"""A topic as its publisher sees it: links to subscribers here and elsewhere, a queue for each."""

import threading
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from .errors import MessageError
from .messages import Message
from .tcpros import LENGTH_BYTES, FrameProtocol, check_md5, fill_frame, frame

if TYPE_CHECKING:
    from .node import Node


_BATCH_MESSAGES, _BATCH_BYTES = 200, 256 * 1024
"""How much is handed on before others get their turn on the loop, whoever publishes however fast."""


class LocalSubscriber(Protocol):
    """A subscription in this process."""

    def receive(self, message: Message) -> None:
        """Take a message object."""
        ...

    def receive_bytes(self, data: bytes, publisher: "Publisher") -> None:
        """Take a message as bytes."""
        ...

    @property
    def is_raw(self) -> bool:
        """Whether it wants bytes."""
        ...


class Publisher:
    """Publishes one topic of one node; made by `Node.advertise`."""

    def __init__(
        self,
        node: "Node",
        topic: str,
        type_name: str,
        *,
        latch: bool,
        queue_size: int | None,
        on_connect: "Callable[[Publisher], None] | None",
        foreign: tuple[str, str] | None = None,
    ) -> None:
        self.topic = topic
        self.type = type_name
        self.latch = latch
        self._node = node
        self._queue_size = queue_size
        self._on_connect = on_connect
        self._foreign = foreign
        """(md5 sum, definition) of a type that need not be known here."""
        self._links: dict[FrameProtocol, str] = {}
        """Connection → name of the subscribing node."""
        self._local: dict[LocalSubscriber, str] = {}
        self._wanted = 0
        """Number of links; read by any thread."""
        self._outbox: deque[Any] = deque(maxlen=queue_size)
        self._lost = 0
        """Messages that were replaced before the loop came round to them."""
        self._flushes = False
        self._turn = threading.Lock()
        """Held while a thread other than the loop's sends, and while somebody joins and gets what is latched."""
        self._latched: Any = None
        self._sequence = 0
        self.published = 0
        """Messages handed to subscribers so far."""

    @property
    def subscribers(self) -> int:
        """How many subscribers are connected."""
        return self._wanted

    @property
    def has_subscribers(self) -> bool:
        """Whether publishing reaches anybody now."""
        return self._wanted > 0

    def publish(self, message: Message | dict[str, Any] | bytes) -> None:
        """Publish a message, from any thread; never blocks. The message is read-only from now on.

        A header's `seq` is filled in. Subscribers that read too slowly lose the oldest messages.

        Args:
            message: a message of the topic's type, its fields as a dictionary, or its bytes.

        Raises:
            MessageError: a dictionary that does not fit, or a message of another type.
        """
        if self._wanted == 0 and not self.latch:
            return
        if isinstance(message, dict):
            message = self._node.new(self.type, message)
        if not isinstance(message, bytes | bytearray | memoryview):
            given = self._node.messages.type_of(message)
            if given != self.type:
                raise MessageError(f"{self.topic} carries {self.type}, got a {given}")
            header = getattr(message, "header", None)
            if header is not None and hasattr(header, "seq"):
                self._sequence += 1
                header.seq = self._sequence
        if self._send_at_once(message):
            return
        self._lost += len(self._outbox) == self._queue_size
        self._outbox.append(message)
        self._flush_soon()

    def unregister(self) -> None:
        """Stop publishing; any thread."""
        self._node.unregister_publisher(self)

    # on the loop

    @property
    def md5sum(self) -> str:
        """What subscribers compare."""
        return self._foreign[0] if self._foreign else self._node.messages.md5(self.type)

    @property
    def definition(self) -> str:
        """The text of the type and of those it depends on."""
        return self._foreign[1] if self._foreign else self._node.messages.definition(self.type)

    @property
    def caller(self) -> str:
        """Name of the publishing node."""
        return self._node.name

    def accept(self, link: FrameProtocol, header: dict[str, str]) -> None:
        """Take a subscriber's connection, or refuse it with the reason the original gives."""
        peer, wanted = header.get("callerid", "unknown"), header.get("md5sum", "")
        if not check_md5(wanted, self.md5sum):
            theirs = header.get("type", self.type)
            if theirs != self.type:
                link.refuse(f"topic types do not match: [{theirs}] vs. [{self.type}]")
            else:
                link.refuse(
                    f"Client [{peer}] wants topic [{self.topic}] to have datatype/md5sum [{theirs}/{wanted}], but "
                    f"our version has [{self.type}/{self.md5sum}] Dropping connection."
                )
            return
        if header.get("tcp_nodelay", "0").strip() == "1":
            link.set_nodelay()
        link.send_header(
            {
                "callerid": self._node.name,
                "topic": self.topic,
                "type": self.type,
                "md5sum": self.md5sum,
                "latching": "1" if self.latch else "0",
                "message_definition": self.definition,
            }
        )
        with self._turn:
            self._links[link] = peer
            if self._latched is not None and (framed := self._framed(self._latched)) is not None:
                link.send_all([framed], self._queue_size)
        self._count()

    def catch_up(self) -> None:
        """Go on after all subscribers were too slow."""
        if self._outbox:
            self._flush_soon()

    def release(self, link: FrameProtocol) -> None:
        """Forget a connection that has ended."""
        self._links.pop(link, None)
        self._count()
        self.catch_up()

    def attach(self, subscriber: LocalSubscriber, name: str) -> None:
        """Take a subscription of this process."""
        if subscriber in self._local:
            return
        with self._turn:
            self._local[subscriber] = name
            latched = self._latched
        self._count()
        if latched is not None:
            self._hand_over(latched, subscriber, None)

    def detach(self, subscriber: LocalSubscriber) -> None:
        """Forget a subscription of this process."""
        self._local.pop(subscriber, None)
        self._count()

    def close(self) -> None:
        """Drop every link."""
        for link in list(self._links):
            link.close("the topic is no longer published")
        self._links.clear()
        self._local.clear()
        self._count()

    def connections(self) -> list[list[Any]]:
        """Links as getBusInfo tells them."""
        remote = [
            [_number(link), name, "o", link.kind, self.topic, True, link.description]
            for link, name in self._links.items()
        ]
        return remote + [
            [_number(s), name, "o", "INTRAPROCESS", self.topic, True, ""] for s, name in self._local.items()
        ]

    def statistics(self) -> list[Any]:
        """Bytes and messages as getBusStats tells them."""
        links = [[_number(link), link.bytes_sent, link.frames_sent - 1, True] for link in self._links]
        return [self.topic, sum(link.bytes_sent for link in self._links), links]

    @property
    def dropped(self) -> int:
        """Messages that left the queue unsent: published too fast, or slow subscribers, connected now, lost them."""
        return self._lost + sum(link.dropped for link in self._links)

    def _count(self) -> None:
        before, self._wanted = self._wanted, len(self._links) + len(self._local)
        if self._wanted > before and self._on_connect is not None:
            self._on_connect(self)

    def _send_at_once(self, message: Any) -> bool:
        """Spare the loop a message that goes to other processes only; False: nothing is done.

        Waking the loop's thread takes longer than sending.
        """
        if (
            self._local
            or not self._links
            or not self._node.loop.is_waited_for
            or not self._turn.acquire(blocking=False)
        ):
            return False
        try:
            links = list(self._links)
            if self._local or self._flushes or self._outbox or any(link.is_behind for link in links):
                return False
            if self.latch:
                self._latched = message
            self.published += 1
            if (framed := self._framed(message)) is not None:
                for link in links:
                    link.send_all([framed], self._queue_size)
            return True
        finally:
            self._turn.release()

    def _flush(self) -> None:
        frames: list[bytes | memoryview] = []
        count = size = 0
        try:
            while self._outbox and count < _BATCH_MESSAGES and size < _BATCH_BYTES and not self._is_held_up:
                message = self._outbox.popleft()
                count += 1
                if self.latch:
                    self._latched = message
                self.published += 1
                framed = self._framed(message) if self._links else None
                if framed is not None:
                    frames.append(framed)
                    size += len(framed)
                for subscriber in list(self._local):
                    self._hand_over(message, subscriber, framed)
            if frames:
                for link in list(self._links):
                    link.send_all(frames, self._queue_size)
        finally:
            # In this order: a message put in between is seen here or by its own publish().
            self._flushes = False
            if self._outbox and not self._is_held_up:
                self._flush_soon()

    @property
    def _is_held_up(self) -> bool:
        """Whether nobody can take a message now; until somebody can, those of the outbox need no bytes."""
        return bool(self._links) and not self._local and all(link.is_behind for link in self._links)

    def _flush_soon(self) -> None:
        if not self._flushes:
            self._flushes = True
            self._node.loop.deliver_soon(self._flush)

    def _hand_over(self, message: Any, subscriber: LocalSubscriber, framed: bytes | memoryview | None) -> None:
        if not subscriber.is_raw and not isinstance(message, bytes | bytearray | memoryview):
            subscriber.receive(message)
            return
        framed = self._framed(message) if framed is None else framed
        if framed is not None:
            subscriber.receive_bytes(bytes(framed[LENGTH_BYTES:]), self)

    def _framed(self, message: Any) -> bytes | memoryview | None:
        if isinstance(message, bytes | bytearray | memoryview):
            return frame(message)
        try:
            return fill_frame(self._node.messages.serialize(message, room=LENGTH_BYTES))
        except MessageError as error:
            self._node.log_error(f"a message on {self.topic} is not sent: {error}")
            return None


def _number(link: object) -> int:
    """A connection's id as XML-RPC carries it."""
    return id(link) % 2**31
