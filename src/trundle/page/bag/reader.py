"""Messages of a bag between two times, and its state at a time; used in a thread."""

from collections.abc import Iterator

from trundle.ros import BagConnection, BagMessage, BagReader

_TF_NS = 2_000_000_000
"""Span before a time whose transforms belong to the state [ns], since a message of /tf has only some transforms."""
_FIRST_WINDOW_NS = 1_000_000_000


class BagCursor:
    """Reads a bag forwards without searching its index again."""

    def __init__(self, bag: BagReader) -> None:
        self._bag = bag
        self._topics: frozenset[str] = frozenset()
        self._messages: Iterator[BagMessage] = iter(())
        self._ahead: BagMessage | None = None
        """Message that was read, but is later than the requested time."""
        self._end_ns: int | None = None

    def read(self, topics: frozenset[str], after_ns: int, until_ns: int) -> list[BagMessage]:
        """Read the messages of some topics with `after_ns` < time <= `until_ns`.

        Raises:
            BagError: the file is damaged.
        """
        if topics != self._topics or after_ns != self._end_ns:
            self._topics = topics
            self._messages = self._bag.messages(lambda c: c.topic in topics, start_ns=after_ns + 1)
            self._ahead = None
        self._end_ns = until_ns
        messages: list[BagMessage] = []
        while (message := self._ahead or next(self._messages, None)) is not None:
            self._ahead = None
            if message.stamp_ns > until_ns:
                self._ahead = message
                break
            messages.append(message)
        return messages

    def read_state(self, topics: frozenset[str], at_ns: int) -> list[BagMessage]:
        """Read the state at a time [ns]: the last message of each topic, all latched messages, and transforms.

        Raises:
            BagError: the file is damaged.
        """
        connections = [c for c in self._bag.connections if c.topic in topics]
        latched = [c for c in connections if is_latched(c)]
        messages = list(_last(self._bag, latched, self._bag.start_ns, at_ns).values()) if latched else []
        tf = [c for c in connections if c not in latched and c.type in ("tf2_msgs/TFMessage", "tf/tfMessage")]
        if tf:
            messages += self._bag.messages(lambda c: c in tf, start_ns=at_ns - _TF_NS, end_ns=at_ns)
        rest = {c.topic for c in connections if c not in latched and c not in tf}
        messages += self._last_of_topics(rest, at_ns)
        return sorted(messages, key=lambda message: message.stamp_ns)

    def _last_of_topics(self, topics: set[str], at_ns: int) -> list[BagMessage]:
        """Return the last message of each topic by searching backwards, in spans that double."""
        last: list[BagMessage] = []
        end_ns, window_ns = at_ns, _FIRST_WINDOW_NS
        while topics and end_ns >= self._bag.start_ns:
            start_ns = end_ns - window_ns
            connections = [c for c in self._bag.connections if c.topic in topics]
            in_window = _last(self._bag, connections, start_ns, end_ns)
            by_topic = {connection.topic: message for connection, message in in_window.items()}
            last += by_topic.values()
            topics = topics - by_topic.keys()
            end_ns, window_ns = start_ns - 1, 2 * window_ns
        return last


def is_latched(connection: BagConnection) -> bool:
    """True if a topic's last message stays valid until the next one: latched topics and /tf_static."""
    return connection.latching or connection.topic.endswith("/tf_static")


def _last(
    bag: BagReader, connections: list[BagConnection], start_ns: int, end_ns: int
) -> dict[BagConnection, BagMessage]:
    """Return the last message of each connection within a span."""
    messages = bag.messages(lambda c: c in connections, start_ns=start_ns, end_ns=end_ns)
    return {message.connection: message for message in messages}
