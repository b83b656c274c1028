"""Records topics of a running graph into bags."""

import asyncio
import contextlib
import re
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ..errors import RosError
from ..messages.raw_message import RawMessage
from ..node.clock import Clock, WallClock
from ..node.graph_node import Node
from ..node.subscription import Subscription
from ..xmlrpc.rpc_client import call_value
from ..xmlrpc.xmlrpc_text import FaultError
from .bag import BagConnection, BagMessage, BagWriter, recording_failure
from .files import create_bag, lock_bag
from .step_recorder import compressed_copies

_FLUSH_S = 1.0
"""Interval between flushes [s]; SIGKILL loses at most the messages of this time."""
_LIMIT_POLL_S = 0.25
"""Poll interval of time limits while no messages arrive."""
_POLL_S = 0.5
"""Poll interval for new topics."""
_WARN_S = 5.0
"""Minimum interval of warnings about dropped messages."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecorderOptions:
    """Topics and files of a recording."""

    topics: tuple[str, ...] = ()
    """Names or regular expressions; the bag gets names before remapping."""
    is_regex: bool = False
    all_topics: bool = False
    exclude: str = ""
    """Regular expression of topics to exclude."""
    without_types: frozenset[str] = frozenset()
    """Message types to exclude, except of topics listed by name."""
    without_copies: bool = False
    """Leave out compressed images whose raw ones are published, too; see `compressed_copies`."""
    of_node: str | None = None
    """Record all topics this node subscribes to."""
    path: Path | None = None
    """Output file; derived from `prefix` and the date if None."""
    prefix: str = ""
    suffix: str = ".bag"
    compression: str = "none"
    chunk_bytes: int = 768 * 1024
    buffer_bytes: int = 256 * 1024 * 1024
    """Queue limit; the oldest messages are dropped. 0: unlimited."""
    limit: int = 0
    """Messages to record per topic; 0: unlimited."""
    splits: bool = False
    max_bytes: int = 0
    max_ns: int = 0
    """Size and duration at which the next file begins if `splits`, else recording stops; 0: unlimited."""
    max_splits: int = 0
    """Files to keep; 0: all."""
    tcp_nodelay: bool = False
    repeats_latched: bool = False
    """Repeat the last message of each latched topic at the start of each file."""
    announces: bool = False
    """Publish each file's name on `begin_write`."""


class Recorder:
    """Subscribes to topics as they appear and writes messages in a thread of its own."""

    def __init__(
        self,
        node: Node,
        options: RecorderOptions,
        *,
        log: Callable[[str], None],
        on_failure: Callable[[str], None] = lambda _: None,
    ) -> None:
        """Create; `start` subscribes.

        Args:
            node: node that subscribes.
            options: topics and files.
            log: called with progress messages, in rosbag's words.
            on_failure: called with the reason as soon as recording fails.
        """
        self._node = node
        self._options = options
        self._log = log
        self._on_failure = on_failure
        self._patterns = [re.compile(topic) for topic in options.topics] if options.is_regex else []
        self._excluded = re.compile(options.exclude) if options.exclude else None
        self._subscriptions: dict[str, Subscription] = {}
        self._remaining: dict[str, int] = {}
        self._connections: dict[tuple[str, str, str, bool], BagConnection] = {}
        self._latched: dict[BagConnection, BagMessage] = {}
        self._queue: deque[BagMessage] = deque()
        self._queued_bytes = 0
        self._wake = threading.Condition()
        self._warned_s = 0.0
        self._is_ending = False
        self._files: list[Path] = []
        self._file_count = 0
        self._begin_write = node.advertise("begin_write", "std_msgs/String", latch=True) if options.announces else None
        self._thread = threading.Thread(target=self._write_all, name="trundle-record", daemon=True)
        self.error: str | None = None
        """Reason why recording failed, if it did."""
        self.done = threading.Event()
        """Set when a limit is reached or writing fails."""
        self.recorded = 0
        self.dropped = 0

    @property
    def files(self) -> list[Path]:
        """Completed files."""
        return list(self._files)

    @property
    def clock(self) -> Clock:
        """ROS time."""
        return self._node.clock

    def start(self) -> None:
        """Open the first file and subscribe.

        Raises:
            BagError: it cannot be written, or another program writes it.
        """
        self._start_ns = self.clock.now_ns()
        self._writer = self._open()
        self._thread.start()
        options = self._options
        if not options.is_regex:
            # On the loop: a latched message must not arrive before its subscription is stored.
            for topic in options.topics:
                self._node.loop.call_soon(lambda topic=topic: self._subscribe(topic))
        if options.is_regex or options.all_topics or options.of_node:
            self._node.loop.spawn(self._follow_topics())

    def stop(self) -> None:
        """Write queued messages and close the file."""
        for subscription in list(self._subscriptions.values()):
            subscription.unregister()
        with self._wake:
            self._is_ending = True
            self._wake.notify()
        if self._thread.is_alive():
            self._thread.join()
        if self.dropped:
            self._node.log.warn(
                f"{self.dropped} messages came faster than they could be written and were dropped; a larger buffer "
                "(-b) or fewer topics may help"
            )

    # on the loop

    async def _follow_topics(self) -> None:
        """Subscribe to matching topics as they appear."""
        while not self._node.is_shut_down:
            with contextlib.suppress(RosError, OSError, FaultError):
                for topic in await self._topics():
                    if self._is_selected(topic):
                        self._subscribe(topic)
            await asyncio.sleep(_POLL_S)

    async def _topics(self) -> list[str]:
        node = self._options.of_node
        if node is not None:
            uri = await self._node.master.call("lookupNode", self._node.resolve(node))
            topics = await call_value(uri, "getSubscriptions", self._node.name)
        else:
            topics = await self._node.master.call("getPublishedTopics", "")
        copies = compressed_copies(topics) if self._options.without_copies else frozenset[str]()
        return [topic for topic, kind in topics if kind not in self._options.without_types and topic not in copies]

    def _is_selected(self, topic: str) -> bool:
        if topic in self._subscriptions or (self._excluded is not None and self._excluded.fullmatch(topic)):
            return False
        if self._options.all_topics or self._options.of_node is not None:
            return True
        return any(pattern.fullmatch(topic) for pattern in self._patterns)

    def _subscribe(self, topic: str) -> None:
        if topic in self._subscriptions:
            return
        self._log(f"Subscribing to {topic}")
        self._remaining[topic] = self._options.limit
        self._subscriptions[topic] = self._node.subscribe(
            topic,
            "*",
            lambda message: self._on_message(topic, message),
            queue_size=None,
            tcp_nodelay=self._options.tcp_nodelay,
            on_loop=True,
        )

    def _on_message(self, topic: str, message: RawMessage) -> None:
        stamp_ns = self.clock.now_ns()
        if stamp_ns == 0 or self.done.is_set():  # simulated time has not begun, or a limit is reached
            return
        if self._options.limit and self._remaining[topic] == 0:  # received before unsubscribing took effect
            return
        if "/" not in message.type or not message.md5sum:  # a publisher without type or md5 sum
            self.dropped += 1
            return
        key = (topic, message.md5sum, message.caller, message.latching)
        connection = self._connections.get(key)
        if connection is None:
            connection = self._connections[key] = BagConnection(
                topic=topic,
                type=message.type,
                md5sum=message.md5sum,
                definition=message.definition,
                caller=message.caller,
                latching=message.latching,
            )
        with self._wake:
            self._queue.append(BagMessage(connection, stamp_ns, bytes(message.data)))
            self._queued_bytes += len(message.data)
            while 0 < self._options.buffer_bytes < self._queued_bytes:
                self._queued_bytes -= len(self._queue.popleft().data)
                self.dropped += 1
                self._warn_of_drops()
            self._wake.notify()
        if self._options.limit:
            self._count_down(topic)

    def _count_down(self, topic: str) -> None:
        self._remaining[topic] -= 1
        if self._remaining[topic] == 0:
            self._subscriptions[topic].unregister()
            if not any(self._remaining.values()):
                self.done.set()

    def _warn_of_drops(self) -> None:
        if time.monotonic() - self._warned_s > _WARN_S:
            self._warned_s = time.monotonic()
            self._node.log.warn("rosbag record buffer exceeded.  Dropping oldest queued message.")

    # -- in the writer thread

    def _write_all(self) -> None:
        try:
            try:
                self._write_loop()
            except RosError as error:
                self._abort(str(error))
            if self._is_open:
                self._close()
        except OSError as error:
            self._writer.abandon()
            self._lock.release()
            self._abort(recording_failure(self._active, error))

    def _abort(self, reason: str) -> None:
        self.error = reason
        self._on_failure(f"recording failed: {reason}")
        self.done.set()

    def _write_loop(self) -> None:
        flushed = time.monotonic()
        while True:
            with self._wake:
                self._wake.wait_for(lambda: self._queue or self._is_ending, timeout=_LIMIT_POLL_S)
                batch, self._queue = self._queue, deque()
                self._queued_bytes = 0
                is_last = self._is_ending
            for message in batch:
                self._next_file_if_due(message.stamp_ns, by_size=True)
                if self.done.is_set() and not self._options.limit:
                    return
                self._write(message)
            if not batch:  # time limits apply without messages, too
                self._next_file_if_due(self.clock.now_ns(), by_size=False)
                if self.done.is_set() and not self._options.limit:
                    return
            if time.monotonic() - flushed >= _FLUSH_S:
                self._writer.flush()
                self._active.stat()  # raises if the file was removed, since writes to it would still succeed
                flushed = time.monotonic()
            if is_last:
                return

    def _write(self, message: BagMessage) -> None:
        self._writer.write(message)
        self.recorded += 1
        if self._options.repeats_latched and message.connection.latching:
            self._latched[message.connection] = message

    def _next_file_if_due(self, stamp_ns: int, *, by_size: bool) -> None:
        options = self._options
        self._start_ns = self._start_ns or stamp_ns  # simulated time may begin only now
        is_long = 0 < options.max_ns < stamp_ns - self._start_ns
        is_large = by_size and options.max_bytes and self._writer.size > options.max_bytes
        if not (is_long or is_large):
            return
        if not options.splits:
            self.done.set()
            return
        if is_long:
            self._start_ns += (stamp_ns - self._start_ns) // options.max_ns * options.max_ns
        self._log(f"Closing '{self._path}'.")
        self._close()
        while options.max_splits and len(self._files) >= options.max_splits:
            self._files.pop(0).unlink(missing_ok=True)
        self._writer = self._open()
        for message in self._latched.values():
            self._writer.write(BagMessage(message.connection, stamp_ns, message.data))

    def _open(self) -> BagWriter:
        self._path = self._name()
        self._active = self._path.with_name(f"{self._path.name}.active")
        self._is_open = False
        self._lock = lock_bag(self._path)
        self._active.unlink(missing_ok=True)
        writer = create_bag(self._active, compression=self._options.compression, chunk_bytes=self._options.chunk_bytes)
        self._is_open = True
        self._log(f"Recording to '{self._path}'.")
        if self._begin_write is not None:
            self._begin_write.publish({"data": str(self._path)})
        return writer

    def _close(self) -> None:
        self._writer.close()
        self._active.replace(self._path)
        self._lock.release()
        self._files.append(self._path)

    def _name(self) -> Path:
        """File name as in rosbag: NAME.bag or PREFIX_date.bag, numbered if splitting."""
        options = self._options
        number = f"_{self._file_count}" if options.splits else ""
        self._file_count += 1
        if options.path is not None:
            suffix = options.path.suffix if options.path.suffix in (".bag", ".mcap") else ""
            stem = str(options.path)[: len(str(options.path)) - len(suffix)]
            return Path(f"{stem}{number}{suffix or options.suffix}")
        date = time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(WallClock().now_ns() / 1e9))
        return Path(
            "_".join(part for part in (options.prefix.removesuffix(".bag"), date) if part) + number + options.suffix
        )
