"""Publishes the messages of bags in recorded time."""

import heapq
import re
import struct
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass

from ..messages.raw_message import RawMessage
from ..node.graph_node import Node
from ..node.publisher import Publisher
from .bag import BagConnection, BagMessage, BagReader

_HEADER_FIRST = re.compile(r"(\s|#.*\n)*(std_msgs/)?Header\s")
_SLEEP_S = 0.05
"""Maximum delay of the reaction to pausing and key presses [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlayerOptions:
    """Topics and timing of playback."""

    rate: float = 1.0
    start_s: float = 0.0
    """Offset into the bags [s]."""
    duration_s: float | None = None
    topics: frozenset[str] = frozenset()
    """Topics to play; empty: all."""
    pause_topics: frozenset[str] = frozenset()
    """Topics of which each message pauses playback before it is published."""
    prefix: str = ""
    """Prepended to each topic as written: `foo` turns /scan into /foo/scan, and scan into fooscan."""
    clock_hz: float | None = None
    """Rate of /clock in wall time [Hz]."""
    immediate: bool = False
    queue_size: int = 100
    """Queue size per publisher; 0: unlimited."""
    skip_empty_s: float | None = None
    """Longer gaps between messages are skipped [s]."""
    rate_control_topic: str | None = None
    """Playback waits for the header stamps of this topic."""
    rate_control_s: float = 1.0
    """Maximum lag of the rate control topic [s]."""


class Player:
    """Plays bags merged by time."""

    def __init__(self, node: Node, bags: Sequence[BagReader], options: PlayerOptions) -> None:
        self._node = node
        self._bags = bags
        self._options = options
        self._publishers: dict[BagConnection, Publisher] = {}
        self._latched: dict[Publisher, dict[str, bytes]] = {}
        """Latched messages of a topic, by the node that published them during the recording."""
        self._clock: Publisher | None = None
        self._clock_due_s = 0.0
        self._pace = _PlaybackClock(options.rate, 0)
        self.is_paused = False
        self.uses_pause_topics = True
        """False: `pause_topics` are ignored."""
        self.steps = 0
        """Messages to play while paused."""
        self.played = 0
        self.now_ns = 0
        """Bag time [ns]."""
        first = min((bag.start_ns for bag in bags if any(bag.counts)), default=0)
        last = max((bag.end_ns for bag in bags), default=0)
        self.start_ns = first + round(options.start_s * 1e9)
        self._follower_ns = self.start_ns
        """Newest stamp of the rate control topic [ns]."""
        self.end_ns = last if options.duration_s is None else self.start_ns + round(options.duration_s * 1e9)

    @property
    def is_empty(self) -> bool:
        """True if no message is selected."""
        return next(self._messages(), None) is None

    def advertise(self) -> list[Publisher]:
        """Advertise all selected topics; latched ones get their last message before the start."""
        if self._options.clock_hz is not None:
            self._clock = self._node.advertise("/clock", "rosgraph_msgs/Clock", queue_size=1)
        if self._options.rate_control_topic is not None:
            self._node.subscribe(self._options.rate_control_topic, "*", self._on_rate_control, on_loop=True)
        latched = {c.topic for bag in self._bags for c in bag.connections if c.latching}
        for connection in (c for bag in self._bags for c in bag.connections):
            if self._is_selected(connection):
                self._publishers[connection] = self._node.advertise(
                    self._options.prefix + connection.topic,
                    connection.type,
                    latch=connection.topic in latched,
                    queue_size=self._options.queue_size or None,
                    raw_type=(connection.md5sum, connection.definition),
                )
        for message in self._latched_before():
            self._publish(message)
        return list(dict.fromkeys(self._publishers.values()))

    def play(self, poll: Callable[[], None]) -> None:
        """Play once, from the first message.

        Args:
            poll: called between messages and while waiting; may set `is_paused` and `steps`.
        """
        for i, message in enumerate(self._messages()):
            if i == 0:
                self._pace = _PlaybackClock(self._options.rate, message.stamp_ns)
                self.now_ns = self._follower_ns = message.stamp_ns
            self._wait_for(message, poll)
            self.now_ns = message.stamp_ns
            self._tick(at_once=self._options.immediate or self.is_paused)
            self._publish(message)
            self.played += 1

    def keep_alive(self, poll: Callable[[], None]) -> None:
        """Advance the clock after the end, for late subscribers."""
        while True:
            poll()
            if self.is_paused or self._options.immediate:
                self._pace.hold()
            else:
                self.now_ns = self._pace.now_ns()
            self._sleep(_SLEEP_S)

    def _wait_for(self, message: BagMessage, poll: Callable[[], None]) -> None:
        """Wait until a message is due."""
        options = self._options
        if self.uses_pause_topics and message.connection.topic in options.pause_topics:
            self.is_paused = True
        if options.skip_empty_s is not None and message.stamp_ns - self.now_ns > options.skip_empty_s * 1e9:
            self._pace.jump(message.stamp_ns)
        # Decided once: the rate control topic receives nothing in a gap, so its lag cannot shrink.
        is_ahead = self._is_ahead()
        while True:
            poll()
            is_ahead = is_ahead and self._is_ahead()
            if self.is_paused and self.steps > 0:
                self.steps -= 1
                self._pace.jump(message.stamp_ns)
                return
            if self.is_paused or is_ahead:
                self._pace.hold()
                self._sleep(_SLEEP_S)
                continue
            wait_s = 0.0 if options.immediate else self._pace.wait_s(message.stamp_ns)
            if wait_s <= 0.0:
                return
            self.now_ns = min(self._pace.now_ns(), message.stamp_ns)  # a busy machine may have slept past it
            self._sleep(wait_s)

    def _sleep(self, max_s: float) -> None:
        """Publish /clock if due, and sleep briefly."""
        self._tick()
        due_s = _SLEEP_S if self._clock is None else max(0.0, self._clock_due_s - time.monotonic())
        time.sleep(min(max_s, due_s, _SLEEP_S))

    def _tick(self, *, at_once: bool = False) -> None:
        """Publish /clock if it is due, or with `at_once` in any case."""
        if self._clock is None or not (at_once or time.monotonic() >= self._clock_due_s):
            return
        assert self._options.clock_hz is not None
        self._clock.publish(struct.pack("<II", *divmod(self.now_ns, 10**9)))
        self._clock_due_s = time.monotonic() + 1.0 / self._options.clock_hz

    def _publish(self, message: BagMessage) -> None:
        """Publish a message; late subscribers to a latched topic get the last message of each recorded publisher."""
        connection = message.connection
        publisher = self._publishers[connection]
        if connection.latching:
            latched = self._latched.setdefault(publisher, {})
            latched.pop(connection.caller, None)
            publisher.latched_for_others = tuple(latched.values())
            latched[connection.caller] = message.data
        publisher.publish(message.data)

    def _is_ahead(self) -> bool:
        if self._options.rate_control_topic is None:
            return False
        return self.now_ns - self._follower_ns > self._options.rate_control_s * 1e9

    def _on_rate_control(self, message: RawMessage) -> None:
        """Read the stamp of a message that starts with a header, whatever its type."""
        if not _HEADER_FIRST.match(message.definition) or len(message.data) < 12:
            self._node.log.warn(f"{message.type} does not start with a header; it cannot control the rate")
            return
        sec, nanosec = struct.unpack_from("<II", message.data, 4)
        self._follower_ns = sec * 10**9 + nanosec

    def _latched_before(self) -> list[BagMessage]:
        """Last latched messages before the start."""
        if self._options.start_s <= 0.0:
            return []
        last = {
            message.connection: message
            for bag in self._bags
            for message in bag.messages(lambda c: c.latching and self._is_selected(c), end_ns=self.start_ns - 1)
        }
        return list(last.values())

    def _messages(self) -> Iterator[BagMessage]:
        streams = [bag.messages(self._is_selected, start_ns=self.start_ns, end_ns=self.end_ns) for bag in self._bags]
        with ExitStack() as stack:
            for stream in streams:
                stack.callback(getattr(stream, "close", lambda: None))
            yield from heapq.merge(*streams, key=lambda message: message.stamp_ns)

    def _is_selected(self, connection: BagConnection) -> bool:
        return not self._options.topics or connection.topic in self._options.topics


class _PlaybackClock:
    """Maps wall time to bag time."""

    def __init__(self, rate: float, start_ns: int) -> None:
        self._rate = rate
        self._bag_ns = start_ns
        self._wall_s = time.monotonic()
        self._now_ns = start_ns

    def now_ns(self) -> int:
        """Bag time [ns]."""
        self._now_ns = self._bag_ns + round((time.monotonic() - self._wall_s) * self._rate * 1e9)
        return self._now_ns

    def wait_s(self, stamp_ns: int) -> float:
        """Wall time until a bag time [s]."""
        return (stamp_ns - self.now_ns()) / 1e9 / self._rate

    def hold(self) -> None:
        """Freeze bag time at the last `now_ns`."""
        self.jump(self._now_ns)

    def jump(self, ns: int) -> None:
        """Set bag time."""
        self._bag_ns, self._wall_s, self._now_ns = ns, time.monotonic(), ns
