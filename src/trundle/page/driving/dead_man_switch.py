"""Driving with a dead man's switch: a robot is stopped when a driver's lease ends, for whatever reason."""

import asyncio
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from trundle.robots.names import is_legal_name
from trundle.ros import MessageError, Node, Publisher

from ..clients.connection import Connection
from ..clients.protocol import ERROR, Drive
from ..clients.server_messages import DriveReceipt
from .twist import TWIST, TWIST_STAMPED, publish_twist

PERIOD_S = 0.1
"""Period of the velocities while a driver's lease lives."""
_MAX_TOPICS = 64


@dataclass(slots=True)
class _Held:
    """Velocity that a driver holds, with monotonic times [s]."""

    command: Drive
    end_s: float
    """Lease's end."""
    due_s: float = 0.0
    """Time of the next publication."""
    is_extended: bool = False
    """True if the lease was extended since the command arrived."""


class Driving:
    """Driving clients, and a publisher for each topic that has been driven; used on the loop only."""

    def __init__(self, report: Callable[[dict[str, str]], None]) -> None:
        """Create it; `report` is called with the driven topics and their types, repeatedly while there are any."""
        self._report = report
        self._node: Node | None = None
        self._publishers: dict[str, Publisher] = {}
        self._drivers: dict[tuple[Connection, str], _Held] = {}
        """Client and topic → what the client commands."""
        self._timer: asyncio.TimerHandle | None = None
        self._due_s = math.inf
        """Monotonic time at which the timer is due [s]."""

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
        """Hold a velocity; publish it at once if it is new, with the topic's type on the graph."""
        if command.number is not None:
            client.send(DriveReceipt(command.number))
        node = self._node
        if node is None or not is_legal_name(command.topic) or not command.topic:
            client.send_status(ERROR, f"{command.topic[:100]!r} cannot be driven")
            return
        if not (math.isfinite(command.linear) and math.isfinite(command.angular)):
            client.send_status(ERROR, "a velocity must be finite")
            return
        topic = node.resolve(command.topic)
        try:
            if topic not in self._publishers:
                self._add_topic(node, topic, types.get(topic, "*"))
        except MessageError as error:
            client.send_status(ERROR, f"{topic} cannot be driven: {error}")
            return
        end_s = time.monotonic() + command.lease
        held = self._drivers.get((client, topic))
        if held is not None and (held.command.linear, held.command.angular) == (command.linear, command.angular):
            held.command, held.end_s, held.is_extended = command, end_s, False
        else:
            self._drivers[client, topic] = _Held(command, end_s)
        self._publish_due()

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

    def _publish_due(self) -> None:
        """Stop robots whose drivers' leases have ended, publish the velocities that are due, and set the timer.

        After a time in which this process was held up, renewals may wait in the sockets unread: a lease that ended
        meanwhile ends a period later, without another velocity.
        """
        now_s = time.monotonic()
        was_held_up = now_s - self._due_s > PERIOD_S
        for (client, topic), held in list(self._drivers.items()):
            if now_s < held.end_s:
                continue
            if was_held_up and not held.is_extended:
                held.end_s = held.due_s = now_s + PERIOD_S
                held.is_extended = True
            else:
                self._end(client, topic)
        due = [(topic, held) for (_, topic), held in self._drivers.items() if now_s >= held.due_s]
        if due:
            # Before the velocities: the owner may have stopped the robot while this process was suspended.
            self._report_driven()
        for topic, held in due:
            held.due_s = now_s + PERIOD_S
            assert self._node is not None, "set_node must be called first"
            publish_twist(self._node, self._publishers[topic], held.command.linear, held.command.angular)
        if self._timer is not None:
            self._timer.cancel()
            self._timer, self._due_s = None, math.inf
        if self._drivers:
            self._due_s = min(min(held.due_s, held.end_s) for held in self._drivers.values())
            self._timer = asyncio.get_running_loop().call_later(self._due_s - now_s, self._publish_due)

    def _add_topic(self, node: Node, topic: str, type_name: str) -> None:
        """Advertise a topic.

        Raises:
            MessageError: the topic's type is not a velocity, or there are too many topics.
        """
        if type_name not in (TWIST, TWIST_STAMPED, "*"):
            raise MessageError(f"its type is {type_name}, not {TWIST} or {TWIST_STAMPED}")
        if len(self._publishers) >= _MAX_TOPICS:
            raise MessageError(f"more than {_MAX_TOPICS} topics")
        self._publishers[topic] = _advertise(node, topic, TWIST if type_name == "*" else type_name)

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
        self._report({topic: self._publishers[topic].type for _, topic in self._drivers})


def _advertise(node: Node, topic: str, type_name: str) -> Publisher:
    """Advertise velocities, latched: a robot that reconnects gets the newest one, perhaps a zero that it missed."""
    return node.advertise(topic, type_name, latch=True, queue_size=1)
