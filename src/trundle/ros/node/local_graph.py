"""The nodes of one process, which hand each other message objects without serialising them."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from ..messages.messages import Message


class LocalPublisher(Protocol):
    """A publisher in this process."""

    @property
    def topic(self) -> str:
        """Global name."""
        ...

    @property
    def type(self) -> str:
        """Message type."""
        ...

    @property
    def md5sum(self) -> str:
        """Checksum of the type."""
        ...

    @property
    def definition(self) -> str:
        """The text of the type and of those it depends on."""
        ...

    @property
    def caller(self) -> str:
        """Name of the publishing node."""
        ...

    @property
    def latch(self) -> bool:
        """Whether new subscribers get the last message."""
        ...

    def attach(self, subscriber: "LocalSubscriber", name: str) -> None:
        """Take a subscription of this process."""
        ...

    def detach(self, subscriber: "LocalSubscriber") -> None:
        """Forget a subscription of this process."""
        ...


class LocalSubscriber(Protocol):
    """A subscription in this process."""

    is_raw: bool
    """Whether it wants bytes."""
    needs_every_message: bool
    """Whether each message counts; else the newest will do."""

    def receive(self, message: Message) -> None:
        """Take a message object."""
        ...

    def receive_bytes(self, data: bytes, publisher: LocalPublisher) -> None:
        """Take a message as bytes."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalNode:
    """A node in this process that listens."""

    name: str
    closed: asyncio.Event
    """Set when it has shut down."""
    find_publisher: Callable[[str], LocalPublisher | None]
    """Finds a publisher by its topic's global name."""


class LoopMember(Protocol):
    """A node that has begun and not ended."""

    async def shutdown(self) -> None:
        """Unregister everything and drop every peer."""
        ...


class LocalGraph:
    """Registry of the nodes of one loop; touched on the loop only."""

    def __init__(self) -> None:
        self.members: set[LoopMember] = set()
        """Nodes that have begun and not ended."""
        self.nodes: dict[str, LocalNode] = {}
        """Address → node that listens there."""
        self.on_publisher: list[Callable[[LocalPublisher], None]] = []
        """Called on the loop with each new publisher."""
        self._service_change: set[asyncio.Future[None]] = set()

    async def wait_service_change(self, timeout_s: float) -> None:
        """Wait until `notify_service_change` is called, or so long."""
        future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._service_change.add(future)
        await asyncio.wait([future], timeout=timeout_s)
        self._service_change.discard(future)

    def notify_service_change(self) -> None:
        """A node of this process provides a service that was not there."""
        for future in self._service_change:
            if not future.done():
                future.set_result(None)
