"""Channels of what the owner puts here: the simulated world, its poses, joints, lines and clock."""

from collections.abc import Sequence, Set

import msgspec
import numpy as np
from numpy.typing import NDArray

from ..clients.channel import Channel, Client
from ..clients.outbox import Buffer
from ..clients.protocol import ENCODING
from ..mailbox import Mailbox
from .streams import ARRAY_HEADER, CONTACTS, JOINTS, LINES, PERFORMANCE, POSES, RANGES, SERIES, STATE, WORLD

_XYZ_XYZW = [0, 1, 2, 4, 5, 6, 3]
"""Columns of a pose on the wire, of x y z qw qx qy qz."""
_NO_GENERATION = -1


class WorldChannel(Channel):
    """Manifest, and the files that it names."""

    def __init__(self) -> None:
        super().__init__(WORLD, encoding="json", is_droppable=False, trundle_only=True)
        self.files: dict[str, bytes] = {}
        """URL → content."""
        self.generation = _NO_GENERATION
        self._manifest: bytes | None = None

    def set(self, manifest: bytes, generation: int, urls: Set[str]) -> None:
        """Replace the manifest, and forget the files that it does not name.

        Args:
            manifest: JSON.
            generation: of the world.
            urls: of the files that it names.
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
    """Channel that a mailbox feeds; a client whose last message still waits gets the newest one later."""

    def __init__(self, topic: str, *, encoding: str, period_s: float, schema_name: str = "", schema: str = "") -> None:
        """Create; new messages go out at most every `period_s`."""
        super().__init__(
            topic, encoding=encoding, schema_name=schema_name, schema=schema, trundle_only=encoding != ENCODING
        )
        self._period_s = period_s
        self._due_s = 0.0
        self._box: Mailbox | None = None
        self._read: bytes | None = None
        """Message that was read and not sent."""
        self._behind: set[Client] = set()
        """Clients that lack something of the newest message."""

    def open(self, box: Mailbox) -> None:
        """Read from another mailbox from now on."""
        self._box = box

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        self._behind.add(client)

    def unsubscribe(self, client: Client) -> None:
        super().unsubscribe(client)
        self._behind.discard(client)

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Send what came, if it is due; return True if something came.

        Args:
            now_s: monotonic time [s].
            time_ns: time of the message [ns].
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
        """Keep a new message from a client whose last one still waits: it gets the newest one after that."""
        del time_ns
        client.count_drop(self)
        self._behind.add(client)

    def receive(self) -> bytes | None:
        """Read the mailbox; return a new message."""
        message = None if self._box is None else self._box.read()
        if message is not None:
            self._read = message
        return message

    def is_current(self, message: bytes) -> bool:
        """False if a message cannot be sent yet."""
        del message
        return True

    def encode_change(self, message: bytes) -> Sequence[Buffer]:
        """Encode a new message for clients that have the last one."""
        self._newest = message
        return (message,)

    def encode_whole(self) -> Sequence[Buffer]:
        """Encode the newest message for clients that do not have the last one; empty before the first."""
        return (self._newest,) if self._newest else ()

    _newest = b""


class RowsChannel(StreamChannel):
    """Channel of rows that belong to a generation of the world."""

    def __init__(self, topic: str, world: WorldChannel, *, period_s: float) -> None:
        super().__init__(topic, encoding=topic.replace("/", "."), period_s=period_s)
        self._world = world

    def is_current(self, message: bytes) -> bool:
        return ARRAY_HEADER.unpack_from(message)[1] == self._world.generation  # else its manifest is on the way


class PosesChannel(RowsChannel):
    """Poses: all of them first and for a slow client, then only those that changed."""

    def __init__(self, world: WorldChannel) -> None:
        super().__init__(POSES, world, period_s=0.0)
        self._time_ns, self._generation = 0, _NO_GENERATION
        self._rows: NDArray[np.float64] = np.empty((0, 7))

    def send_late(self, client: Client, time_ns: int) -> None:
        """Queue all poses, in order with tf, which is drawn beside them; the queue may drop those before."""
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
        is_new = self.receive() is not None  # the time counts for other channels too
        return super().poll(now_s, time_ns) or is_new

    def receive(self) -> bytes | None:
        message = super().receive()
        if message is not None:
            self.time_ns = _clock_decoder.decode(message).time_ns
        return message


def line_channels() -> tuple[StreamChannel, ...]:
    """Channels of lines: what is drawn always, and what range sensors measure."""
    return tuple(StreamChannel(topic, encoding=LINES.replace("/", "."), period_s=0.0) for topic in (LINES, RANGES))


def contacts_channel(world: WorldChannel) -> RowsChannel:
    """Channel of contacts."""
    return RowsChannel(CONTACTS, world, period_s=0.0)


def series_channel() -> StreamChannel:
    """Channel of plotted values, 20 Hz; each message has the rows of about a second."""
    return StreamChannel(SERIES, encoding=SERIES.replace("/", "."), period_s=0.05)


def performance_channel() -> StreamChannel:
    """Channel of profiles, as they come."""
    return StreamChannel(PERFORMANCE, encoding="json", period_s=0.0)


def joints_channel(world: WorldChannel) -> RowsChannel:
    """Channel of joints, 10 Hz."""
    return RowsChannel(JOINTS, world, period_s=0.1)


class _Clock(msgspec.Struct):
    time_ns: int


_clock_decoder = msgspec.json.Decoder(_Clock)
