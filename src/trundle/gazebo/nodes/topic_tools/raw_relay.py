"""Forwarding of serialized messages of any type; the first message determines the output's type."""

import asyncio
from collections.abc import Callable, Iterable

from trundle.ros import MessageError, Node, Publisher, RawMessage, Subscription

_QUEUE = 100
_POLL_S = 0.1


class RawPublisher:
    """Publisher with the type and latching of the first message, which reaches subscribers only if it is latched."""

    def __init__(self, node: Node, topic: str, *, latch: bool | None = None) -> None:
        """Create; `latch` overrides the messages' latching."""
        self.topic = topic
        self._node = node
        self._latch = latch
        self._publisher: Publisher | None = None

    @property
    def is_typed(self) -> bool:
        """True once a message was published."""
        return self._publisher is not None

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers, or the topic is not advertised yet."""
        return self._publisher is None or self._publisher.has_subscribers

    def publish(self, message: RawMessage) -> None:
        """Publish a serialized message; other types than the first are logged and dropped."""
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
            node.log.error(f"{self.topic} carries {self._publisher.type}; a {message.type} is dropped")
            return
        self._publisher.publish(message.data)


class RawSubscriber:
    """Subscription to any type that can be cancelled and renewed."""

    def __init__(self, node: Node, topic: str, callback: Callable[[RawMessage], None]) -> None:
        self.topic = topic
        self._node = node
        self._callback = callback
        self._subscription: Subscription | None = None

    def subscribe(self) -> None:
        """Subscribe, unless subscribed."""
        if self._subscription is None:
            self._subscription = self._node.subscribe(self.topic, "*", self._callback, queue_size=_QUEUE)

    def unsubscribe(self) -> None:
        """Unsubscribe."""
        if self._subscription is not None:
            self._subscription.unregister()
            self._subscription = None


async def subscribe_lazily(
    node: Node, output: RawPublisher, inputs: Callable[[], Iterable[tuple[RawSubscriber, bool]]]
) -> None:
    """Subscribe only while the output has subscribers; to all inputs until its type is known.

    Args:
        node: node; the function returns when it is closed.
        output: publisher of the output.
        inputs: returns all current inputs, with True for those that are forwarded.
    """
    while not node.closed.is_set():
        for source, is_selected in inputs():
            if not output.is_typed or (is_selected and output.has_subscribers):
                source.subscribe()
            else:
                source.unsubscribe()
        await asyncio.sleep(_POLL_S)
