"""Stop of driven robots by the owner of the page's server, if the server dies or hangs."""

import threading
from collections.abc import Mapping
from typing import TYPE_CHECKING

from .twist import publish_twist

if TYPE_CHECKING:
    from trundle.ros import Node, Publisher

_TICK_S = 0.1
"""Period at which silence is counted, and at which the server reports."""
SILENT_TICKS = 10
"""Ticks without a report of the server after which driven robots are stopped: as long as a page's lease."""


class DriveStop:
    """Publishers of zero velocities, advertised when driving starts, so that subscribers connect in time.

    They latch: a robot that connects later may have received the server's last command, and gets the zero, too.
    """

    def __init__(self, node: "Node") -> None:
        self._node = node
        self._publishers: dict[str, Publisher] = {}
        self._driven: frozenset[str] = frozenset()
        """Topics in the latest report."""
        self._is_stopped = False
        """True after a stop, until the next report."""
        self._silent_ticks = 0
        """Ticks since the latest report."""
        self._changed = threading.Condition(threading.RLock())
        self._has_ended = False
        self._watch: threading.Thread | None = None

    def follow(self, topics: Mapping[str, str]) -> None:
        """Handle the server's report of the driven topics and their types."""
        for topic, type_name in topics.items():
            if topic not in self._publishers:
                self._publishers[topic] = self._node.advertise(topic, type_name, latch=True, queue_size=1)
        with self._changed:
            self._driven, self._is_stopped, self._silent_ticks = frozenset(topics), False, 0
            self._changed.notify()
        if self._watch is None:
            self._watch = threading.Thread(target=self._watch_reports, name="trundle-drive-stop", daemon=True)
            self._watch.start()

    def end(self) -> None:
        """Stop all driven robots, after the server has ended.

        Robots that were stopped already are stopped again: after a silence, the server may have sent another command.
        """
        with self._changed:
            self._stop()
            self._has_ended = True
            self._changed.notify()

    def replace(self) -> "DriveStop":
        """End, and return the stop for the next server."""
        self.end()
        return DriveStop(self._node)

    def _watch_reports(self) -> None:
        """Stop driven robots when reports cease.

        Ticks are counted, not time: while this process is held up, the server's reports wait in its pipe unread.
        """
        with self._changed:
            while not self._has_ended:
                is_moving = bool(self._driven) and not self._is_stopped
                if self._changed.wait(_TICK_S if is_moving else None) or not is_moving:
                    continue
                self._silent_ticks += 1
                if self._silent_ticks >= SILENT_TICKS:
                    self._stop()

    def _stop(self) -> None:
        """Publish zero on the driven topics."""
        self._is_stopped = True
        for topic in self._driven:
            publish_twist(self._node, self._publishers[topic], 0.0, 0.0)
