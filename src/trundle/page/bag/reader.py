"""Messages of a bag between two times, and those that hold at a time; in a thread of its own."""

from collections.abc import Iterator

from trundle.ros import BagConnection, BagMessage, BagReader

_TF_NS = 2_000_000_000
"""Transforms before a time that are sent with it [ns]: publishers of /tf take turns."""
_FIRST_WINDOW_NS = 1_000_000_000


class BagCursor:
    """Reads on from where it stopped, without opening the index again."""

    def __init__(self, bag: BagReader) -> None:
        self._bag = bag
        self._topics: frozenset[str] = frozenset()
        self._messages: Iterator[BagMessage] = iter(())
        self._ahead: BagMessage | None = None
        """Read, but later than asked for."""
        self._at_ns: int | None = None

    def read(self, topics: frozenset[str], after_ns: int, until_ns: int) -> list[BagMessage]:
        """Read the messages of some topics, later than one time and not later than another [ns].

        Raises:
            BagError: the file is damaged.
        """
        if topics != self._topics or after_ns != self._at_ns:
            self._topics = topics
            self._messages = self._bag.messages(lambda c: c.topic in topics, start_ns=after_ns + 1)
            self._ahead = None
        self._at_ns = until_ns
        found: list[BagMessage] = []
        while (message := self._ahead or next(self._messages, None)) is not None:
            self._ahead = None
            if message.stamp_ns > until_ns:
                self._ahead = message
                break
            found.append(message)
        return found

    def read_state(self, topics: frozenset[str], at_ns: int) -> list[BagMessage]:
        """Read what holds at a time [ns]: the last message of each topic, every latched one and transforms.

        Raises:
            BagError: the file is damaged.
        """
        connections = [c for c in self._bag.connections if c.topic in topics]
        kept = [c for c in connections if is_kept(c)]
        found = list(_last(self._bag, kept, self._bag.start_ns, at_ns).values()) if kept else []
        tf = [c for c in connections if c not in kept and c.type in ("tf2_msgs/TFMessage", "tf/tfMessage")]
        if tf:
            found += self._bag.messages(lambda c: c in tf, start_ns=at_ns - _TF_NS, end_ns=at_ns)
        rest = {c.topic for c in connections if c not in kept and c not in tf}
        found += self._last_of_topics(rest, at_ns)
        return sorted(found, key=lambda message: message.stamp_ns)

    def _last_of_topics(self, topics: set[str], at_ns: int) -> list[BagMessage]:
        """Look backwards, each time over a span twice as long."""
        found: list[BagMessage] = []
        end_ns, window_ns = at_ns, _FIRST_WINDOW_NS
        while topics and end_ns >= self._bag.start_ns:
            begin_ns = end_ns - window_ns
            wanted = [c for c in self._bag.connections if c.topic in topics]
            by_topic = {
                connection.topic: message for connection, message in _last(self._bag, wanted, begin_ns, end_ns).items()
            }
            found += by_topic.values()
            topics = topics - by_topic.keys()
            end_ns, window_ns = begin_ns - 1, 2 * window_ns
        return found


def is_kept(connection: BagConnection) -> bool:
    """True if a message holds until its publisher's next one."""
    return connection.latching or connection.topic.endswith("/tf_static")


def _last(
    bag: BagReader, connections: list[BagConnection], begin_ns: int, end_ns: int
) -> dict[BagConnection, BagMessage]:
    """Return the last message of each connection within a span."""
    messages = bag.messages(lambda c: c in connections, start_ns=begin_ns, end_ns=end_ns)
    return {message.connection: message for message in messages}
