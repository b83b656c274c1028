"""Topics that clients publish."""

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
"""Topics of one client."""
_MAX_TYPES = 1_000
"""Types that clients define."""
_QUEUE = 10
_CONNECT_S = 1.0
"""Longest time that a new topic's messages wait for its subscribers."""
_POLL_S = 0.01


@dataclass(slots=True, eq=False)
class _Opening:
    """Topic of a client."""

    channel: ClientChannel
    first: list[bytes] | None = field(default_factory=list[bytes])
    """First messages, while the type is searched; None: it is advertised."""


class ClientPublishers:
    """A publisher per topic, however many clients publish on it."""

    def __init__(self, is_shared: Callable[[str], bool]) -> None:
        """Create; `is_shared` is true of the topics that another part of the page publishes on, too."""
        self._is_shared = is_shared
        self._channels: dict[Connection, dict[int, _Opening]] = {}
        self._publishers: dict[str, Publisher] = {}
        """By topic as clients write it."""
        self._defined = 0
        self._waiting: dict[str, list[bytes]] = {}
        """First messages of topics whose subscribers are not connected yet."""
        self._tasks: set[asyncio.Task[None]] = set()
        self._node: Node | None = None

    def set_node(self, node: Node) -> None:
        """Use another node from now on."""
        self._node = node
        for topic, publisher in self._publishers.items():
            self._publishers[topic] = node.advertise(topic, publisher.type, queue_size=_QUEUE)

    @property
    def topics(self) -> set[str]:
        """Topics that are advertised."""
        return {publisher.topic for publisher in self._publishers.values()}

    def advertise(self, client: Connection, operation: Advertise, subscribers: Mapping[str, Collection[str]]) -> None:
        """Advertise topics of a client; what cannot be is answered with a status message.

        Args:
            client: whose topics they are.
            operation: names the topics.
            subscribers: topic → nodes; the first messages wait until these are connected.
        """
        channels = self._channels.setdefault(client, {})
        for wanted in operation.channels:
            try:
                _check(wanted, channels)
            except ValueError as error:
                _refuse(client, wanted, error)
                continue
            channels[wanted.id] = opening = _Opening(wanted)
            self._spawn(self._open(client, opening, subscribers))

    def unadvertise(self, client: Connection, operation: Unadvertise) -> None:
        """End topics of a client."""
        channels = self._channels.get(client, {})
        for number in operation.channel_ids:
            if channels.pop(number, None) is None:
                client.send_status(ERROR, f"there is no channel {number} of this client")
        self._close_unused()

    def publish(self, node: Node, client: Connection, message: bytes) -> None:
        """Publish a client's message, if its bytes are one of the topic's type."""
        if len(message) < CLIENT_MESSAGE_HEADER.size:
            client.send_status(ERROR, "a message is shorter than its header")
            return
        _, number = CLIENT_MESSAGE_HEADER.unpack_from(message)
        opening = self._channels.get(client, {}).get(number)
        if opening is None:
            client.send_status(ERROR, f"there is no channel {number} of this client")
            return
        if opening.first is not None:
            opening.first.append(message)
            del opening.first[:-_QUEUE]
            return
        channel, data = opening.channel, message[CLIENT_MESSAGE_HEADER.size :]
        try:
            node.messages.deserialize(data, channel.schema_name)
        except MessageError as error:
            client.send_status(ERROR, f"a message on {channel.topic} is not published: {error}")
            return
        if (waiting := self._waiting.get(channel.topic)) is None:
            self._publishers[channel.topic].publish(data)
        else:
            waiting.append(data)
            del waiting[:-_QUEUE]

    def forget(self, client: Connection) -> None:
        """End the topics of a client that has gone."""
        self._channels.pop(client, None)
        self._close_unused()

    async def _open(self, client: Connection, opening: _Opening, subscribers: Mapping[str, Collection[str]]) -> None:
        """Open a client's topic, whose type may have to be searched on the package path."""
        node, wanted = self._node, opening.channel
        assert node is not None, "set_node comes first"
        is_known = await asyncio.to_thread(node.messages.has, wanted.schema_name)
        channels = self._channels.get(client, {})
        if channels.get(wanted.id) is not opening:
            return
        try:
            self._publish_as(node, wanted, subscribers, is_known=is_known)
        except (MessageError, ValueError) as error:
            _refuse(client, wanted, error)
            del channels[wanted.id]
            return
        first, opening.first = opening.first, None
        for message in first or ():
            self.publish(node, client, message)

    def _publish_as(
        self, node: Node, wanted: ClientChannel, subscribers: Mapping[str, Collection[str]], *, is_known: bool
    ) -> None:
        """Advertise a topic.

        Raises:
            MessageError: the type is not known, or the topic is published with another one.
            ValueError: too many types.
        """
        if wanted.schema and not is_known:
            if self._defined >= _MAX_TYPES:
                raise ValueError(f"clients have defined {_MAX_TYPES} types already")
            self._defined += 1
            node.messages.add_definition(wanted.schema_name, wanted.schema)
        publisher = node.advertise(wanted.topic, wanted.schema_name, queue_size=_QUEUE)
        expected = set(subscribers.get(publisher.topic, ()))
        if wanted.topic not in self._publishers and expected:
            self._waiting[wanted.topic] = []
            self._spawn(self._connect(wanted.topic, publisher, expected))
        self._publishers[wanted.topic] = publisher

    def _spawn(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _connect(self, topic: str, publisher: Publisher, expected: set[str]) -> None:
        """Hold a topic's first messages until its subscribers are connected: a goal is sent only once."""
        end = time.monotonic() + _CONNECT_S
        while time.monotonic() < end and not expected <= {str(name) for _, name, *_ in publisher.connections()}:
            await asyncio.sleep(_POLL_S)
        waiting = self._waiting.pop(topic, [])
        if self._publishers.get(topic) is publisher:
            for message in waiting:
                publisher.publish(message)

    def _close_unused(self) -> None:
        used = {each.channel.topic for openings in self._channels.values() for each in openings.values()}
        for topic in self._publishers.keys() - used:
            publisher = self._publishers.pop(topic)
            if publisher.topic not in self.topics and not self._is_shared(publisher.topic):
                publisher.unregister()


def _check(wanted: ClientChannel, channels: Mapping[int, _Opening]) -> None:
    """Check what a client asks for, beside its type.

    Raises:
        ValueError: the message cannot be accepted.
    """
    if not wanted.topic or not is_legal_name(wanted.topic) or wanted.topic.startswith("~"):
        raise ValueError("this is not the name of a topic")
    if wanted.encoding != ENCODING:
        raise ValueError(f"messages are encoded as {ENCODING}")
    if wanted.id in channels:
        raise ValueError(f"channel {wanted.id} is in use already")
    if len(channels) >= _MAX_CHANNELS:
        raise ValueError(f"a client publishes at most {_MAX_CHANNELS} topics")


def _refuse(client: Connection, wanted: ClientChannel, why: Exception) -> None:
    client.send_status(ERROR, f"{wanted.topic} cannot be published: {why}")
