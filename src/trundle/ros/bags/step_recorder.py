"""Records this process's publishers per simulation step, with bags identical to the byte."""

from collections.abc import Callable, Iterable
from pathlib import Path

from ..messages.raw_message import Message
from ..node.local_graph import LocalPublisher
from ..node.loop import GraphLoop
from .bag import BagConnection, BagError, BagMessage, recording_failure
from .files import create_bag, lock_bag

_NAME = "/record"
_WALL_TIME_TOPICS = ("/rosout", "/rosout_agg")
"""Topics that are left out: their messages at the start of nodes have wall time."""
_IMAGE, _COMPRESSED_IMAGE, _COMPRESSED = "sensor_msgs/Image", "sensor_msgs/CompressedImage", "/compressed"


def compressed_copies(topics: Iterable[tuple[str, str]]) -> frozenset[str]:
    """Return those of (topic, type) that are IMAGE/compressed beside an IMAGE, as image_transport publishes them."""
    types = dict(topics)
    return frozenset(
        topic
        for topic, kind in types.items()
        if kind == _COMPRESSED_IMAGE
        and topic.endswith(_COMPRESSED)
        and types.get(topic.removesuffix(_COMPRESSED)) == _IMAGE
    )


class StepRecorder:
    """Attaches to every publisher of a loop but `compressed_copies`; messages of a step are in a fixed order."""

    is_raw = True
    needs_every_message = False
    """False: publishers do not publish more often for the recorder."""

    def __init__(
        self,
        loop: GraphLoop,
        path: Path,
        *,
        on_failure: Callable[[str], None],
        from_ns: int = 0,
        without_types: frozenset[str] = frozenset(),
    ) -> None:
        """Create the file and attach.

        Args:
            loop: loop whose publishers are recorded.
            path: bag to write.
            on_failure: called with the reason if recording fails.
            from_ns: time of the first step in the bag [ns]; earlier steps contribute only latched messages.
            without_types: message types to exclude; their publishers get no subscriber.

        Raises:
            BagError: the file cannot be written, or another program writes it.
        """
        self._path = path if path.suffix in (".bag", ".mcap") else path.with_name(f"{path.name}.bag")
        self._active = self._path.with_name(f"{self._path.name}.active")
        self._lock = lock_bag(self._path)
        self._active.unlink(missing_ok=True)
        self._writer = create_bag(self._active)
        self._received: list[tuple[LocalPublisher, bytes]] = []
        self._on_failure = on_failure
        self._without_types = without_types
        self._from_ns = from_ns
        self._latched: dict[tuple[str, str], tuple[LocalPublisher, bytes]] = {}
        """(topic, caller) → last latched message before `from_ns`."""
        self._has_failed = False
        self._is_abandoned = False
        self._local = loop.local
        loop.call_soon(self._attach_all)
        loop.local.on_publisher.append(self._attach)

    def receive(self, message: Message, *, from_outside: bool) -> None:
        """Never called, since `is_raw`."""
        raise AssertionError(message, from_outside)

    def receive_bytes(self, data: bytes, publisher: LocalPublisher) -> None:
        """Receive a serialized message; on the loop."""
        self._received.append((publisher, data))

    def write(self, stamp_ns: int) -> None:
        """Write messages received since the last call; called while the loop is idle."""
        received, self._received = self._received, []
        if self._has_failed:
            return
        if stamp_ns < self._from_ns:
            self._latched |= {(entry[0].topic, entry[0].caller): entry for entry in received if entry[0].latch}
            return
        received = [*self._latched.values(), *received]
        self._latched.clear()
        # A stable sort keeps each publisher's order.
        received.sort(key=lambda entry: (entry[0].topic, entry[0].caller))
        try:
            for publisher, data in received:
                self._writer.write(BagMessage(_connection(publisher), max(stamp_ns, 1), data))
        except BagError as error:
            self._fail(str(error))
        except OSError as error:
            self._abandon(error)

    def close(self) -> None:
        """Finish the file; messages not yet written came after the last step."""
        if self._is_abandoned:
            return
        try:
            self._writer.close()
            self._active.replace(self._path)
        except OSError as error:
            self._abandon(error)
        self._lock.release()

    def _abandon(self, error: OSError) -> None:
        """Abandon the file, since later messages would leave a gap."""
        self._is_abandoned = True
        self._writer.abandon()
        self._lock.release()
        self._fail(recording_failure(self._active, error))

    def _fail(self, reason: str) -> None:
        self._has_failed = True
        self._on_failure(f"recording failed: {reason}")

    def detach(self) -> None:
        """Receive no more messages."""
        self._local.on_publisher.remove(self._attach)
        for publisher in list(self._local.publishers):
            publisher.detach(self)

    def _attach_all(self) -> None:
        """Attach to the existing publishers; on the loop."""
        for publisher in list(self._local.publishers):
            self._attach(publisher)

    def _attach(self, publisher: LocalPublisher) -> None:
        if publisher.topic in _WALL_TIME_TOPICS or publisher.type in self._without_types:
            return
        if publisher.type == _COMPRESSED_IMAGE:
            others = [(one.topic, one.type) for one in self._local.publishers]
            if publisher.topic in compressed_copies(others):
                return
        publisher.attach(self, _NAME)


def _connection(publisher: LocalPublisher) -> BagConnection:
    return BagConnection(
        topic=publisher.topic,
        type=publisher.type,
        md5sum=publisher.md5sum,
        definition=publisher.definition,
        caller=publisher.caller,
        latching=publisher.latch,
    )
