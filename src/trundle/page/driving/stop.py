"""Stop of a driven robot by the process that started the page's server, should the server die or hang."""

import threading
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING

from .twist import publish_twist

if TYPE_CHECKING:
    from trundle.ros import Node, Publisher

SILENCE_S = 0.4
"""Time without a report of the server after which a driven robot is stopped; it reports every 0.1 s."""


class DriveStop:
    """Publishers of zero velocities, advertised when driving begins, so that subscribers are connected in time.

    They latch: a robot that connects later than that may have heard the server's last command, and gets the zero, too.
    """

    def __init__(self, node: "Node") -> None:
        self._node = node
        self._publishers: dict[str, Publisher] = {}
        self._driven: frozenset[str] = frozenset()
        """Topics of the last report."""
        self._is_stopped = False
        """True from a stop to the next report."""
        self._reported_s = 0.0
        self._changed = threading.Condition(threading.RLock())
        self._has_ended = False
        self._watch: threading.Thread | None = None

    def follow(self, topics: Mapping[str, str]) -> None:
        """Follow the server's report of the topics that are driven, each with its type."""
        for topic, type_name in topics.items():
            if topic not in self._publishers:
                self._publishers[topic] = self._node.advertise(topic, type_name, latch=True, queue_size=1)
        with self._changed:
            self._driven, self._is_stopped, self._reported_s = frozenset(topics), False, time.monotonic()
            self._changed.notify()
        if self._watch is None:
            self._watch = threading.Thread(target=self._watch_reports, name="trundle-drive-stop", daemon=True)
            self._watch.start()

    def end(self) -> None:
        """Stop what is driven, as the server has ended.

        What was stopped already is stopped again: a server that went on after a silence may have sent a command.
        """
        with self._changed:
            self._stop()
            self._has_ended = True
            self._changed.notify()

    def _watch_reports(self) -> None:
        """Stop what is driven when reports cease."""
        with self._changed:
            while not self._has_ended:
                is_moving = self._driven and not self._is_stopped
                left_s = self._reported_s + SILENCE_S - time.monotonic() if is_moving else None
                if left_s is not None and left_s <= 0.0:
                    self._stop()
                else:
                    self._changed.wait(left_s)

    def _stop(self) -> None:
        """Publish zero on the topics that are driven."""
        self._is_stopped = True
        for topic in self._driven:
            publish_twist(self._node, self._publishers[topic], 0.0, 0.0)
