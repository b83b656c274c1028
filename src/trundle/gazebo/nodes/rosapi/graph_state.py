"""State of the graph, from the master."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass

from trundle.ros import MasterError, Node, ServiceError, probe_service

_ACTION = frozenset({"cancel", "feedback", "goal", "result", "status"})


@dataclass(frozen=True, slots=True, kw_only=True)
class GraphState:
    """Name → nodes."""

    publishers: Mapping[str, list[str]]
    subscribers: Mapping[str, list[str]]
    services: Mapping[str, list[str]]

    @property
    def topics(self) -> set[str]:
        """All topics."""
        return {*self.publishers, *self.subscribers}

    @property
    def nodes(self) -> list[str]:
        """All nodes."""
        tables = (self.publishers, self.subscribers, self.services)
        return sorted({node for table in tables for nodes in table.values() for node in nodes})


async def read_graph(node: Node) -> GraphState:
    """Read the graph's state from the master.

    Raises:
        MasterUnreachableError: no answer.
    """
    tables = await node.master.call("getSystemState")
    publishers, subscribers, services = ({name: list(nodes) for name, nodes in table} for table in tables)
    return GraphState(publishers=publishers, subscribers=subscribers, services=services)


async def topic_types(node: Node) -> dict[str, str]:
    """Return topic → type, without topics of unknown type."""
    return {name: kind for name, kind in await node.master.call("getTopicTypes") if kind != "*"}


async def service_type(node: Node, service: str) -> str:
    """Return the type of a service; '' if it does not exist."""
    try:
        uri = str(await node.master.call("lookupService", service))
        return (await probe_service(uri, service, node.name)).get("type", "")
    except (MasterError, ServiceError):
        return ""


async def service_types(node: Node, services: list[str]) -> dict[str, str]:
    """Return service → type."""
    types = await asyncio.gather(*(service_type(node, service) for service in services))
    return dict(zip(services, types, strict=True))


def action_servers(topics: set[str]) -> list[str]:
    """Return the namespaces with all five topics of an action."""
    topics_by_namespace: dict[str, set[str]] = {}
    for topic in topics:
        namespace, _, name = topic.rpartition("/")
        if namespace and name in _ACTION:
            topics_by_namespace.setdefault(namespace, set()).add(name)
    return sorted(namespace for namespace, names in topics_by_namespace.items() if names >= _ACTION)
