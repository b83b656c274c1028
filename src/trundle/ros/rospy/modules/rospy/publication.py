"""Published topic: its publisher on the graph, shared by all `rospy.Publisher` of the topic."""

import threading
import time
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any

from trundle.ros import _message_codec
from trundle.ros.node.graph_node import Node
from trundle.ros.node.local_graph import LocalSubscriber
from trundle.ros.node.publisher import Publisher as GraphPublisher
from trundle.ros.rospy.message_methods import codec, is_plain
from trundle.ros.transport.framing import Pieces
from trundle.ros.transport.send_queue import SendQueue
from trundle.ros.transport.tcpros import FrameProtocol

from . import core, graph
from .msg import framed

_CONGESTED_S = 0.0002
_SHUTDOWN_CHECK_S = 0.1


class SubscribeListener:
    """Base class of listeners of a publisher's connections."""

    def peer_subscribe(
        self, topic_name: str, topic_publish: Callable[[Any], object], peer_publish: Callable[[Any], object]
    ) -> None:
        """Called when a subscriber connects.

        Args:
            topic_name: global name.
            topic_publish: publishes to all subscribers.
            peer_publish: publishes to the new one.
        """

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        """Called when a subscriber has disconnected; `num_peers` are left."""


class Publication:
    """A topic that this node publishes."""

    def __init__(self, topic: str, data_class: Any) -> None:
        self.resolved_name = self.name = topic
        self.data_class = data_class
        self.type = data_class._type
        self.queue_size: float | None = None
        self.is_latch = False
        self.latch: Any = None
        self.headers: dict[str, str] = {}
        self.subscriber_listeners: list[SubscribeListener] = []
        self.ref_count = 0
        self.closed = False
        plain_codec = codec(data_class) if is_plain(data_class) else None
        self.sender = _message_codec.DirectSender(data_class, plain_codec, data_class._has_header)
        """Fast path: sends short messages while none wait, and numbers all messages."""
        self._turn = threading.RLock()
        """Held while a message is numbered and sent."""
        self._publisher: FramePublisher | None = None
        self._calls: SimpleQueue[Callable[[], None]] | None = None

    def start(self, node: Node) -> None:
        """Advertise."""
        publisher = FramePublisher(node, self)

        def create() -> GraphPublisher:
            return publisher

        node.endpoints.add_publisher(self.resolved_name, self.type, create)
        self._publisher = publisher

    def configure(
        self,
        *,
        listener: SubscribeListener | None,
        latch: bool,
        headers: dict[str, str] | None,
        queue_size: float | None,
    ) -> None:
        """Apply the options of a `rospy.Publisher`."""
        if listener is not None:
            self.subscriber_listeners.append(listener)
            if self._calls is None:
                self._calls = SimpleQueue()
                threading.Thread(target=self._call_listeners, name="rospy-listeners", daemon=True).start()
        self.is_latch |= latch
        self.sender.is_active = False
        self.headers.update(headers or {})
        if queue_size is not None:
            self.queue_size = queue_size
        if self._publisher is not None:
            self._publisher.configure()

    @property
    def seq(self) -> int:
        """Number of messages so far."""
        return self.sender.sequence

    @property
    def limit(self) -> int | None:
        """Number of messages kept for a slow subscriber; None: unlimited, also for a queue_size of 0 or less."""
        return None if self.queue_size is None or self.queue_size <= 0 else max(int(self.queue_size), 1)

    def get_num_connections(self) -> int:
        """Number of subscribers."""
        return 0 if self._publisher is None else self._publisher.subscribers

    def has_connections(self) -> bool:
        """True if there are subscribers."""
        return self.get_num_connections() > 0

    def publish(self, message: Any) -> None:
        """Send a message to all subscribers.

        Raises:
            genpy.SerializationError: a field's value does not fit.
        """
        publisher = self._publisher
        if publisher is None or self.closed:
            return
        with self._turn:
            if self.is_latch:
                self.latch = message
            elif not publisher._subscriber_count:
                return
            self.sender.is_active = False  # the lock makes other threads' messages come after this one
            self.sender.sequence += 1
            is_ahead = publisher.publish_frame(framed(self.sender.sequence, message))
            self.sender.is_active = publisher.sends_directly
        if is_ahead:  # else a thread that only replaces messages would keep the GIL from the sending thread
            time.sleep(_CONGESTED_S)
        self._wait_for_slowest(publisher)

    def send_rest(self) -> None:
        """Queue the rest of a message that was sent in part."""
        if self._publisher is not None:
            self._publisher.send_rest()
            self._wait_for_slowest(self._publisher)

    def _wait_for_slowest(self, publisher: "FramePublisher") -> None:
        """Without a queue, publishing waits for the slowest subscriber."""
        while self.queue_size is None and publisher.is_congested and not core.is_shutdown():
            publisher.wait_for_room()

    def connected(self, send: Callable[[Pieces], object]) -> None:
        """Call the listeners about a new subscriber, to which `send` sends; on the loop."""

        def publish(message: Any) -> None:
            with self._turn:
                self.sender.sequence += 1
                send(framed(self.sender.sequence, message))

        self._call(lambda listener: listener.peer_subscribe(self.resolved_name, self.publish, publish))

    def disconnected(self) -> None:
        """Call the listeners about a subscriber that has disconnected; on the loop."""
        left = self.get_num_connections()
        self._call(lambda listener: listener.peer_unsubscribe(self.resolved_name, left))

    def close(self) -> None:
        """Stop publishing."""
        self.closed = True
        self.sender.is_active = False
        graph.forget_starter(self.start)
        if self._publisher is not None:
            self._publisher.unregister()
            if not core.is_shutdown():
                graph.wait_registered()

    def _call(self, function: Callable[[SubscribeListener], object]) -> None:
        if self._calls is not None:
            for listener in list(self.subscriber_listeners):
                self._calls.put(lambda listener=listener: function(listener))  # pyright: ignore[reportArgumentType]

    def _call_listeners(self) -> None:
        assert self._calls is not None
        while True:
            call = self._calls.get()
            try:
                call()
            except Exception:
                core.logerr("bad subscribe listener", exc_info=True)


class FramePublisher(GraphPublisher):
    """Publisher of messages that are serialized already: pieces with the length first."""

    def __init__(self, node: Node, publication: Publication) -> None:
        cls = publication.data_class
        super().__init__(
            node,
            publication.resolved_name,
            publication.type,
            latch=publication.is_latch,
            queue_size=publication.limit,
            on_connect=None,
            raw_type=(cls._md5sum, cls._full_text),
            unregister=node.endpoints.remove_publisher,
        )
        self._room = threading.Condition()
        """Notified when a subscriber that read too slowly has read on."""
        self._publication = publication
        self._frame = self._framed

    def configure(self) -> None:
        """Apply changed options."""
        from collections import deque

        self.latch = self._publication.is_latch
        self._queue_size = self._publication.limit
        self._outbox = deque(self._outbox, maxlen=self._queue_size)

    @property
    def sends_directly(self) -> bool:
        """True if a message that is published now may be written to the sockets of all subscribers."""
        return bool(self._direct) and not (self.latch or self._is_flush_scheduled or self._outbox)

    def publish_frame(self, pieces: Pieces) -> bool:
        """Send a serialized message if there are subscribers or the topic is latched; thread-safe.

        Returns True if it replaced a message that had not been sent yet.
        """
        lost = self._lost
        self._send(pieces)
        return self._lost > lost

    def send_rest(self) -> None:
        """Queue the unsent rest of the last message; thread-safe."""
        for out in self._direct:
            out.send_rest()

    def wait_for_room(self) -> None:
        """Wait while every subscriber reads too slowly, or a short time."""
        with self._room:
            if self.is_congested:
                self._room.wait(_SHUTDOWN_CHECK_S)

    def resume(self) -> None:
        super().resume()
        with self._room:
            self._room.notify_all()

    def header_fields(self) -> dict[str, str]:
        return {**super().header_fields(), **self._publication.headers}

    def accept(self, link: FrameProtocol, header: dict[str, str]) -> None:
        super().accept(link, header)
        if link in self._subscriber_links.remote:
            self._publication.connected(lambda pieces: link.out.send([pieces], None))

    def release(self, link: FrameProtocol) -> None:
        was_remote = link in self._subscriber_links.remote
        super().release(link)
        if was_remote:
            self._publication.disconnected()

    def attach(self, subscriber: LocalSubscriber, name: str) -> None:
        super().attach(subscriber, name)
        loop = self._node.loop
        self._publication.connected(lambda pieces: loop.call_soon(lambda: self._deliver(pieces, subscriber, None)))

    def detach(self, subscriber: LocalSubscriber) -> None:
        super().detach(subscriber)
        self._publication.disconnected()

    def _send_directly_to(self, outs: tuple[SendQueue, ...]) -> None:
        super()._send_directly_to(outs)
        sender = self._publication.sender
        sender.is_active = False
        sender.sockets = [out.direct for out in outs]

    def _checked(self, message: Any) -> Any:
        return message

    def _framed(self, message: Any) -> Pieces | None:
        return message

    def _deliver(self, message: Any, subscriber: LocalSubscriber, framed: Pieces | None) -> None:
        subscriber.receive_bytes(b"".join(message)[4:], self)
