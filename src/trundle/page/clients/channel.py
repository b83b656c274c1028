"""A channel that clients subscribe to, and what it needs of a client."""

import itertools
from collections.abc import Sequence
from typing import Protocol

from msgspec import UNSET

from .outbox import Buffer
from .protocol import ENCODING, SCHEMA_ENCODING
from .server_messages import ChannelOffer

_ids = itertools.count(1)


class Client(Protocol):
    """Client as a channel sees it."""

    @property
    def is_view_only(self) -> bool:
        """True if the client may look and change nothing."""
        ...

    def send_message(self, channel: "Channel", time_ns: int, pieces: Sequence[Buffer]) -> None:
        """Send a message of a channel that the client subscribes to.

        Args:
            channel: one that the client subscribes to.
            time_ns: time of the message [ns].
            pieces: buffers of the payload, which must not change any more.
        """
        ...

    def is_waiting(self, channel: "Channel") -> bool:
        """True if a message of a channel was not sent yet."""
        ...

    def count_drop(self, channel: "Channel") -> None:
        """Count a message that the client does not get."""
        ...


class Channel:
    """Topic with a type; ids are never used twice."""

    def __init__(
        self,
        topic: str,
        *,
        encoding: str = ENCODING,
        schema_name: str = "",
        schema: str = "",
        is_droppable: bool = True,
        is_own: bool = False,
    ) -> None:
        """Create.

        Args:
            topic: name.
            encoding: of the payload.
            schema_name: type.
            schema: full definition of the type.
            is_droppable: True if a slow client may lose messages.
            is_own: True if only clients that speak `trundle.v1` are offered it.
        """
        self.id = next(_ids)
        self.topic = topic
        self.encoding = encoding
        self.schema_name = schema_name
        self.schema = schema
        self.is_droppable = is_droppable
        self.is_own = is_own
        self.clients: set[Client] = set()
        """Clients that subscribe to it."""

    def offer(self) -> ChannelOffer:
        """Return the entry of the `advertise` message."""
        return ChannelOffer(
            id=self.id,
            topic=self.topic,
            encoding=self.encoding,
            schema_name=self.schema_name,
            schema=self.schema,
            schema_encoding=SCHEMA_ENCODING if self.encoding == ENCODING else UNSET,
        )

    def subscribe(self, client: Client) -> None:
        """Add a client; subclasses send it what it has missed."""
        self.clients.add(client)

    def unsubscribe(self, client: Client) -> None:
        """Remove a client."""
        self.clients.discard(client)

    def publish(self, time_ns: int, pieces: Sequence[Buffer]) -> None:
        """Send a message to every subscribed client."""
        for client in self.clients:
            client.send_message(self, time_ns, pieces)
