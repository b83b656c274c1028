"""State shared by all clients of one rosbridge."""

from dataclasses import dataclass, field

from trundle.ros import Node

from .json_values import JsonEncoder
from .publishers import Publishers
from .services import ClientService


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """Parameters of the protocol."""

    fragment_timeout_s: float = 600.0
    fragment_size: int | None = None
    """Maximum length of a message to a client before it is split; None: unlimited."""
    unregister_timeout_s: float = 10.0
    topics_glob: tuple[str, ...] = ()
    services_glob: tuple[str, ...] = ()


@dataclass(slots=True)
class Shared:
    """State of the node, shared by its clients."""

    node: Node
    options: Options
    encoder: JsonEncoder = field(init=False)
    publishers: Publishers = field(init=False)
    services: dict[str, ClientService] = field(default_factory=dict[str, ClientService])
    """Advertised name → service."""

    def __post_init__(self) -> None:
        """Create the encoder and the publishers."""
        self.encoder = JsonEncoder(self.node.messages)
        self.publishers = Publishers(self.node, self.options.unregister_timeout_s)
