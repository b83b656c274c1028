"""Playback of a bag on the page."""

import asyncio
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor

import msgspec
import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.ros import BagConnection, BagMessage, BagReader

from ..clients.channel import Channel, Client
from ..clients.hub import Hub
from ..clients.message_keys import MessageKeys
from ..clients.topic_channel import is_droppable
from ..playback import Playback
from ..requests.request import PageAction, Reset, Seek, Step
from ..wire import BagFile
from ..world.streams import STATE
from .lanes import LanesChannel
from .reader import BagCursor, is_latched

_STEP_NS = 100_000_000
"""Duration of a step [ns]."""
_MAX_STEPS = 1_000_000
"""Limit of steps in a bag, beyond which a step is longer: a stamp of zero makes a bag fifty years long."""
_MAX_READ_NS = 2_000_000_000
"""Limit of the span that is read at once [ns]; playback waits for slower reading."""
_PAUSE_S = 0.5
"""Interval between two polls beyond which playback does not advance: no client was connected."""
_STATE_PERIOD_S = 0.1
_CONDITION = "bag"


class BagTopic(Channel):
    """Channel of a bag's topic; a client gets the topic's state at subscription."""

    def __init__(self, connection: BagConnection) -> None:
        super().__init__(
            connection.topic,
            schema_name=connection.type,
            schema=connection.definition,
            is_droppable=is_droppable(connection.topic, connection.type) and not is_latched(connection),
        )
        self.md5sum = connection.md5sum
        self.has_new_client = False
        """True if a client has subscribed since the state was last sent."""

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        self.has_new_client = True


class BagState(Channel):
    """Clock of the playback."""

    def __init__(self, playback: Playback) -> None:
        super().__init__(STATE, encoding="json", trundle_only=True)
        self._playback = playback
        self._due_s = 0.0
        self._sent = b""

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        self._due_s, self._sent = 0.0, b""

    def send(self, now_s: float) -> None:
        """Send the state if it is due and has changed."""
        state = msgspec.json.encode(self._playback.state)
        if now_s >= self._due_s and state != self._sent:
            self._due_s, self._sent = now_s + _STATE_PERIOD_S, state
            self.publish(self._playback.time_ns, (state,))


class BagSource:
    """Plays one bag; used on the loop only, except for reading."""

    def __init__(self, bag: BagReader, options: BagFile, hub: Hub) -> None:
        """Advertise the topics of a bag, which has at least one message."""
        self._hub = hub
        step_ns = max(_STEP_NS, (bag.end_ns - bag.start_ns) // _MAX_STEPS)
        times_ns = np.arange(bag.start_ns, bag.end_ns, step_ns, dtype=np.int64)
        times_ns = np.append(times_ns, np.int64(bag.end_ns))
        self._playback = Playback(times_ns, speed=options.speed, paused=options.paused)
        self._state = BagState(self._playback)
        self._topics: dict[str, BagTopic] = {}
        for connection in bag.connections:
            self._topics.setdefault(connection.topic, BagTopic(connection))
        hub.add_channels([self._state, LanesChannel(bag.path), *self._topics.values()])
        self._cursor = BagCursor(bag)
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="trundle-bag")
        self._reading: asyncio.Task[None] | None = None
        self._sent_ns = self._playback.time_ns - 1
        self._jumped = True
        self._polled_s: float | None = None

    @property
    def time_ns(self) -> int:
        """Recorded time [ns]."""
        return self._playback.time_ns

    def handle(self, action: PageAction) -> None:
        """Execute a request.

        Raises:
            UsageError: a bag does not support it.
        """
        self._playback.handle(action)
        match action:
            case Seek() | Reset():
                self._jumped = True
            case Step(count) if count * _STEP_NS > _MAX_READ_NS:
                self._jumped = True
            case _:
                pass

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Advance the playback, and start reading the messages to send."""
        del time_ns
        elapsed_s = 0.0 if self._polled_s is None else now_s - self._polled_s
        self._polled_s = now_s
        self._playback.advance(elapsed_s if elapsed_s < _PAUSE_S else 0.0)
        self._state.send(now_s)
        if self._reading is None or self._reading.done():
            self._reading = asyncio.get_running_loop().create_task(self._show())
        return False

    async def _show(self) -> None:
        """Send the messages up to the current time; after a jump and for new clients, the state at that time."""
        watched = {topic for topic, channel in self._topics.items() if channel.clients}
        target_ns = self._playback.time_ns
        jumped = self._jumped or target_ns < self._sent_ns
        self._jumped = False
        if not jumped and target_ns - self._sent_ns > _MAX_READ_NS:
            target_ns = self._playback.time_ns = self._sent_ns + _MAX_READ_NS
        stale = watched if jumped else {topic for topic in watched if self._topics[topic].has_new_client}
        after_ns, self._sent_ns = self._sent_ns, target_ns
        for topic in stale:
            self._topics[topic].has_new_client = False
        messages = await self._read(frozenset(watched - stale), frozenset(stale), after_ns, target_ns)
        for message in messages:
            channel = self._topics[message.connection.topic]
            if message.connection.md5sum == channel.md5sum:
                keys = MessageKeys(channel.schema_name, "", message.data)
                channel.publish(message.stamp_ns, (message.data,), keys)

    async def _read(
        self, topics: frozenset[str], stale: frozenset[str], after_ns: int, until_ns: int
    ) -> Iterable[BagMessage]:
        def read() -> list[BagMessage]:
            state = self._cursor.read_state(stale, until_ns) if stale else []
            return state + (self._cursor.read(topics, after_ns, until_ns) if topics and until_ns > after_ns else [])

        try:
            return await asyncio.get_running_loop().run_in_executor(self._reader, read)
        except (TrundleError, OSError) as error:
            self._hub.set_condition(_CONDITION, f"the bag cannot be read further: {error}")
            return ()
