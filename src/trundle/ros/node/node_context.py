"""Interface of a node as its parts see it: publishers, subscriptions, services, parameters and servers."""

from collections.abc import Callable, Mapping
from typing import Protocol

from ..messages.messages import Message, Messages
from .loop import GraphLoop
from .master_client import MasterClient
from .node_log import NodeLog


class NodeContext(Protocol):
    """Name, addresses, loop and log of a node."""

    @property
    def name(self) -> str:
        """Global name."""
        ...

    @property
    def uri(self) -> str:
        """Address of the XML-RPC interface; empty before the node listens."""
        ...

    @property
    def service_uri(self) -> str:
        """Address at which its services are called."""
        ...

    @property
    def loop(self) -> GraphLoop:
        """Loop it runs on."""
        ...

    @property
    def master(self) -> MasterClient:
        """The master of its graph."""
        ...

    @property
    def master_uri(self) -> str:
        """Address of the master."""
        ...

    @property
    def log(self) -> NodeLog:
        """Its log."""
        ...

    @property
    def messages(self) -> Messages:
        """Message types."""
        ...

    @property
    def deliver(self) -> Callable[[Callable[[], None]], None] | None:
        """Has callbacks called elsewhere; None: they run on the loop."""
        ...

    @property
    def written_remappings(self) -> Mapping[str, str]:
        """Name → name, both as written, not resolved."""
        ...

    @property
    def is_shut_down(self) -> bool:
        """Whether it has begun to shut down."""
        ...

    def resolve(self, name: str) -> str:
        """Return the global name the node means by `name`, remapped."""
        ...

    def new(self, type_name: str, fields: object = None) -> Message:
        """Make a message stamped with the node's time."""
        ...

    async def wait_listening(self) -> None:
        """Wait until the node has an address, or never will."""
        ...
