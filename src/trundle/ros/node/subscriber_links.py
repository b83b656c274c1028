"""Subscribers of a publisher: connections to other processes, and subscriptions of this one."""

from ..transport.tcpros import FrameProtocol
from .local_graph import LocalSubscriber


class SubscriberLinks:
    """Subscribers of one topic of a node, with their nodes' names; changed on the loop only."""

    def __init__(self, topic: str) -> None:
        self.remote: dict[FrameProtocol, str] = {}
        self.local: dict[LocalSubscriber, str] = {}
        self._topic = topic

    def __len__(self) -> int:
        return len(self.remote) + len(self.local)

    @property
    def is_congested(self) -> bool:
        """True if no subscriber can accept a message now."""
        return bool(self.remote) and not self.local and all(link.out.is_congested for link in self.remote)

    @property
    def need_every_message(self) -> bool:
        """True if a subscriber needs every message; assumed for other processes."""
        return bool(self.remote) or any(subscriber.needs_every_message for subscriber in list(self.local))

    @property
    def dropped(self) -> int:
        """Messages dropped for slow subscribers still connected."""
        return sum(link.out.dropped for link in list(self.remote))

    def close(self) -> None:
        """Close all links."""
        for link in list(self.remote):
            link.close("the topic is no longer published")
        self.remote.clear()
        self.local.clear()

    def connections(self) -> list[list[int | str | bool]]:
        """Links, as in getBusInfo."""
        remote = [
            [_number(link), name, "o", link.kind, self._topic, True, link.description]
            for link, name in self.remote.items()
        ]
        return remote + [
            [_number(s), name, "o", "INTRAPROCESS", self._topic, True, ""] for s, name in self.local.items()
        ]

    def statistics(self) -> list[object]:
        """Bytes and messages, as in getBusStats; the first frame is the connection header."""
        links = [[_number(link), link.out.bytes_sent, link.out.frames_sent - 1, True] for link in self.remote]
        return [self._topic, sum(link.out.bytes_sent for link in self.remote), links]


def _number(link: object) -> int:
    """Connection ID for XML-RPC."""
    return id(link) % 2**31
