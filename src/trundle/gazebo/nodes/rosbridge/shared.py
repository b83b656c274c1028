"""State that all clients of one rosbridge share."""

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
    """Longest message to a client before it is split; None: unlimited."""
    unregister_timeout_s: float = 10.0
    topics_glob: tuple[str, ...] = ()
    services_glob: tuple[str, ...] = ()


@dataclass(slots=True)
class Shared:
    """State of the node behind its clients."""

    node: Node
    options: Options
    encoder: JsonEncoder = field(init=False)
    publishers: Publishers = field(init=False)
    services: dict[str, ClientService] = field(default_factory=dict[str, ClientService])
    """By name as advertised."""

    def __post_init__(self) -> None:
        """Make the parts."""
        self.encoder = JsonEncoder(self.node.messages)
        self.publishers = Publishers(self.node, self.options.unregister_timeout_s)
