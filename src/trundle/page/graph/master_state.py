"""State of the master: topics with types, nodes of topics and services."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, cast

from trundle.ros import Node

from ..clients.server_messages import ConnectionGraphUpdate, ProvidedService, PublishedTopic, SubscribedTopic

Nodes: TypeAlias = Mapping[str, tuple[str, ...]]
"""Name of a topic or service → names of nodes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MasterState:
    """State of a master at one time."""

    publishers: Nodes = field(default_factory=dict[str, tuple[str, ...]])
    subscribers: Nodes = field(default_factory=dict[str, tuple[str, ...]])
    services: Nodes = field(default_factory=dict[str, tuple[str, ...]])
    types: Mapping[str, str] = field(default_factory=dict[str, str])
    """Topic → type; '*' if only subscribers to any type are known."""


async def read_state(node: Node) -> MasterState:
    """Read the master's state.

    Raises:
        MasterUnreachableError: the master does not answer.
        MasterError: the master answers with an error.
    """
    publishers, subscribers, services = cast(
        list[list[tuple[str, list[str]]]], await node.master.call("getSystemState")
    )
    types = cast(list[tuple[str, str]], await node.master.call("getTopicTypes"))
    return MasterState(
        publishers=_nodes(publishers),
        subscribers=_nodes(subscribers),
        services=_nodes(services),
        types=dict(types),
    )


def graph_update(before: MasterState, after: MasterState) -> ConnectionGraphUpdate | None:
    """Return the changes from one state to the next; None: nothing changed."""
    published = _changes(before.publishers, after.publishers)
    subscribed = _changes(before.subscribers, after.subscribers)
    provided = {name: nodes for name, nodes in _changes(before.services, after.services).items() if nodes}
    topics = after.publishers.keys() | after.subscribers.keys()
    removed_topics = sorted((before.publishers.keys() | before.subscribers.keys()) - topics)
    removed_services = sorted(before.services.keys() - after.services.keys())
    if not (published or subscribed or provided or removed_topics or removed_services):
        return None
    return ConnectionGraphUpdate(
        published_topics=tuple(PublishedTopic(name, nodes) for name, nodes in published.items() if name in topics),
        subscribed_topics=tuple(
            SubscribedTopic(name, nodes, after.types.get(name, "*"))
            for name, nodes in subscribed.items()
            if name in topics
        ),
        advertised_services=tuple(ProvidedService(name, nodes) for name, nodes in provided.items()),
        removed_topics=tuple(removed_topics),
        removed_services=tuple(removed_services),
    )


def _changes(before: Nodes, after: Nodes) -> Nodes:
    """Return the names whose nodes have changed, with their new nodes."""
    names = sorted(before.keys() | after.keys())
    return {name: after.get(name, ()) for name in names if before.get(name, ()) != after.get(name, ())}


def _nodes(rows: list[tuple[str, list[str]]]) -> dict[str, tuple[str, ...]]:
    return {name: tuple(sorted(nodes)) for name, nodes in rows}
