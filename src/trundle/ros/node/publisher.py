"""Publisher of a topic: subscriber connections with a queue each."""

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from ..errors import MessageError
from ..messages.codec import ENCODING_ERRORS, Codec
from ..messages.raw_message import Message, TypedMessage
from ..transport.framing import LENGTH, Pieces
from ..transport.headers import check_md5
from ..transport.send_queue import SendQueue
from ..transport.tcpros import FrameProtocol
from .local_graph import LocalSubscriber
from .node_context import NodeContext
from .subscriber_links import SubscriberLinks

_BATCH_MESSAGES, _BATCH_BYTES = 200, 1024 * 1024
"""Batch size, so that a fast publisher does not starve the loop."""
_BYTES = bytes, bytearray, memoryview
_MAX_WARNINGS = 100
"""Limit of `_refused`, since peers choose their names."""


class Publisher:
    """Publisher of one topic of a node; created by `Node.advertise`."""

    def __init__(
        self,
        node: NodeContext,
        topic: str,
        type_name: str,
        *,
        latch: bool,
        queue_size: int | None,
        on_connect: "Callable[[Publisher], None] | None",
        raw_type: tuple[str, str] | None,
        unregister: "Callable[[Publisher], None]",
    ) -> None:
        self.topic = topic
        self.type = type_name
        self.latch = latch
        self._node = node
        self._loop = node.loop
        self._queue_size = queue_size
        self._on_connect = on_connect
        self._unregister = unregister
        self._raw_type = raw_type
        """Pair (md5 sum, definition) of a possibly unknown type."""
        self._subscriber_links = SubscriberLinks(topic)
        self._direct: tuple[SendQueue, ...] = ()
        """Send queues to other processes, which the publishing thread writes itself if there are no local
        subscribers.
        """
        self._refused: set[str] = set()
        """Names of refused subscribers, each reported once; they retry."""
        self._subscriber_count = 0
        """Number of links; read by any thread."""
        self._outbox: deque[Any] = deque(maxlen=queue_size)
        self._lost = 0
        """Messages dropped from the outbox before the loop sent them."""
        self._is_flush_scheduled = False
        self._send_lock = threading.Lock()
        """Held while another thread than the loop's sends, and while a new subscriber gets latched messages."""
        self._latched: Any = None
        self.latched_for_others: tuple[bytes, ...] = ()
        """Latched messages of a bag's other publishers, which new subscribers get before the last message."""
        self._class: type[Message] | None = None
        """Class of the messages so far."""
        self._codec: Codec | None = None
        self._frame: Callable[[Any], Pieces | None] = self._framed
        """Codec's fast path; raises for messages that need `_framed`."""
        self._has_header = False
        self._sequence = 0
        self.published = 0
        """Number of published messages."""

    @property
    def subscribers(self) -> int:
        """Number of connected subscribers."""
        return self._subscriber_count

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""
        return self._subscriber_count > 0

    @property
    def is_congested(self) -> bool:
        """True while every subscriber reads too slowly."""
        outs = self._direct
        for out in outs:  # the usual case first, as this is called for every message
            if not out.is_congested:
                return False
        return bool(outs)

    @property
    def needs_every_message(self) -> bool:
        """True if a subscriber needs every message; else periodic messages may be skipped."""
        return self._subscriber_count > 0 and self._subscriber_links.need_every_message

    def publish(self, message: TypedMessage | Mapping[str, object] | bytes | memoryview) -> None:
        """Publish a message; thread-safe, never blocks. The message must not be changed afterwards.

        Sets a header's `seq`. Slow subscribers lose the oldest messages.

        Args:
            message: a message of the topic's type, its fields as a dictionary, or its bytes.

        Raises:
            MessageError: a dictionary that does not fit, or a message of another type.
        """
        if self._subscriber_count == 0 and not self.latch:
            return
        if (timer := self._loop.publish_timer) is None:
            self._publish(message)
            return
        with timer():
            self._publish(message)

    def _publish(self, message: TypedMessage | Mapping[str, object] | bytes | memoryview) -> None:
        if type(message) is not self._class:
            message = self._checked(message)
        header: Any = getattr(message, "header", None) if self._has_header else None
        if header is not None and hasattr(header, "seq"):
            self._sequence += 1
            header.seq = self._sequence
        self._send(message)

    def _send(self, message: Any) -> None:
        """Send a checked message at once if possible, else on the loop."""
        if self._direct and self._send_at_once(message):
            return
        is_lost = len(self._outbox) == self._queue_size
        self._outbox.append(message)
        if is_lost:
            self._lost += 1
            time.sleep(0)  # lets the loop have the interpreter: a publisher that never waits would keep it from sending
        if not self._is_flush_scheduled and not self.is_congested:  # `resume` sends the message later
            self._flush_soon()

    def checkpoint(self) -> Callable[[], None]:
        """Return a function that restores the present sequence number."""
        return partial(setattr, self, "_sequence", self._sequence)

    def unregister(self) -> None:
        """Stop publishing; thread-safe."""
        self._unregister(self)

    # on the loop

    @property
    def md5sum(self) -> str:
        """md5 sum of the type."""
        return self._raw_type[0] if self._raw_type else self._node.messages.md5(self.type)

    @property
    def definition(self) -> str:
        """Full definition of the type with dependencies."""
        return self._raw_type[1] if self._raw_type else self._node.messages.definition(self.type)

    @property
    def caller(self) -> str:
        """Name of the publishing node."""
        return self._node.name

    @property
    def is_outside(self) -> bool:
        """See `LocalPublisher`: the callbacks of a simulation's nodes run on its thread."""
        return self._node.deliver is None

    def accept(self, link: FrameProtocol, header: dict[str, str]) -> None:
        """Accept a subscriber's connection, or refuse it with ROS' reason."""
        peer = header.get("callerid", "unknown")
        if (reason := self._mismatch(header, peer)) is not None:
            if peer not in self._refused and len(self._refused) < _MAX_WARNINGS:
                self._refused.add(peer)
                self._node.log.warn(f"Could not process inbound connection: {reason} ({peer} asks for {self.topic})")
            link.refuse(reason)
            return
        if header.get("tcp_nodelay", "0").strip() == "1":
            link.set_nodelay()
        with self._send_lock:
            # From here on, messages wait for the loop: the peer may act on the header before it is counted.
            self._send_directly_to(())
            self._subscriber_count += 1
            link.send_header(self.header_fields())
            self._subscriber_links.remote[link] = peer
            self._update_subscribers()
            for message in self._latched_messages():
                if (framed := self._framed(message)) is not None:
                    link.out.send([framed], self._queue_size)
        if self._on_connect is not None:
            self._on_connect(self)

    def header_fields(self) -> dict[str, str]:
        """Fields of the connection header that subscribers get."""
        return {
            "callerid": self._node.name,
            "topic": self.topic,
            "type": self.type,
            "md5sum": self.md5sum,
            "latching": "1" if self.latch else "0",
            "message_definition": self.definition,
        }

    def resume(self) -> None:
        """Send the waiting messages after all subscribers were congested."""
        if self._outbox and not self._is_flush_scheduled:
            self._flush()

    def release(self, link: FrameProtocol) -> None:
        """Remove a closed connection."""
        self._subscriber_links.remote.pop(link, None)
        self._count_subscribers()
        self.resume()

    def attach(self, subscriber: LocalSubscriber, name: str) -> None:
        """Connect a subscription of this process."""
        if subscriber in self._subscriber_links.local:
            return
        with self._send_lock:
            self._subscriber_links.local[subscriber] = name
            self._update_subscribers()
            latched = self._latched_messages()
        self._count_subscribers()
        for message in latched:
            self._deliver(message, subscriber, None)

    def detach(self, subscriber: LocalSubscriber) -> None:
        """Disconnect a subscription of this process."""
        self._subscriber_links.local.pop(subscriber, None)
        self._count_subscribers()

    def close(self) -> None:
        """Close all connections."""
        self._subscriber_links.close()
        self._count_subscribers()

    def connections(self) -> list[list[int | str | bool]]:
        """Links, as in getBusInfo."""
        return self._subscriber_links.connections()

    def statistics(self) -> list[object]:
        """Bytes and messages, as in getBusStats."""
        return self._subscriber_links.statistics()

    @property
    def dropped(self) -> int:
        """Dropped messages: from the outbox, or by slow subscribers still connected."""
        return self._lost + self._subscriber_links.dropped

    def _latched_messages(self) -> tuple[Any, ...]:
        """Messages for a new subscriber."""
        return () if self._latched is None else (*self.latched_for_others, self._latched)

    def _mismatch(self, header: dict[str, str], peer: str) -> str | None:
        """Reason why a subscriber's type does not match, in ROS' words."""
        md5sum, type_name = header.get("md5sum", ""), header.get("type", self.type)
        if check_md5(md5sum, self.md5sum):
            return None
        if type_name != self.type:
            return f"topic types do not match: [{type_name}] vs. [{self.type}]"
        return (
            f"Client [{peer}] wants topic [{self.topic}] to have datatype/md5sum [{type_name}/{md5sum}], but "
            f"our version has [{self.type}/{self.md5sum}] Dropping connection."
        )

    def _update_subscribers(self) -> None:
        local, remote = self._subscriber_links.local, self._subscriber_links.remote
        self._send_directly_to(() if local else tuple(link.out for link in remote))

    def _send_directly_to(self, outs: tuple[SendQueue, ...]) -> None:
        """Set the queues that publishing threads write; none: the loop sends."""
        self._direct = outs

    def _count_subscribers(self) -> None:
        self._update_subscribers()
        previous, self._subscriber_count = self._subscriber_count, len(self._subscriber_links)
        if self._subscriber_count > previous and self._on_connect is not None:
            self._on_connect(self)

    def _send_at_once(self, message: Any) -> bool:
        """Send to other processes from this thread; False if the loop must send.

        Waking the loop takes longer than sending.
        """
        outs = self._direct
        if threading.get_ident() in self._loop.loop_threads or not self._send_lock.acquire(False):
            return False
        try:
            if not outs or outs is not self._direct or self._is_flush_scheduled or self._outbox:
                return False
            for out in outs:
                if out.is_congested:
                    return False
            if self.latch:
                self._latched = message
            self.published += 1
            try:
                framed = self._frame(message)
            except ENCODING_ERRORS:
                framed = self._framed(message)
            if framed is not None:
                for out in outs:
                    out.send([framed], self._queue_size)
            return True
        finally:
            self._send_lock.release()

    def _flush(self) -> None:
        frames: list[Pieces] = []
        count = size = 0
        outbox, links = self._outbox, self._subscriber_links
        self._is_flush_scheduled = True  # prevents direct sending meanwhile
        try:
            while outbox and count < _BATCH_MESSAGES and size < _BATCH_BYTES and not links.is_congested:
                message = outbox.popleft()
                count += 1
                if self.latch:
                    self._latched = message
                self.published += 1
                framed = self._framed(message) if links.remote else None
                if framed is not None:
                    frames.append(framed)
                    size += sum(map(len, framed))
                for subscriber in list(links.local):
                    self._deliver(message, subscriber, framed)
            if frames:
                for link in list(links.remote):
                    link.out.send(frames, self._queue_size)
        finally:
            # In this order: a message added in between is seen here or by its own publish().
            self._is_flush_scheduled = False
            if outbox and not self._is_flush_scheduled and not links.is_congested:
                self._flush_soon()

    def _flush_soon(self) -> None:
        self._is_flush_scheduled = True
        self._loop.deliver_soon(self._flush)

    def _deliver(self, message: Any, subscriber: LocalSubscriber, framed: Pieces | None) -> None:
        if not subscriber.is_raw and not isinstance(message, _BYTES):
            subscriber.receive(message, from_outside=self.is_outside)
            return
        framed = self._framed(message) if framed is None else framed
        if framed is not None:
            subscriber.receive_bytes(b"".join((framed[0][LENGTH.size :], *framed[1:])), self)

    def _framed(self, message: Any) -> Pieces | None:
        """Serialize a message with its length prefix."""
        if isinstance(message, _BYTES):
            return LENGTH.pack(len(message)), bytes(message)  # pyright: ignore[reportUnknownArgumentType]
        assert self._codec is not None
        try:
            return self._codec.frame(message)
        except MessageError as error:
            self._node.log.error(f"a message on {self.topic} is not sent: {error}")
            return None

    def _checked(self, message: Message | dict[str, Any] | bytes) -> Any:
        """Message to send: bytes, or an object of the topic's type."""
        if isinstance(message, _BYTES):
            return message  # pyright: ignore[reportUnknownVariableType]
        if isinstance(message, Mapping):
            return self._checked(self._node.new(self.type, dict(message)))  # pyright: ignore[reportUnknownArgumentType]
        message_type = self._node.messages.type_of(message)
        if message_type != self.type:
            raise MessageError(f"{self.topic} carries {self.type}, got a {message_type}")
        self._class, self._has_header = type(message), hasattr(message, "header")
        self._codec = self._node.messages.codec(message_type)
        self._frame = self._codec.exact_frame
        return message
