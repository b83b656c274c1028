"""Topics that clients publish to."""

import asyncio
import time
from collections.abc import Callable, Collection, Coroutine, Mapping
from dataclasses import dataclass, field
from typing import Any

from trundle.robots.names import is_legal_name
from trundle.ros import MessageError, Node, Publisher

from ..clients.connection import Connection
from ..clients.protocol import CLIENT_MESSAGE_HEADER, ENCODING, ERROR, Advertise, ClientChannel, Unadvertise

_MAX_CHANNELS = 200
"""Limit of topics of one client."""
_MAX_TYPES = 1_000
"""Limit of types that clients define."""
_QUEUE = 10
_CONNECT_TIMEOUT_S = 1.0
"""Limit of the time that a new topic's messages wait for its subscribers."""
_POLL_S = 0.01


@dataclass(slots=True, eq=False)
class _ClientTopic:
    """Topic that a client publishes to."""

    channel: ClientChannel
    first_messages: list[bytes] | None = field(default_factory=list[bytes])
    """Messages received while the type is read; None: the topic is advertised."""


class ClientPublishers:
    """Publishers, one for each topic, which clients share."""

    def __init__(self, is_shared: Callable[[str], bool]) -> None:
        """Create it; `is_shared` returns True for topics that other parts of the page publish to, too."""
        self._is_shared = is_shared
        self._channels: dict[Connection, dict[int, _ClientTopic]] = {}
        self._publishers: dict[str, Publisher] = {}
        """Publishers by topic name as in clients' messages."""
        self._defined = 0
        """Number of types that clients have defined."""
        self._pending: dict[str, list[bytes]] = {}
        """First messages of topics whose subscribers are not connected yet."""
        self._tasks: set[asyncio.Task[None]] = set()
        self._node: Node | None = None

    def set_node(self, node: Node) -> None:
        """Use another node."""
        self._node = node
        for topic, publisher in self._publishers.items():
            self._publishers[topic] = node.advertise(topic, publisher.type, queue_size=_QUEUE)

    @property
    def topics(self) -> set[str]:
        """Advertised topics."""
        return {publisher.topic for publisher in self._publishers.values()}

    def advertise(self, client: Connection, operation: Advertise, subscribers: Mapping[str, Collection[str]]) -> None:
        """Advertise topics of a client; an invalid one is answered with a status message.

        Args:
            client: publishing client.
            operation: topics to advertise.
            subscribers: topic → nodes; the first messages wait until these are connected.
        """
        channels = self._channels.setdefault(client, {})
        for channel in operation.channels:
            try:
                _check(channel, channels)
            except ValueError as error:
                _refuse(client, channel, error)
                continue
            channels[channel.id] = client_topic = _ClientTopic(channel)
            self._spawn(self._open(client, client_topic, subscribers))

    def unadvertise(self, client: Connection, operation: Unadvertise) -> None:
        """End topics of a client."""
        channels = self._channels.get(client, {})
        for number in operation.channel_ids:
            if channels.pop(number, None) is None:
                client.send_status(ERROR, f"this client has no channel {number}")
        self._close_unused()

    def publish(self, node: Node, client: Connection, message: bytes) -> None:
        """Publish a client's message, if it is a valid message of the topic's type."""
        if len(message) < CLIENT_MESSAGE_HEADER.size:
            client.send_status(ERROR, "a message is shorter than its header")
            return
        _, number = CLIENT_MESSAGE_HEADER.unpack_from(message)
        client_topic = self._channels.get(client, {}).get(number)
        if client_topic is None:
            client.send_status(ERROR, f"this client has no channel {number}")
            return
        if client_topic.first_messages is not None:
            client_topic.first_messages.append(message)
            del client_topic.first_messages[:-_QUEUE]
            return
        channel, data = client_topic.channel, message[CLIENT_MESSAGE_HEADER.size :]
        try:
            node.messages.deserialize(data, channel.schema_name)
        except MessageError as error:
            client.send_status(ERROR, f"a message on {channel.topic} is not published: {error}")
            return
        if (pending := self._pending.get(channel.topic)) is None:
            self._publishers[channel.topic].publish(data)
        else:
            pending.append(data)
            del pending[:-_QUEUE]

    def forget(self, client: Connection) -> None:
        """End the topics of a client that has disconnected."""
        self._channels.pop(client, None)
        self._close_unused()

    async def _open(
        self, client: Connection, client_topic: _ClientTopic, subscribers: Mapping[str, Collection[str]]
    ) -> None:
        """Advertise a client's topic after reading its type, which may be searched on the package path."""
        node, channel = self._node, client_topic.channel
        assert node is not None, "set_node must be called first"
        is_known = await asyncio.to_thread(node.messages.has, channel.schema_name)
        channels = self._channels.get(client, {})
        if channels.get(channel.id) is not client_topic:
            return
        try:
            self._advertise(node, channel, subscribers, is_known=is_known)
        except (MessageError, ValueError) as error:
            _refuse(client, channel, error)
            del channels[channel.id]
            return
        first_messages, client_topic.first_messages = client_topic.first_messages, None
        for message in first_messages or ():
            self.publish(node, client, message)

    def _advertise(
        self, node: Node, channel: ClientChannel, subscribers: Mapping[str, Collection[str]], *, is_known: bool
    ) -> None:
        """Advertise a topic.

        Raises:
            MessageError: the type is unknown, or the topic has another type.
            ValueError: clients have defined too many types.
        """
        if channel.schema and not is_known:
            if self._defined >= _MAX_TYPES:
                raise ValueError(f"clients have defined {_MAX_TYPES} types already")
            self._defined += 1
            node.messages.add_definition(channel.schema_name, channel.schema)
        publisher = node.advertise(channel.topic, channel.schema_name, queue_size=_QUEUE)
        expected = set(subscribers.get(publisher.topic, ()))
        if channel.topic not in self._publishers and expected:
            self._pending[channel.topic] = []
            self._spawn(self._connect(channel.topic, publisher, expected))
        self._publishers[channel.topic] = publisher

    def _spawn(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _connect(self, topic: str, publisher: Publisher, expected: set[str]) -> None:
        """Delay a topic's first messages until its subscribers are connected: a goal is sent only once."""
        end = time.monotonic() + _CONNECT_TIMEOUT_S
        while time.monotonic() < end and not expected <= {str(name) for _, name, *_ in publisher.connections()}:
            await asyncio.sleep(_POLL_S)
        pending = self._pending.pop(topic, [])
        if self._publishers.get(topic) is publisher:
            for message in pending:
                publisher.publish(message)

    def _close_unused(self) -> None:
        channels = (client_topic.channel for topics in self._channels.values() for client_topic in topics.values())
        used = {channel.topic for channel in channels}
        for topic in self._publishers.keys() - used:
            publisher = self._publishers.pop(topic)
            if publisher.topic not in self.topics and not self._is_shared(publisher.topic):
                publisher.unregister()


def _check(channel: ClientChannel, channels: Mapping[int, _ClientTopic]) -> None:
    """Check a client's request to advertise, except for its type.

    Raises:
        ValueError: the request is invalid.
    """
    if not channel.topic or not is_legal_name(channel.topic) or channel.topic.startswith("~"):
        raise ValueError("invalid topic name")
    if channel.encoding != ENCODING:
        raise ValueError(f"the encoding must be {ENCODING}")
    if channel.id in channels:
        raise ValueError(f"channel {channel.id} is in use already")
    if len(channels) >= _MAX_CHANNELS:
        raise ValueError(f"a client publishes at most {_MAX_CHANNELS} topics")


def _refuse(client: Connection, channel: ClientChannel, error: Exception) -> None:
    client.send_status(ERROR, f"{channel.topic} cannot be published: {error}")
