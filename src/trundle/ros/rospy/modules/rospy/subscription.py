"""Subscribed topic: its subscription on the graph, shared by all `rospy.Subscriber` of the topic.

A thread of the topic reads its sockets, deserializes the messages and calls the callbacks: a message wakes one thread,
slow callbacks of one topic do not delay those of others, and messages that are dropped cost nothing.
"""

import logging
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from itertools import repeat
from typing import Any, Protocol

from trundle.ros import _message_codec
from trundle.ros.node.graph_node import Node
from trundle.ros.node.local_graph import LocalPublisher
from trundle.ros.node.loop import SLICE_NS
from trundle.ros.node.publisher import Publisher as GraphPublisher
from trundle.ros.node.subscription import Subscription as GraphSubscription
from trundle.ros.rospy.message_methods import codec, has_only_bytes, is_plain
from trundle.ros.transport.tcpros import FrameProtocol, SocketSelector
from trundle.ros.transport.thread_selector import ThreadSelector

from . import core, graph
from .exceptions import ROSException

_NO_STATISTICS = ("/clock", "/statistics")
_FRAME = 4
"""Bytes of a message's length on the wire."""
_MAX_WAITING_BYTES = 256 * 1024 * 1024
"""Limit of messages queued here for slow callbacks; others wait at their publishers, as the original's do."""
_READ_S = 0.001
"""Interval of reading while messages wait."""
_MAX_READS = 100
"""Limit of readings before the next callback."""
_SLOW_S = 0.1
"""Duration of callbacks after which the loop reads: sockets hold the messages of a shorter time."""
_Callback = tuple[Callable[..., object], Any]


class Statistics(Protocol):
    """Statistics of a topic's messages."""

    def callback(self, message: Any, publisher: str, size: int) -> None:
        """Count a message of a publisher [bytes on the wire]."""

    def shutdown(self) -> None:
        """Stop."""


open_statistics: Callable[[str], Statistics | None] | None = None
"""Returns the statistics of a topic, None to count none; set by the node."""


class _ReadMessage:
    """A message deserialized where it arrived."""

    __slots__ = ("message", "size")

    def __init__(self, message: Any, size: int) -> None:
        self.message = message
        self.size = size
        """Length of the serialized message [bytes]."""

    def __len__(self) -> int:
        return self.size


_Data = bytes | memoryview | _ReadMessage


class Subscription:
    """A topic that this node subscribes to."""

    def __init__(self, topic: str, data_class: Any) -> None:
        self.resolved_name = self.name = topic
        self.data_class = data_class
        self.type = data_class._type
        self.md5sum = data_class._md5sum
        self.callbacks: list[_Callback] = []
        self.queue_size: int | None = None
        self.buff_size = 65536
        self.tcp_nodelay = False
        self.ref_count = 0
        self.closed = False
        self._lock = threading.RLock()
        self._waiting: deque[tuple[_Data, Mapping[str, str]]] = deque()
        """Messages for the callbacks, with their connection headers."""
        self._waiting_bytes = 0
        self._queue_lock = threading.Lock()
        """Guards both: messages of this process come from the loop."""
        self._read_s = time.monotonic()
        """Time of the last reading."""
        self.is_read_by_loop = False
        """True while callbacks are slow: sockets hold few messages."""
        self.selector: ThreadSelector
        """Selector of the topic's thread; set by `start`."""
        self._latched: dict[str, Any] = {}
        """Publisher → its latched message, for callbacks added later."""
        self._subscription: ByteSubscription | None = None
        self._thread: threading.Thread | None = None

    def start(self, node: Node) -> None:
        """Subscribe."""
        self.selector = ThreadSelector()
        self._thread = threading.Thread(target=self._run, name=f"rospy {self.resolved_name}", daemon=True)
        self._thread.start()
        self._subscription = ByteSubscription(node, self)
        node.endpoints.add_subscription(self._subscription)

    def get_num_connections(self) -> int:
        """Number of publishers."""
        return 0 if self._subscription is None else self._subscription.publishers

    def set_queue_size(self, queue_size: Any) -> None:
        """Set how many messages wait for callbacks; None or -1: no limit.

        Raises:
            ROSException: zero, or not an integer.
        """
        if queue_size == 0:
            raise ROSException("queue size may not be set to zero")
        if queue_size is not None and type(queue_size) is not int:
            raise ROSException("queue size must be an integer")
        self.queue_size = None if queue_size == -1 else queue_size

    def set_buff_size(self, buff_size: Any) -> None:
        """Check a buffer's size; messages of any size are received.

        Raises:
            ROSException: not a positive integer.
        """
        if type(buff_size) is not int:
            raise ROSException("buffer size must be an integer")
        if buff_size <= 0:
            raise ROSException("buffer size must be a positive integer")
        self.buff_size = buff_size

    def set_tcp_nodelay(self, tcp_nodelay: bool) -> None:
        """Ask publishers for TCP_NODELAY, which they have anyway on this machine."""
        self.tcp_nodelay = tcp_nodelay

    def add_callback(self, callback: Callable[..., object], callback_args: Any) -> None:
        """Add a callback; it gets latched messages at once.

        Raises:
            ROSException: the subscription is closed.
        """
        if self.closed:
            raise ROSException(f"subscriber [{self.resolved_name}] has been closed")
        with self._lock:
            self.callbacks = [*self.callbacks, (callback, callback_args)]
            latched = list(self._latched.values())
        for message in latched:
            self._call(message, callback, callback_args)

    def remove_callback(self, callback: Callable[..., object], callback_args: Any) -> None:
        """Remove a callback.

        Raises:
            KeyError: it was not added.
        """
        if self.closed:
            return
        with self._lock:
            for number, (registered, arguments) in enumerate(self.callbacks):
                if registered == callback and arguments is callback_args:
                    self.callbacks = [*self.callbacks[:number], *self.callbacks[number + 1 :]]
                    return
        raise KeyError("no matching cb")

    def receive(self, messages: Sequence[_Data], header: Mapping[str, str]) -> None:
        """Queue messages for the callbacks; on the topic's thread or the loop."""
        with self._queue_lock:
            if (size := self.queue_size) is not None:
                messages = messages[-size:]
                while self._waiting and len(self._waiting) + len(messages) > size:
                    self._waiting_bytes -= len(self._waiting.popleft()[0])
            self._waiting.extend(zip(messages, repeat(header)))
            self._waiting_bytes += sum(map(len, messages))
        self.selector.wake()
        if self.is_read_by_loop and self._waiting_bytes > _MAX_WAITING_BYTES:
            self._leave_to_loop(False)

    def _next(self) -> tuple[_Data, Mapping[str, str]] | None:
        """Read the sockets and return the next message with its header; None at the end."""
        took_s = time.monotonic() - self._read_s
        while not self.closed:
            self._read(took_s)
            with self._queue_lock:
                if self._waiting:
                    message = self._waiting.popleft()
                    self._waiting_bytes -= len(message[0])
                    return message
        return None

    def _read(self, took_s: float) -> None:
        """Read what the sockets hold, unless that was a moment ago; wait for it if no message waits.

        Args:
            took_s: duration of the callbacks since the last reading [s]; the same after a wait that ended without a
                message, such as of one that the loop read first.
        """
        if self._waiting and took_s < _READ_S:
            return
        has_room = self._waiting_bytes <= _MAX_WAITING_BYTES
        self._leave_to_loop(took_s > _SLOW_S and has_room)
        if has_room:
            self.selector.is_waiting = True  # from now on, messages of the loop and the end wake this thread
            timeout = 0.0 if self._waiting or self.closed else None
            for _ in range(_MAX_READS if self.queue_size is not None and took_s > _READ_S else 1):  # to the newest
                if not self.selector.read(timeout):
                    break
                timeout = 0.0
        self._read_s = time.monotonic()

    def _leave_to_loop(self, is_left: bool) -> None:
        """Have the loop read the sockets, or the topic's thread again; on either."""
        if is_left != self.is_read_by_loop and self._subscription is not None:
            self.is_read_by_loop = is_left
            self._subscription.select_soon()

    def close(self) -> None:
        """Unsubscribe."""
        self.closed = True
        self.callbacks = []
        graph.forget_starter(self.start)
        if self._subscription is not None:
            self.selector.wake()
            self._subscription.unregister()
            if not core.is_shutdown():
                graph.wait_registered()

    def _run(self) -> None:
        _message_codec.request_time_slice(SLICE_NS)  # a message would wait for busy threads here, too
        read = self.reader
        statistics = self._open_statistics()
        while (entry := self._next()) is not None:
            data, header = entry
            try:
                message = data.message if isinstance(data, _ReadMessage) else read(data)
            except Exception as error:
                logging.getLogger("rospy.topics").error("%s: cannot deserialize: %s", self.resolved_name, error)
                continue
            message._connection_header = header
            if statistics is not None:
                statistics.callback(message, header.get("callerid", ""), len(data) + _FRAME)
            if header.get("latching") == "1":
                callbacks = self._latch(header.get("callerid", ""), message)
            else:
                callbacks = self.callbacks
            for callback, arguments in callbacks:
                self._call(message, callback, arguments)
        if statistics is not None:
            statistics.shutdown()
        self.selector.close()

    def _latch(self, publisher: str, message: Any) -> list[_Callback]:
        """Keep a message for callbacks added later; return the current ones."""
        with self._lock:
            self._latched[publisher] = message
            return self.callbacks

    def _open_statistics(self) -> Statistics | None:
        """Statistics of the topic, if enabled when it is subscribed to."""
        if open_statistics is None or self.resolved_name in _NO_STATISTICS:
            return None
        try:
            return open_statistics(self.resolved_name)
        except Exception:  # no master, a node that shuts down
            return None

    @cached_property
    def reader(self) -> Callable[[bytes | memoryview], Any]:
        """Function that deserializes a message."""
        cls = self.data_class
        if is_plain(cls):
            return codec(cls).read
        return lambda data: cls().deserialize(bytes(data))

    def _call(self, message: Any, callback: Callable[..., object], arguments: Any) -> None:
        try:
            if arguments is None:
                callback(message)
            else:
                callback(message, arguments)
        except Exception:
            text = f"bad callback: {callback}\n{traceback.format_exc()}"
            if core.is_shutdown():
                logging.getLogger("rospy.topics").warning("during shutdown, %s", text)
            else:
                core.logerr(text)


class ByteSubscription(GraphSubscription):
    """Subscription that passes on bytes; its requests carry the real message type."""

    def __init__(self, node: Node, subscription: Subscription) -> None:
        super().__init__(
            node,
            subscription.resolved_name,
            subscription.type,
            lambda _: None,
            queue_size=subscription.queue_size,
            tcp_nodelay=subscription.tcp_nodelay,
            on_loop=True,
            unregister=node.endpoints.remove_subscription,
        )
        self.is_raw = True
        self.selector: SocketSelector = subscription.selector
        self._subscription = subscription
        self._read = subscription.reader if has_only_bytes(subscription.data_class) else None
        self._local_header: tuple[LocalPublisher, dict[str, str]] | None = None

    @property
    def md5sum(self) -> str:
        return self._subscription.md5sum

    def select_soon(self) -> None:
        """Have the sockets read by the topic's thread, or by the loop; thread-safe."""
        self._node.loop.call_soon(self._select)

    def _select(self) -> None:
        is_read_by_loop = self._subscription.is_read_by_loop
        self.selector = self._node.loop.selector if is_read_by_loop else self._subscription.selector
        for link in self._links.values():
            if isinstance(link, FrameProtocol):
                link.read_through(self.selector)

    def receive_data(self, data: bytes | memoryview, header: Mapping[str, str], *, from_outside: bool = True) -> None:
        del from_outside
        self.receive_batch([data], header)

    def receive_batch(self, messages: Sequence[Any], header: Mapping[str, str]) -> None:
        self.received += len(messages)
        self._subscription.receive(messages, header)

    def copy(self, view: memoryview) -> Any:
        """Deserialize a message whose long arrays are bytes: as fast as a copy, and in its place."""
        if self._read is not None:
            try:
                return _ReadMessage(self._read(view), len(view))
            except (BufferError, ValueError):  # the topic's thread reports it
                pass
        return bytes(view)

    def receive_bytes(self, data: bytes, publisher: LocalPublisher) -> None:
        if self._local_header is None or self._local_header[0] is not publisher:
            fields = publisher.header_fields() if isinstance(publisher, GraphPublisher) else {}
            self._local_header = publisher, fields
        self.receive_data(data, self._local_header[1])

    def _request(self) -> dict[str, str]:
        return {**super()._request(), "message_definition": self._subscription.data_class._full_text}
