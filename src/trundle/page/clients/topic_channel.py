"""Channel of a ROS topic: messages are forwarded as the bytes received."""

import asyncio
from collections.abc import Callable, Collection

from trundle.ros import Node, RawMessage, Subscription

from .channel import Channel, Client
from .frames import Buffer
from .message_keys import MessageKeys
from .thinning import thinner

_NEVER_DROPPED = ("visualization_msgs/", "map_msgs/", "nav_msgs/OccupancyGrid", "rosgraph_msgs/Log")
"""Types whose messages depend on earlier ones (markers, maps), and logs."""
_LINGER_S = 1.0
"""Time that a subscription outlives its last client, which may resubscribe: a new connection would lose messages."""


def is_droppable(topic: str, type_name: str) -> bool:
    """True if messages of a topic to a slow client may be dropped."""
    return not (type_name.startswith(_NEVER_DROPPED) or topic.endswith("/tf_static"))


class TopicChannel(Channel):
    """Channel with one subscription for all its clients, and none without clients."""

    def __init__(
        self,
        topic: str,
        type_name: str,
        *,
        md5sum: str,
        definition: str,
        is_certain: bool,
        now_ns: Callable[[], int],
        retype: "Callable[[TopicChannel, RawMessage], None]",
    ) -> None:
        """Create it.

        Args:
            topic: global name.
            type_name: such as sensor_msgs/LaserScan.
            md5sum: type's checksum.
            definition: full definition of the type.
            is_certain: True if checksum and definition come from a publisher; otherwise messages may differ.
            now_ns: returns the time for messages [ns].
            retype: called with a message of another definition; it replaces the channel.
        """
        super().__init__(
            topic,
            schema_name=type_name,
            schema=definition,
            is_droppable=is_droppable(topic, type_name),
        )
        self._now_ns = now_ns
        self._retype = retype
        self._node: Node | None = None
        self._subscription: Subscription | None = None
        self._md5sum = md5sum
        self._is_certain = is_certain
        self._latched: dict[str, tuple[int, Buffer]] = {}
        """Latest latched message of each publisher, for later clients."""

    @property
    def is_subscribed(self) -> bool:
        """True while the channel subscribes to the topic."""
        return self._subscription is not None

    def set_node(self, node: Node) -> None:
        """Use another node."""
        self._node, self._subscription = node, None
        self._latched.clear()
        if self.clients:
            self._begin()

    def set_publishers(self, names: Collection[str]) -> None:
        """Drop latched messages of nodes that no longer publish."""
        self._latched = {caller: message for caller, message in self._latched.items() if caller in names}

    def subscribe(self, client: Client) -> None:
        super().subscribe(client)
        if self._subscription is None:
            self._begin()
        for time_ns, data in self._latched.values():
            client.send_message(self, time_ns, (data,))

    def unsubscribe(self, client: Client) -> None:
        super().unsubscribe(client)
        if not self.clients:
            asyncio.get_running_loop().call_later(_LINGER_S, self._end)

    def _end(self) -> None:
        """Unsubscribe unless a client has subscribed since."""
        if not self.clients and self._subscription is not None:
            self._subscription.unregister()
            self._subscription = None
            self._latched.clear()

    def _begin(self) -> None:
        if self._node is not None:
            self._subscription = self._node.subscribe(self.topic, "*", self._receive, on_loop=True)

    def _receive(self, message: RawMessage) -> None:
        if message.md5sum != self._md5sum:
            if not self._is_certain:
                self._retype(self, message)
            return
        now_ns = self._now_ns()
        if message.latching:
            self.is_droppable = False
            self._latched[message.caller] = now_ns, message.data
        keys = MessageKeys(self.schema_name, message.caller, message.data)
        self.publish(now_ns, (message.data,), keys, thinner(self.schema_name, message.data))
