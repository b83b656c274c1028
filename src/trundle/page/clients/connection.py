"""One client: its subscriptions, requests and send queue."""

import time
from collections.abc import Hashable, Mapping, Sequence
from typing import Protocol

import msgspec
from msgspec import UNSET

from .channel import Channel
from .frames import BINARY, TEXT, Buffer, frame_header
from .outbox import Outbox
from .protocol import ERROR, WARNING, Echo, Subscribe, Unsubscribe, mark_message, message_header, stamped_header
from .send_flow import KEPT, NEWEST, Keys, Reduction
from .server_messages import (
    AdvertiseChannels,
    RemoveStatus,
    Response,
    ServerOperation,
    Status,
    UnadvertiseChannels,
)
from .thinning import Thin

_STATUS = "status"
_MAX_SUBSCRIPTIONS = 10_000
_REDUCTIONS = {
    Reduction.THINNED: "so it is sent with fewer pixels or points",
    Reduction.HELD: "so none is sent while other topics are subscribed to",
}


class ChannelTable(Protocol):
    """Advertised channels."""

    def find(self, channel_id: int) -> Channel | None:
        """Return the channel with an id."""
        ...


class Connection:
    """Client of the protocol; used on the loop only."""

    def __init__(
        self,
        outbox: Outbox,
        channels: ChannelTable,
        *,
        speaks_trundle: bool,
        is_view_only: bool = False,
        only_drives: bool = False,
    ) -> None:
        """Create it.

        Args:
            outbox: send queue.
            channels: channels that the client may subscribe to.
            speaks_trundle: True if the client speaks `trundle.v1`.
            is_view_only: True if the client must not change anything.
            only_drives: True if the client may only drive.
        """
        self.outbox = outbox
        self.speaks_trundle = speaks_trundle
        self.is_view_only = is_view_only
        self.only_drives = only_drives
        self.drops: dict[str, int] = {}
        """Messages dropped so far, by topic."""
        self.drops_changed = False
        if speaks_trundle:
            outbox.splits, outbox.mark_frame = True, _mark
        outbox.reduced = self._report_reduction
        self._channels = channels
        self._subscriptions: dict[int, Channel] = {}
        self._numbers: dict[Channel, int] = {}
        """Channel → id of its subscription."""
        self._reduced: set[Channel] = set()
        """Channels with a status about reduced messages."""

    # -- to the client

    def send_message(
        self,
        channel: Channel,
        time_ns: int,
        pieces: Sequence[Buffer],
        keys: Keys = NEWEST,
        thin: Thin | None = None,
    ) -> None:
        """Send a message of a channel that the client subscribes to."""
        number = self._numbers[channel]
        if self.speaks_trundle:
            header = stamped_header(number, time_ns, time.time_ns())
        else:
            header = message_header(number, time_ns)
        self.outbox.send(BINARY, (header, *pieces), channel, keys if channel.is_droppable else KEPT, thin)

    def send(self, message: ServerOperation) -> None:
        """Send a text message that is never dropped."""
        self.outbox.send(TEXT, (msgspec.json.encode(message),))

    def send_response(self, response: Response, answer: bytes) -> None:
        """Send the answer to a request; `answer` holds further fields as JSON."""
        fields = msgspec.json.decode(answer, type=dict[str, msgspec.Raw])
        self.outbox.send(TEXT, (msgspec.json.encode(msgspec.to_builtins(response) | fields),))

    def send_binary(self, pieces: Sequence[Buffer], stream: Hashable = None, keys: Keys = KEPT) -> None:
        """Send a binary message; one with keys may be dropped."""
        self.outbox.send(BINARY, pieces, stream, keys)

    def send_status(self, level: int, message: str, status_id: str | None = None) -> None:
        """Send a status message; it replaces the earlier one with the same id."""
        status = Status(level, message, UNSET if status_id is None else status_id)
        key = frozenset((message if status_id is None else status_id,))
        self.outbox.send(TEXT, (msgspec.json.encode(status),), _STATUS, lambda: key)

    def send_drops(self, channel: Channel, time_ns: int) -> None:
        """Send the counts of dropped messages if they have changed."""
        if self.drops_changed and not self.is_waiting(channel):
            self.drops_changed = False
            self.send_message(channel, time_ns, (msgspec.json.encode(self.drops),))

    def offer(self, channels: Sequence[Channel]) -> None:
        """Advertise channels; those of `trundle.v1` only to a client that speaks it."""
        offers = tuple(channel.offer() for channel in channels if self.speaks_trundle or not channel.trundle_only)
        if offers:
            self.send(AdvertiseChannels(offers))

    def withdraw(self, channels: Sequence[Channel]) -> None:
        """Unadvertise channels; their subscriptions end."""
        removed = set(channels)
        for number in [number for number, channel in self._subscriptions.items() if channel in removed]:
            self._end_subscription(number)
        ids = tuple(channel.id for channel in channels if self.speaks_trundle or not channel.trundle_only)
        if ids:
            self.send(UnadvertiseChannels(ids))

    def is_waiting(self, channel: Channel) -> bool:
        """True if a message of a channel is still queued."""
        return self.outbox.has_waiting(channel)

    def count_drop(self, channel: Hashable) -> None:
        """Count a dropped message."""
        if isinstance(channel, Channel):
            self.drops[channel.topic] = self.drops.get(channel.topic, 0) + 1
            self.drops_changed = True

    # -- from the client

    def subscribe(self, operation: Subscribe) -> None:
        """Subscribe to channels; an invalid subscription is answered with a status message."""
        for subscription in operation.subscriptions:
            channel = self._channels.find(subscription.channel_id)
            if channel is None or (channel.trundle_only and not self.speaks_trundle):
                self.send_status(ERROR, f"no channel {subscription.channel_id}")
            elif subscription.id in self._subscriptions:
                self.send_status(ERROR, f"subscription {subscription.id} is in use already")
            elif channel in self._numbers:
                self.send_status(ERROR, f"{channel.topic} is subscribed to already")
            elif len(self._subscriptions) >= _MAX_SUBSCRIPTIONS:
                self.send_status(ERROR, f"more than {_MAX_SUBSCRIPTIONS} subscriptions")
            else:
                self._subscriptions[subscription.id] = channel
                self._numbers[channel] = subscription.id
                self.outbox.is_shared = len(self._numbers) > 1
                channel.subscribe(self)

    def unsubscribe(self, operation: Unsubscribe) -> None:
        """End subscriptions."""
        for number in operation.subscription_ids:
            if number in self._subscriptions:
                self._end_subscription(number)
            else:
                self.send_status(ERROR, f"no subscription {number}")

    def echo(self, operation: Echo) -> None:
        """Receive the echo of a mark."""
        self.outbox.echo(operation.mark)

    def subscribed_channels(self) -> Mapping[int, Channel]:
        """Return the subscribed channels by subscription id."""
        return self._subscriptions

    def end_subscriptions(self) -> None:
        """End all subscriptions."""
        for number in list(self._subscriptions):
            self._end_subscription(number)

    def _end_subscription(self, number: int) -> None:
        channel = self._subscriptions.pop(number)
        del self._numbers[channel]
        channel.unsubscribe(self)
        self.outbox.forget(channel)
        self.outbox.is_shared = len(self._numbers) > 1
        if channel in self._reduced:
            self._reduced.remove(channel)
            self.send(RemoveStatus((_reduction_id(channel),)))

    def _report_reduction(self, channel: Hashable, reduction: Reduction, transfer_s: float) -> None:
        """Tell the client why it gets smaller or fewer messages of a topic."""
        if isinstance(channel, Channel):
            self._reduced.add(channel)
            text = f"{channel.topic}: a message takes {transfer_s:.1f} s on this connection, {_REDUCTIONS[reduction]}"
            self.send_status(WARNING, text, _reduction_id(channel))


def _reduction_id(channel: Channel) -> str:
    """Return the id of the status about a channel's reduced messages."""
    return f"reduced{channel.topic}"


def _mark(number: int) -> Sequence[Buffer]:
    """Return the frame of a mark that the page echoes."""
    message = mark_message(number, time.time_ns())
    return frame_header(BINARY, len(message)), message
