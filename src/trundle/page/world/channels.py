"""Channels of the owner's data: the simulated world, its poses, joints, lines and clock."""

from collections.abc import Sequence, Set

import msgspec
import numpy as np
from numpy.typing import NDArray

from ..clients.channel import Channel, Client
from ..clients.frames import Buffer
from ..clients.protocol import ENCODING
from ..mailbox import Mailbox
from .streams import (
    ARRAY_HEADER,
    CONTACTS,
    DIFFERENCES,
    JOINTS,
    LINES,
    PERFORMANCE,
    POSES,
    RANGES,
    SERIES,
    STATE,
    WORLD,
)

_XYZ_XYZW = [0, 1, 2, 4, 5, 6, 3]
"""Order of a pose's columns on the wire, as indices into x y z qw qx qy qz."""
_NO_GENERATION = -1


class WorldChannel(Channel):
    """Manifest and its files."""

    def __init__(self) -> None:
        super().__init__(WORLD, encoding="json", is_droppable=False, trundle_only=True)
        self.files: dict[str, bytes] = {}
        """URL → content."""
        self.generation = _NO_GENERATION
        self._manifest: bytes | None = None

    def set(self, manifest: bytes, generation: int, urls: Set[str]) -> None:
        """Replace the manifest, and remove the files that it does not name.

        Args:
            manifest: manifest as JSON.
            generation: world's generation.
            urls: URLs of the files in the manifest.
        """
        self.files = {url: content for url, content in self.files.items() if url in urls}
        self.generation = generation
        self._manifest = manifest
        self.publish(0, (manifest,))

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        if self._manifest is not None:
            client.send_message(self, 0, (self._manifest,))


class StreamChannel(Channel):
    """Channel fed by a mailbox; a client with a queued message gets the newest one later."""

    def __init__(self, topic: str, *, encoding: str, period_s: float, schema_name: str = "", schema: str = "") -> None:
        """Create it; messages are sent at most once per `period_s`."""
        super().__init__(
            topic, encoding=encoding, schema_name=schema_name, schema=schema, trundle_only=encoding != ENCODING
        )
        self._period_s = period_s
        self._due_s = 0.0
        self._mailbox: Mailbox | None = None
        self._read: bytes | None = None
        """Message that was read from the mailbox but not yet sent."""
        self._behind: set[Client] = set()
        """Clients that have not received the newest message in full."""

    def open(self, mailbox: Mailbox) -> None:
        """Replace the mailbox."""
        self._mailbox = mailbox

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        self._behind.add(client)

    def unsubscribe(self, client: Client) -> None:
        super().unsubscribe(client)
        self._behind.discard(client)

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Read the mailbox, and send the newest message if it is due; return True if there was a new one.

        Args:
            now_s: monotonic time [s].
            time_ns: message's time [ns].
        """
        if not self.clients:
            return False
        is_new = self.receive() is not None
        if self._read is not None and now_s >= self._due_s and self.is_current(self._read):
            self._due_s = max(self._due_s, now_s - self._period_s) + self._period_s
            change, self._read = self.encode_change(self._read), None
            for client in self.clients - self._behind:
                if client.is_waiting(self):
                    self.send_late(client, time_ns)
                else:
                    client.send_message(self, time_ns, change)
        ready = {client for client in self._behind if not client.is_waiting(self)}
        if ready and (whole := self.encode_whole()):
            for client in ready:
                client.send_message(self, time_ns, whole)
            self._behind -= ready
        return is_new

    def send_late(self, client: Client, time_ns: int) -> None:
        """Drop a new message for a client with a queued one; the client gets the newest one later."""
        del time_ns
        client.count_drop(self)
        self._behind.add(client)

    def put(self, message: bytes) -> None:
        """Send a message of the server's own with the next poll."""
        self._read = message

    def receive(self) -> bytes | None:
        """Read the mailbox; return a new message."""
        message = None if self._mailbox is None else self._mailbox.read()
        if message is not None:
            self._read = message
        return message

    def is_current(self, message: bytes) -> bool:
        """True if a message can be sent now."""
        del message
        return True

    def encode_change(self, message: bytes) -> Sequence[Buffer]:
        """Encode a new message for clients that have the previous one."""
        self._newest = message
        return (message,)

    def encode_whole(self) -> Sequence[Buffer]:
        """Encode the newest message for clients that do not have the previous one; empty before the first."""
        return (self._newest,) if self._newest else ()

    _newest = b""


class RowsChannel(StreamChannel):
    """Channel of rows for one generation of the world."""

    def __init__(self, topic: str, world: WorldChannel, *, period_s: float) -> None:
        super().__init__(topic, encoding=topic.replace("/", "."), period_s=period_s)
        self._world = world

    def is_current(self, message: bytes) -> bool:
        return ARRAY_HEADER.unpack_from(message)[1] == self._world.generation  # a newer one's manifest will follow


class PosesChannel(RowsChannel):
    """Poses: all at first and for slow clients, then only changed ones."""

    def __init__(self, world: WorldChannel) -> None:
        super().__init__(POSES, world, period_s=0.0)
        self._time_ns, self._generation = 0, _NO_GENERATION
        self._rows: NDArray[np.float64] = np.empty((0, 7))

    def send_late(self, client: Client, time_ns: int) -> None:
        """Queue all poses, so that they stay in order with tf; the queue may drop earlier ones."""
        client.send_message(self, time_ns, self.encode_whole())

    def encode_change(self, message: bytes) -> Sequence[Buffer]:
        last, last_generation = self._rows, self._generation
        self._time_ns, self._generation, count = ARRAY_HEADER.unpack_from(message)
        self._rows = np.frombuffer(message, dtype="<f8", offset=ARRAY_HEADER.size).reshape(count, 7)
        if last_generation != self._generation or last.shape != self._rows.shape:
            return self.encode_whole()
        return self._encode(np.flatnonzero((self._rows != last).any(axis=1)))

    def encode_whole(self) -> Sequence[Buffer]:
        return () if self._generation == _NO_GENERATION else self._encode(np.arange(len(self._rows)))

    def _encode(self, bodies: NDArray[np.intp]) -> Sequence[Buffer]:
        header = ARRAY_HEADER.pack(self._time_ns, self._generation, len(bodies))
        poses = self._rows.astype("<f4").take(bodies, axis=0).take(_XYZ_XYZW, axis=1)  # faster than by index
        return (header + bodies.astype("<u4").tobytes() + poses.tobytes(),)


class StateChannel(StreamChannel):
    """State of the clock, 10 Hz."""

    def __init__(self) -> None:
        super().__init__(STATE, encoding="json", period_s=0.1)
        self.time_ns: int | None = None
        """Simulated time [ns]."""

    def poll(self, now_s: float, time_ns: int) -> bool:
        is_new = self.receive() is not None  # other channels use the time, too
        return super().poll(now_s, time_ns) or is_new

    def receive(self) -> bytes | None:
        message = super().receive()
        if message is not None:
            self.time_ns = _clock_decoder.decode(message).time_ns
        return message


def line_channels() -> tuple[StreamChannel, ...]:
    """Return the channels of lines that are always drawn, and of range sensors' lines."""
    return tuple(StreamChannel(topic, encoding=LINES.replace("/", "."), period_s=0.0) for topic in (LINES, RANGES))


def contacts_channel(world: WorldChannel) -> RowsChannel:
    """Return the channel of contacts."""
    return RowsChannel(CONTACTS, world, period_s=0.0)


def series_channel() -> StreamChannel:
    """Return the channel of plotted values, 20 Hz; each message has the rows of about a second."""
    return StreamChannel(SERIES, encoding=SERIES.replace("/", "."), period_s=0.05)


def performance_channel() -> StreamChannel:
    """Return the channel of profiles."""
    return StreamChannel(PERFORMANCE, encoding="json", period_s=0.0)


def differences_channel() -> StreamChannel:
    """Return the channel of the differences from the recording that the world is compared with."""
    return StreamChannel(DIFFERENCES, encoding="json", period_s=0.0)


def joints_channel(world: WorldChannel) -> RowsChannel:
    """Return the channel of joints, 10 Hz."""
    return RowsChannel(JOINTS, world, period_s=0.1)


class _Clock(msgspec.Struct):
    time_ns: int


_clock_decoder = msgspec.json.Decoder(_Clock)
