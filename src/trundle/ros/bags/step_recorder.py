"""Records what nodes of this process publish, stamped and put in order by whoever lets time pass: to the byte."""

from collections.abc import Callable
from pathlib import Path

from ..messages.messages import Message
from ..node.local_graph import LocalPublisher
from ..node.loop import GraphLoop
from .bag import BagConnection, BagError, BagMessage, recording_failure
from .files import create_bag

_NAME = "/record"
_BY_THE_WALL = ("/rosout", "/rosout_agg")
"""What nodes say at their start carries the wall's time."""


class StepRecorder:
    """Hears each publisher of a loop from its birth on; messages of one instant go into the bag in a fixed order."""

    is_raw = True
    needs_every_message = False
    """It writes what is said; nothing is said more often for its sake."""

    def __init__(self, loop: GraphLoop, path: Path, *, complain: Callable[[str], None]) -> None:
        """Open the file.

        Args:
            loop: whose nodes are heard.
            path: of the bag.
            complain: is told why recording broke off, if it does.

        Raises:
            BagError: it cannot be written.
        """
        self._path = path if path.suffix in (".bag", ".mcap") else path.with_name(f"{path.name}.bag")
        self._active = self._path.with_name(f"{self._path.name}.active")
        self._active.unlink(missing_ok=True)
        self._writer = create_bag(self._active)
        self._received: list[tuple[LocalPublisher, bytes]] = []
        self._complain = complain
        self._has_failed = False
        self._is_abandoned = False
        loop.local.on_publisher.append(self._follow)

    def receive(self, message: Message) -> None:
        """Take a message object: never, as it wants bytes."""
        raise AssertionError(message)

    def receive_bytes(self, data: bytes, publisher: LocalPublisher) -> None:
        """Take a message, on the loop."""
        self._received.append((publisher, data))

    def write(self, stamp_ns: int) -> None:
        """Write what was heard since the last time; called while the loop rests."""
        heard, self._received = self._received, []
        if self._has_failed:
            return
        # A stable sort: the messages of one publisher stay as they came.
        heard.sort(key=lambda each: (each[0].topic, each[0].caller))
        try:
            for publisher, data in heard:
                self._writer.write(BagMessage(_connection(publisher), max(stamp_ns, 1), data))
        except BagError as error:
            self._fail(str(error))
        except OSError as error:
            self._abandon(error)

    def close(self) -> None:
        """Finish the file; what was not written yet came after the end."""
        if self._is_abandoned:
            return
        try:
            self._writer.close()
            self._active.replace(self._path)
        except OSError as error:
            self._abandon(error)

    def _abandon(self, error: OSError) -> None:
        """Leave the file as it is: what it would be given later would not follow on what it holds."""
        self._is_abandoned = True
        self._writer.abandon()
        self._fail(recording_failure(self._active, error))

    def _fail(self, why: str) -> None:
        self._has_failed = True
        self._complain(f"recording broke off: {why}")

    def _follow(self, publisher: LocalPublisher) -> None:
        if publisher.topic not in _BY_THE_WALL:
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
