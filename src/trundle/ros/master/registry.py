"""Registration tables of the master: publishers, subscribers, services and parameter subscriptions."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from ..xmlrpc.rpc_methods import Answer


class RegistrationTable:
    """One of the master's tables: name → [(node, address)], in the order of registration."""

    def __init__(self) -> None:
        self.entries: dict[str, list[tuple[str, str]]] = {}

    def add(self, name: str, node: str, api: str) -> None:
        """Add an entry unless it exists."""
        entries = self.entries.setdefault(name, [])
        if (node, api) not in entries:
            entries.append((node, api))

    def remove(self, name: str, node: str, api: str) -> Answer:
        """Remove an entry; returns the XML-RPC answer."""
        entries = self.entries.get(name, [])
        if (node, api) not in entries:
            return 1, f"[{node}] is not a known provider of [{name}]", 0
        entries.remove((node, api))
        if not entries:
            del self.entries[name]
        return 1, f"Unregistered [{node}] as provider of [{name}]", 1

    def remove_node(self, node: str) -> list[str]:
        """Remove all entries of a node; returns their names."""
        names = [name for name, entries in self.entries.items() if any(other == node for other, _ in entries)]
        for name in names:
            self.entries[name] = [entry for entry in self.entries[name] if entry[0] != node]
            if not self.entries[name]:
                del self.entries[name]
        return names

    def apis(self, name: str) -> list[str]:
        """Addresses registered under a name."""
        return [api for _, api in self.entries.get(name, [])]

    def has_node(self, node: str) -> bool:
        """True if the node has an entry in this table."""
        return any(other == node for entries in self.entries.values() for other, _ in entries)

    def state(self) -> list[list[object]]:
        """[[name, [node, …]], …], as getSystemState answers."""
        return [[name, [node for node, _ in entries]] for name, entries in self.entries.items()]


@dataclass(slots=True)
class Registry:
    """All tables, and the address of every registered node."""

    publishers: RegistrationTable = field(default_factory=RegistrationTable)
    subscribers: RegistrationTable = field(default_factory=RegistrationTable)
    services: RegistrationTable = field(default_factory=RegistrationTable)
    """One provider per service: the last to register."""
    parameters: RegistrationTable = field(default_factory=RegistrationTable)
    """Subscribed parameter keys, each with a trailing slash."""
    service_apis: dict[str, tuple[str, str]] = field(default_factory=dict[str, tuple[str, str]])
    """Service → (node, rosrpc address)."""
    nodes: dict[str, str] = field(default_factory=dict[str, str])
    """Node → XML-RPC address."""

    def register(self, table: RegistrationTable, name: str, node: str, api: str) -> str | None:
        """Register a node; returns the address of the older node of the same name that it replaces, if any."""
        older = self.nodes.get(node)
        replaced = older if older is not None and older != api else None
        if replaced is not None:
            self.unregister_node(node)
        self.nodes[node] = api
        table.add(name, node, api)
        return replaced

    def register_service(self, name: str, node: str, api: str, service_api: str) -> str | None:
        """Register a node as the provider of a service; returns what `register` does."""
        self.services.entries.pop(name, None)
        replaced = self.register(self.services, name, node, api)
        self.service_apis[name] = (node, service_api)
        return replaced

    def unregister(self, table: RegistrationTable, name: str, node: str, api: str) -> Answer:
        """Remove an entry, and the node if it has no other."""
        if node not in self.nodes:
            return 1, f"[{node}] is not a registered node", 0
        answer = table.remove(name, node, api)
        self._drop_if_idle(node)
        return answer

    def unregister_service(self, name: str, node: str, service_api: str) -> Answer:
        """Remove a service if this node is still its provider."""
        if node not in self.nodes:
            return 1, f"[{node}] is not a registered node", 0
        if self.service_apis.get(name) != (node, service_api):
            return 1, f"[{service_api}] is no longer the current service api handle for [{name}]", 0
        del self.service_apis[name]
        self.services.entries.pop(name, None)
        self._drop_if_idle(node)
        return 1, f"Unregistered [{node}] as provider of [{name}]", 1

    def unregister_node(self, node: str) -> None:
        """Remove a node from all tables."""
        for table in self._tables():
            table.remove_node(node)
        for name in [name for name, (provider, _) in self.service_apis.items() if provider == node]:
            del self.service_apis[name]
        self.nodes.pop(node, None)

    def _drop_if_idle(self, node: str) -> None:
        if not any(table.has_node(node) for table in self._tables()):
            del self.nodes[node]

    def _tables(self) -> Iterable[RegistrationTable]:
        return self.publishers, self.subscribers, self.services, self.parameters
