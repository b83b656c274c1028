"""Nodes of one process, which exchange message objects without serialization."""

import asyncio
from collections.abc import Callable
from typing import NamedTuple, Protocol
from weakref import WeakSet

from ..messages.raw_message import Message


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
        """md5 sum of the type."""
        ...

    @property
    def definition(self) -> str:
        """Full definition of the type with dependencies."""
        ...

    @property
    def caller(self) -> str:
        """Name of the publishing node."""
        ...

    @property
    def is_outside(self) -> bool:
        """True if the node runs outside the simulation, and does not publish again when simulated time repeats."""
        ...

    @property
    def latch(self) -> bool:
        """True if new subscribers get the last message."""
        ...

    def attach(self, subscriber: "LocalSubscriber", name: str) -> None:
        """Connect a subscription of this process."""
        ...

    def detach(self, subscriber: "LocalSubscriber") -> None:
        """Disconnect a subscription of this process."""
        ...


class LocalSubscriber(Protocol):
    """A subscription in this process."""

    is_raw: bool
    """True if it receives serialized messages."""
    needs_every_message: bool
    """True if the subscription needs every message; otherwise the newest suffices."""

    def receive(self, message: Message, *, from_outside: bool) -> None:
        """Receive a message object; `from_outside` is `LocalPublisher.is_outside`."""
        ...

    def receive_bytes(self, data: bytes, publisher: LocalPublisher) -> None:
        """Receive a serialized message."""
        ...


class LocalNode(NamedTuple):
    """A listening node of this process."""

    name: str
    closed: asyncio.Event
    """Set after shutdown."""
    find_publisher: Callable[[str], LocalPublisher | None]
    """Returns a publisher by its topic's global name."""


class LoopMember(Protocol):
    """A running node."""

    async def shutdown(self) -> None:
        """Unregister everything and close all connections."""
        ...


class LocalGraph:
    """Registry of one loop's nodes; used on the loop only."""

    def __init__(self) -> None:
        self.members: set[LoopMember] = set()
        """Running nodes."""
        self.nodes: dict[str, LocalNode] = {}
        """XML-RPC address → node."""
        self.masters: set[str] = set()
        """URIs of the masters in this process, which end with the process."""
        self.publishers: WeakSet[LocalPublisher] = WeakSet()
        """All publishers so far, closed ones included."""
        self.on_publisher: list[Callable[[LocalPublisher], None]] = []
        """Called on the loop with each new publisher."""
        self.service_changes = 0
        """Number of services that nodes of this process have registered so far."""
        self._service_change: set[asyncio.Future[None]] = set()

    async def wait_service_change(self, previous: int, timeout_s: float) -> bool:
        """Wait until `service_changes` differs from `previous`; False after the timeout."""
        if self.service_changes != previous:
            return True
        future: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._service_change.add(future)
        await asyncio.wait([future], timeout=timeout_s)
        self._service_change.discard(future)
        return future.done()

    def notify_service_change(self) -> None:
        """Count a service that a node of this process registered, and wake the callers that wait for one."""
        self.service_changes += 1
        for future in self._service_change:
            if not future.done():
                future.set_result(None)
