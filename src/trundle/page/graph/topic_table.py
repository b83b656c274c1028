"""Channels of the graph's topics, added and removed with their publishers."""

import asyncio

from trundle.ros import MessageError, Node, RawMessage, RosError, probe_publisher

from ..clients.hub import Hub
from ..clients.topic_channel import TopicChannel
from .master_state import MasterState


class TopicTable:
    """Channels, one for each published topic."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._channels: dict[str, TopicChannel] = {}
        self._unknown: set[tuple[str, str, tuple[str, ...]]] = set()
        """Topic, type and publishers whose probe returned no definition."""
        self._node: Node | None = None

    @property
    def subscribed(self) -> set[str]:
        """Subscribed topics."""
        return {topic for topic, channel in self._channels.items() if channel.is_subscribed}

    def set_node(self, node: Node) -> None:
        """Use another node."""
        self._node = node
        for channel in self._channels.values():
            channel.set_node(node)

    async def update(self, node: Node, state: MasterState) -> None:
        """Advertise new topics and unadvertise those that are no longer published."""
        types = {topic: state.types[topic] for topic in state.publishers if state.types.get(topic, "*") != "*"}
        self._remove([c for topic, c in self._channels.items() if types.get(topic) != c.schema_name])
        new = [(topic, kind) for topic, kind in types.items() if topic not in self._channels]
        created = await asyncio.gather(*(self._create(node, *pair, state.publishers[pair[0]]) for pair in new))
        if node is self._node:
            self._add([channel for channel in created if channel is not None and channel.topic not in self._channels])
        for topic, channel in self._channels.items():
            channel.set_publishers(state.publishers.get(topic, ()))

    async def _create(self, node: Node, topic: str, type_name: str, publishers: tuple[str, ...]) -> TopicChannel | None:
        """Create a channel with the local definition of its type, or else with the publisher's."""
        try:
            definition = await asyncio.to_thread(node.messages.definition, type_name)
            return self._channel(topic, type_name, node.messages.md5(type_name), definition, is_certain=False)
        except MessageError:
            pass
        if (probe := (topic, type_name, publishers)) in self._unknown:
            return None
        try:
            header = await probe_publisher(node, publishers[0], topic)
            md5sum, definition = header["md5sum"], header["message_definition"]
        except (RosError, KeyError):
            self._unknown.add(probe)
            return None
        return self._channel(topic, type_name, md5sum, definition, is_certain=True)

    def _channel(self, topic: str, type_name: str, md5sum: str, definition: str, *, is_certain: bool) -> TopicChannel:
        return TopicChannel(
            topic, type_name, md5sum=md5sum, definition=definition, is_certain=is_certain, now_ns=self._hub.now_ns,
            retype=self._replace,
        )  # fmt: skip

    def _replace(self, channel: TopicChannel, message: RawMessage) -> None:
        """Replace a topic's channel by one with the publisher's definition."""
        if self._channels.get(channel.topic) is channel and message.definition:
            self._remove([channel])
            type_name = message.type if message.type != "*" else channel.schema_name
            self._add([self._channel(channel.topic, type_name, message.md5sum, message.definition, is_certain=True)])

    def _add(self, channels: list[TopicChannel]) -> None:
        for channel in channels:
            self._channels[channel.topic] = channel
            if self._node is not None:
                channel.set_node(self._node)
        if channels:
            self._hub.add_channels(channels)

    def _remove(self, channels: list[TopicChannel]) -> None:
        for channel in channels:
            del self._channels[channel.topic]
        if channels:
            self._hub.remove_channels(channels)
