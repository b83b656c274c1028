"""Interface of a node for its parts: publishers, subscriptions, services, parameters and servers."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from ..messages.raw_message import Message
from .callback_dispatch import Deliver
from .loop import GraphLoop
from .master_client import MasterClient
from .node_log import NodeLog

if TYPE_CHECKING:
    from ..messages.message_library import Messages


class NodeContext(Protocol):
    """Name, addresses, loop and log of a node."""

    @property
    def name(self) -> str:
        """Global name."""
        ...

    @property
    def uri(self) -> str:
        """URI of the slave API; '' before it listens."""
        ...

    @property
    def service_uri(self) -> str:
        """rosrpc URI of the node's services."""
        ...

    @property
    def loop(self) -> GraphLoop:
        """Loop that runs the node."""
        ...

    @property
    def master(self) -> MasterClient:
        """Client of the graph's master."""
        ...

    @property
    def master_uri(self) -> str:
        """URI of the master."""
        ...

    @property
    def log(self) -> NodeLog:
        """Log of the node."""
        ...

    @property
    def messages(self) -> "Messages":
        """Message types of the loop."""
        ...

    @property
    def deliver(self) -> Deliver | None:
        """Schedules callbacks outside the loop; None: they run on the loop."""
        ...

    @property
    def deliver_call(self) -> Deliver | None:
        """Schedules callbacks of requests, for whose result a client waits."""
        ...

    @property
    def written_remappings(self) -> Mapping[str, str]:
        """Remappings as written, unresolved."""
        ...

    @property
    def is_shut_down(self) -> bool:
        """True once shutdown has begun."""
        ...

    def resolve(self, name: str) -> str:
        """Resolve and remap a name to a global name."""
        ...

    def new(self, type_name: str, fields: object = None) -> Message:
        """Build a message stamped with the node's time."""
        ...

    async def wait_listening(self) -> None:
        """Wait until the node listens, or is shut down."""
        ...
