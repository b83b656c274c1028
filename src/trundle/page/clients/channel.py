"""A channel that clients subscribe to, and the client interface that it needs."""

import itertools
from collections.abc import Sequence
from typing import Protocol

from msgspec import UNSET

from .frames import Buffer
from .protocol import ENCODING, SCHEMA_ENCODING
from .send_flow import NEWEST, Keys
from .server_messages import ChannelOffer
from .thinning import Thin

_ids = itertools.count(1)


class Client(Protocol):
    """Interface of a client to channels."""

    @property
    def is_view_only(self) -> bool:
        """True if the client must not change anything."""
        ...

    def send_message(
        self,
        channel: "Channel",
        time_ns: int,
        pieces: Sequence[Buffer],
        keys: Keys = NEWEST,
        thin: Thin | None = None,
    ) -> None:
        """Send a message of a channel that the client subscribes to.

        Args:
            channel: subscribed channel.
            time_ns: time of the message [ns].
            pieces: buffers of the payload, which must not change afterwards.
            keys: returns the parts of a state that the message holds; see `Outbox.send`.
            thin: returns a smaller version of a payload of one piece.
        """
        ...

    def is_waiting(self, channel: "Channel") -> bool:
        """True if a message of a channel is still queued."""
        ...

    def count_drop(self, channel: "Channel") -> None:
        """Count a dropped message."""
        ...


class Channel:
    """Topic with a type and a unique id."""

    def __init__(
        self,
        topic: str,
        *,
        encoding: str = ENCODING,
        schema_name: str = "",
        schema: str = "",
        is_droppable: bool = True,
        trundle_only: bool = False,
    ) -> None:
        """Create it.

        Args:
            topic: topic's name.
            encoding: payload's encoding.
            schema_name: name of the messages' type.
            schema: full definition of the type.
            is_droppable: True if messages to a slow client may be dropped.
            trundle_only: True if only clients that speak `trundle.v1` may subscribe.
        """
        self.id = next(_ids)
        self.topic = topic
        self.encoding = encoding
        self.schema_name = schema_name
        self.schema = schema
        self.is_droppable = is_droppable
        self.trundle_only = trundle_only
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
        """Add a client; subclasses send it the current state."""
        self.clients.add(client)

    def unsubscribe(self, client: Client) -> None:
        """Remove a client."""
        self.clients.discard(client)

    def publish(self, time_ns: int, pieces: Sequence[Buffer], keys: Keys = NEWEST, thin: Thin | None = None) -> None:
        """Send a message to every subscribed client; `keys` and `thin` as in `Outbox.send`."""
        for client in self.clients:
            client.send_message(self, time_ns, pieces, keys, thin)
