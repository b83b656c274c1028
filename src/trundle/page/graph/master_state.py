"""State of the master: topics with types, nodes of topics and services."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, cast

from trundle.ros import Node

Nodes: TypeAlias = Mapping[str, tuple[str, ...]]
"""Name of a topic or service → names of nodes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MasterState:
    """Answer of a master at one moment."""

    publishers: Nodes = field(default_factory=dict[str, tuple[str, ...]])
    subscribers: Nodes = field(default_factory=dict[str, tuple[str, ...]])
    services: Nodes = field(default_factory=dict[str, tuple[str, ...]])
    types: Mapping[str, str] = field(default_factory=dict[str, str])
    """Topic → type; '*' where only subscribers of any type are known."""


async def read_state(node: Node) -> MasterState:
    """Ask the master.

    Raises:
        MasterUnreachableError: no answer.
        MasterError: another answer.
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


def graph_update(before: MasterState, after: MasterState) -> dict[str, object] | None:
    """Return the `connectionGraphUpdate` message from one state to the next; None: nothing changed.

    Beyond the Foxglove protocol a subscribed topic has its type, since without a publisher it has no channel.
    """
    published = _changes("publisherIds", before.publishers, after.publishers)
    subscribed = [
        change | {"type": after.types.get(str(change["name"]), "*")}
        for change in _changes("subscriberIds", before.subscribers, after.subscribers)
    ]
    provided = [change for change in _changes("providerIds", before.services, after.services) if change["providerIds"]]
    topics = after.publishers.keys() | after.subscribers.keys()
    removed_topics = sorted((before.publishers.keys() | before.subscribers.keys()) - topics)
    removed_services = sorted(before.services.keys() - after.services.keys())
    if not (published or subscribed or provided or removed_topics or removed_services):
        return None
    gone = set(removed_topics)
    return {
        "op": "connectionGraphUpdate",
        "publishedTopics": [change for change in published if change["name"] not in gone],
        "subscribedTopics": [change for change in subscribed if change["name"] not in gone],
        "advertisedServices": provided,
        "removedTopics": removed_topics,
        "removedServices": removed_services,
    }


def _changes(field_name: str, before: Nodes, after: Nodes) -> list[dict[str, object]]:
    names = sorted(before.keys() | after.keys())
    return [
        {"name": name, field_name: after.get(name, ())} for name in names if before.get(name, ()) != after.get(name, ())
    ]


def _nodes(rows: list[tuple[str, list[str]]]) -> dict[str, tuple[str, ...]]:
    return {name: tuple(sorted(nodes)) for name, nodes in rows}
