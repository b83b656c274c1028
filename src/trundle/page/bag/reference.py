"""Bag that a page's topics are compared with: its samples for clients, and the differences from it."""

import asyncio
from collections.abc import Mapping, Sequence
from pathlib import Path

import msgspec

from trundle.base.diagnostics import UsageError
from trundle.ros import (
    TF_TYPES,
    MessageError,
    Messages,
    NumberReader,
    RecordedNumbers,
    message_time,
    open_bag,
    read_numbers,
    transform_poses,
)
from trundle.sim.gltf import content_name

from ..clients.channel import Channel, Client
from ..clients.frames import Buffer
from ..clients.hub import Hub
from ..clients.protocol import ENCODING
from ..clients.send_flow import NEWEST, Keys
from ..clients.thinning import Thin
from ..world.channels import StreamChannel
from ..world.reference import Differences, ReferenceInfo
from ..world.streams import REFERENCE
from .comparison import BagComparison
from .reference_samples import ReferenceSamples, reference_samples

_PERIOD_S = 0.1
_SAMPLE_S = 0.02
"""Shortest time between two compared messages of a topic [s]; messages in between are not compared."""
_MAX_ROWS = 300
_SIMULATED_S = 1e8
"""Smaller times are simulated, larger ones are wall time [s]."""


class ReferenceChannel(Channel):
    """The bag that the topics are compared with, or null."""

    def __init__(self) -> None:
        super().__init__(REFERENCE, encoding="json", is_droppable=False, trundle_only=True)
        self._content = b"null"

    def set(self, info: ReferenceInfo | None) -> None:
        """Replace it."""
        self._content = msgspec.json.encode(info)
        self.publish(0, (self._content,))

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        client.send_message(self, 0, (self._content,))


class BagReference:
    """Compares the page's topics with a bag; used on the loop only."""

    def __init__(self, hub: Hub, differences: StreamChannel) -> None:
        """Create it without a bag.

        Args:
            hub: channels of the topics.
            differences: channel of the differences.
        """
        self._hub = hub
        self._channel = ReferenceChannel()
        hub.add_channels([self._channel])
        self._differences = differences
        self._compared: _Compared | None = None
        self._topics: dict[int, _TopicReader] = {}
        """Readers by their channels' ids."""
        self._has_start = False
        self._due_s = 0.0
        self._sent: Differences | None = None
        self.files: dict[str, bytes] = {}
        """URL → content of the samples."""

    @property
    def is_open(self) -> bool:
        """True while a bag is compared."""
        return self._compared is not None

    async def open(self, path: Path, title: str, *, start: float | None) -> None:
        """Start to compare with a bag, in place of another.

        Args:
            path: .bag or .mcap file.
            title: name for users.
            start: time of the page at which the bag starts [s]; None: that of the page's clock once there are topics
                to compare, or for a bag of simulated time the same time.

        Raises:
            BagError: the file is damaged.
            UsageError: the bag is empty.
        """
        recorded, samples = await asyncio.to_thread(_read, path, title)
        self.close()
        url = f"world/{content_name(samples.data + repr(samples.topics).encode())}.bin"
        self.files = {url: samples.data}
        self._compared = _Compared(title, url, samples, BagComparison(recorded, start=start or 0.0))
        self._has_start = start is not None
        if start is not None:
            self._channel.set(self._compared.info)

    def set_offset(self, offset: float) -> None:
        """Let the bag start so much later [s]."""
        if self._compared is not None:
            self._compared.comparison.offset = offset
            self._channel.set(self._compared.info)

    def close(self) -> None:
        """Stop comparing."""
        for reader in self._topics.values():
            reader.channel.unsubscribe(reader)
        self._topics = {}
        if self._compared is not None:
            self._compared, self.files, self._sent = None, {}, None
            self._channel.set(None)

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Subscribe to topics that have come, and send the differences."""
        compared = self._compared
        if compared is None or now_s < self._due_s:
            return False
        self._due_s = now_s + _PERIOD_S
        channels = self._find_channels(compared.comparison)
        if channels and not self._has_start:
            recorded = compared.comparison.reference
            is_simulated = max(recorded.start, time_ns / 1e9) < _SIMULATED_S
            start = recorded.start if is_simulated else time_ns / 1e9
            compared.comparison, self._has_start = BagComparison(recorded, start=start), True
            self._channel.set(compared.info)
        self._subscribe(channels, compared.comparison)
        if not self._differences.clients:
            self._sent = None
            return False
        time = time_ns / 1e9
        differences = Differences(time=time, rows=tuple(compared.comparison.differences(time)[:_MAX_ROWS]))
        if differences != self._sent:
            self._sent = differences
            self._differences.put(msgspec.json.encode(differences))
        return False

    def _find_channels(self, comparison: BagComparison) -> dict[int, Channel]:
        """Return the channels of the recorded topics by their ids."""
        topics = comparison.reference.topics
        return {
            channel.id: channel
            for channel in self._hub.channels
            if channel.encoding == ENCODING and channel.topic in topics
        }

    def _subscribe(self, channels: Mapping[int, Channel], comparison: BagComparison) -> None:
        for channel_id in self._topics.keys() - channels.keys():
            reader = self._topics.pop(channel_id)
            reader.channel.unsubscribe(reader)
        for channel_id in channels.keys() - self._topics.keys():
            reader = self._topics[channel_id] = _TopicReader(channels[channel_id], comparison)
            reader.channel.subscribe(reader)


class _Compared(msgspec.Struct, eq=False):
    title: str
    url: str
    samples: ReferenceSamples
    comparison: BagComparison

    @property
    def info(self) -> ReferenceInfo:
        comparison = self.comparison
        return ReferenceInfo(
            title=self.title,
            url=self.url,
            start=comparison.start + comparison.offset,
            offset=comparison.offset,
            duration=comparison.reference.duration,
            samples=self.samples.samples,
            links=self.samples.frames,
            joints=(),
            topics=self.samples.topics,
            root=self.samples.root,
        )


class _TopicReader:
    """Client of a topic's channel, which reads the numbers in the messages."""

    is_view_only = True

    def __init__(self, channel: Channel, comparison: BagComparison) -> None:
        self.channel = channel
        self._comparison = comparison
        self._is_tf = channel.schema_name in TF_TYPES
        self._is_static = channel.topic.endswith("/tf_static")
        self._messages = Messages(bare=True)
        self._numbers: NumberReader | None = None
        self._last_s = -1.0
        try:
            self._messages.add_definition(channel.schema_name, channel.schema)
            self._numbers = NumberReader(self._messages, channel.schema_name)
        except MessageError:  # plots and displays name the fault
            return

    def send_message(
        self, channel: Channel, time_ns: int, pieces: Sequence[Buffer], keys: Keys = NEWEST, thin: Thin | None = None
    ) -> None:
        """Compare a message."""
        del keys, thin
        if self._numbers is None:
            return
        try:
            message = self._messages.deserialize(b"".join(pieces), channel.schema_name)
            if self._is_tf:
                for parent, child, time, pose in transform_poses(message):
                    start = self._comparison.start
                    self._comparison.add_transform(parent, child, start if self._is_static else time, pose)
                return
            time = message_time(message, time_ns)
            if abs(time - self._last_s) < _SAMPLE_S:
                return
            self._last_s = time
            found = self._numbers.read(message)
        except MessageError:
            return
        if found is not None:
            self._comparison.add_numbers(channel.topic, time, *found)

    def is_waiting(self, channel: Channel) -> bool:
        """Return False: messages are read at once."""
        del channel
        return False

    def count_drop(self, channel: Channel) -> None:
        """Do nothing: no message is dropped."""


def _read(path: Path, title: str) -> tuple[RecordedNumbers, ReferenceSamples]:
    with open_bag(path) as bag:
        if not any(bag.counts):
            raise UsageError(f"{title}: nothing was recorded")
        recorded = read_numbers(bag)
    return recorded, reference_samples(recorded)
