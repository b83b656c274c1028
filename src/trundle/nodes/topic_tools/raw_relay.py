"""Passes messages on as bytes, whatever their type; who publishes first decides the type."""

import asyncio
from collections.abc import Callable, Iterable

from trundle.ros import MessageError, Node, Publisher, RawMessage, Subscription

_QUEUE = 100
_POLL_S = 0.1


class RawPublisher:
    """A topic that takes type and latching of what is first put on it; that one reaches nobody unless it is latched."""

    def __init__(self, node: Node, topic: str, *, latch: bool | None = None) -> None:
        """Have a topic; `latch` says whether it is latched, whatever is put on it."""
        self.topic = topic
        self._node = node
        self._latch = latch
        self._publisher: Publisher | None = None

    @property
    def is_typed(self) -> bool:
        """Whether anything was put on it yet."""
        return self._publisher is not None

    @property
    def has_subscribers(self) -> bool:
        """Whether publishing reaches anybody; unknown until the type is."""
        return self._publisher is None or self._publisher.has_subscribers

    def publish(self, message: RawMessage) -> None:
        """Publish bytes; a message of another type than the first is named and dropped."""
        node = self._node
        if self._publisher is None:
            try:
                node.messages.add_definition(message.type, message.definition)
                latch = message.latching if self._latch is None else self._latch
                self._publisher = node.advertise(self.topic, message.type, queue_size=_QUEUE, latch=latch)
            except MessageError as error:
                node.log.error(f"{self.topic}: {error}")
                return
            node.log.info(f"advertised as {node.resolve(self.topic)}")
        if message.type != self._publisher.type:
            node.log.error(f"{self.topic} carries {self._publisher.type}; a {message.type} is not passed on")
            return
        self._publisher.publish(message.data)


class RawSubscriber:
    """A subscription to messages of any type that can be let go and taken up again."""

    def __init__(self, node: Node, topic: str, callback: Callable[[RawMessage], None]) -> None:
        self.topic = topic
        self._node = node
        self._callback = callback
        self._subscription: Subscription | None = None

    def subscribe(self) -> None:
        """Listen."""
        if self._subscription is None:
            self._subscription = self._node.subscribe(self.topic, "*", self._callback, queue_size=_QUEUE)

    def unsubscribe(self) -> None:
        """Stop listening."""
        if self._subscription is not None:
            self._subscription.unregister()
            self._subscription = None


async def subscribe_lazily(
    node: Node, output: RawPublisher, inputs: Callable[[], Iterable[tuple[RawSubscriber, bool]]]
) -> None:
    """Listen only while somebody listens to the outlet, and to everything until its type is known.

    Args:
        node: until it is closed.
        output: what is listened to.
        inputs: every one there is now, and whether it is the one that is passed on.
    """
    while not node.closed.is_set():
        for source, chosen in inputs():
            if not output.is_typed or (chosen and output.has_subscribers):
                source.subscribe()
            else:
                source.unsubscribe()
        await asyncio.sleep(_POLL_S)
