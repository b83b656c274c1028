"""Driving with a dead man's switch: a robot is stopped when commands cease, for whatever reason."""

import math
import time
from collections.abc import Callable, Mapping

from trundle.robots.names import is_legal_name
from trundle.ros import MessageError, Node, Publisher

from ..clients.connection import Connection
from ..clients.protocol import ERROR, Drive
from .twist import TWIST, TWIST_STAMPED, publish_twist

SILENCE_S = 0.3
"""Time without a command after which the robot is stopped."""
_MAX_TOPICS = 64
_REPORT_S = 0.1
"""Period of reports to the owner while a robot is driven; without them, it stops the robot."""


class Driving:
    """Driving clients, and a publisher for each topic that has been driven."""

    def __init__(self, report: Callable[[dict[str, str]], None]) -> None:
        """Create it; `report` is called with the driven topics and their types, repeatedly while there are any."""
        self._report = report
        self._reported_s = 0.0
        self._node: Node | None = None
        self._publishers: dict[str, Publisher] = {}
        self._drivers: dict[tuple[Connection, str], float] = {}
        """Client and topic → time of the last command [s]."""

    @property
    def topics(self) -> set[str]:
        """Advertised topics."""
        return set(self._publishers)

    def set_node(self, node: Node) -> None:
        """Use another node; the old one stops the robots, as the new one may not reach them."""
        for topic, publisher in self._publishers.items():
            if self._node is not None and self._is_driven(topic):
                publish_twist(self._node, publisher, 0.0, 0.0)
            self._publishers[topic] = _advertise(node, topic, publisher.type)
        self._node = node

    def drive(self, client: Connection, command: Drive, types: Mapping[str, str]) -> None:
        """Publish a velocity with the topic's type on the graph."""
        node = self._node
        if node is None or not is_legal_name(command.topic) or not command.topic:
            client.send_status(ERROR, f"{command.topic[:100]!r} cannot be driven")
            return
        if not (math.isfinite(command.linear) and math.isfinite(command.angular)):
            client.send_status(ERROR, "a velocity must be finite")
            return
        topic = node.resolve(command.topic)
        try:
            publisher = self._publishers.get(topic) or self._add_topic(node, topic, types.get(topic, "*"))
        except MessageError as error:
            client.send_status(ERROR, f"{topic} cannot be driven: {error}")
            return
        is_new = (client, topic) not in self._drivers
        now_s = self._drivers[client, topic] = time.monotonic()
        # Before the velocity: the owner may have stopped the robot while this process was suspended.
        if is_new or now_s - self._reported_s > _REPORT_S:
            self._report_driven()
        publish_twist(node, publisher, command.linear, command.angular)

    def release(self, client: Connection, topic: str) -> None:
        """Stop the robot, unless another client drives it, too."""
        if self._node is not None and is_legal_name(topic):
            self._end(client, self._node.resolve(topic))

    def forget(self, client: Connection) -> None:
        """Stop the robots of a client that has disconnected."""
        for driver, topic in list(self._drivers):
            if driver is client:
                self._end(client, topic)

    def stop(self) -> None:
        """Stop all driven robots."""
        for client, topic in list(self._drivers):
            self._end(client, topic)

    def poll(self, now_s: float, time_ns: int) -> bool:
        """Stop robots whose clients are silent; return False, as nothing comes from the owner."""
        del time_ns
        if self._drivers and now_s - self._reported_s > _REPORT_S:
            self._report_driven()
        for (client, topic), last_s in list(self._drivers.items()):
            if now_s - last_s > SILENCE_S:
                self._end(client, topic)
        return False

    def _add_topic(self, node: Node, topic: str, type_name: str) -> Publisher:
        """Advertise a topic.

        Raises:
            MessageError: the topic's type is not a velocity, or there are too many topics.
        """
        if type_name not in (TWIST, TWIST_STAMPED, "*"):
            raise MessageError(f"its type is {type_name}, not {TWIST} or {TWIST_STAMPED}")
        if len(self._publishers) >= _MAX_TOPICS:
            raise MessageError(f"more than {_MAX_TOPICS} topics")
        publisher = _advertise(node, topic, TWIST if type_name == "*" else type_name)
        self._publishers[topic] = publisher
        return publisher

    def _is_driven(self, topic: str) -> bool:
        return any(driven == topic for _, driven in self._drivers)

    def _end(self, client: Connection, topic: str) -> None:
        if self._drivers.pop((client, topic), None) is None:
            return
        assert self._node is not None, "set_node must be called first"
        if not self._is_driven(topic):
            publish_twist(self._node, self._publishers[topic], 0.0, 0.0)
        self._node.loop.deliver_soon(
            self._report_driven
        )  # after the zero is sent: until then, the owner stops the robot if this process dies

    def _report_driven(self) -> None:
        self._reported_s = time.monotonic()
        self._report({topic: self._publishers[topic].type for _, topic in self._drivers})


def _advertise(node: Node, topic: str, type_name: str) -> Publisher:
    """Advertise velocities, latched: a robot that reconnects gets the newest one, perhaps a zero that it missed."""
    return node.advertise(topic, type_name, latch=True, queue_size=1)
