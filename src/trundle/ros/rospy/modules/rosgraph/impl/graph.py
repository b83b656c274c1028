"""Graph of nodes, topics and connections, queried from the master and the nodes; for programs that draw it."""

import itertools
import logging
import random
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from rosgraph.masterapi import Master, MasterException
from rosgraph.server_proxy import ServerProxy

logger = logging.getLogger("rosgraph.graph")
_CALLER = "/rosviz"
_STALE_S = 5.0
_TIMEOUT_S = 1.0
_PAUSE_S = 0.01
_TOPIC_FIELD = 4
"""Position of the topic in an entry of getBusInfo; older nodes send shorter ones without it."""


def topic_node(topic: str) -> str:
    """Name of a topic among the nodes: with a space before it, which no node's name has."""
    return f" {topic}"


def node_topic(node: str) -> str:
    """Topic of a name from `topic_node`."""
    return node[1:]


class BadNode:
    """A node that did not respond."""

    DEAD, WONKY = 0, 1

    def __init__(self, name: str, type: int, reason: str) -> None:
        self.name, self.type, self.reason = name, type, reason


class Edge:
    """A connection."""

    __slots__ = ("end", "key", "label", "rkey", "start")
    __hash__ = None  # pyright: ignore[reportAssignmentType]

    def __init__(self, start: str, end: str, label: str = "") -> None:
        self.start, self.end, self.label = start, end, label
        self.key, self.rkey = f"{start}|{label}", f"{end}|{label}"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Edge) and (self.start, self.end) == (other.start, other.end)

    def __str__(self) -> str:
        return f"{self.start}->{self.end}"


def edge_args(start: str, dest: str, direction: str, label: str) -> list[tuple[str, str, str]]:
    """Arguments of `Edge` for the edges between two names.

    Args:
        start: first name.
        dest: second name.
        direction: 'o': from start, 'i': to it, 'b': both.
        label: label of the edges.
    """
    out = [(start, dest, label)] if direction in ("o", "b") else []
    return [*out, (dest, start, label)] if direction in ("i", "b") else out


class EdgeList:
    """Edges, by their start and by their end."""

    __slots__ = ("edges_by_end", "edges_by_start")

    def __init__(self) -> None:
        self.edges_by_start: dict[str, list[Edge]] = {}
        self.edges_by_end: dict[str, list[Edge]] = {}

    def __iter__(self) -> Iterator[Edge]:
        return itertools.chain.from_iterable(self.edges_by_start.values())

    def __contains__(self, edge: Edge) -> bool:
        return edge in self.edges_by_start.get(edge.key, ())

    def has(self, edge: Edge) -> bool:
        """True if the list contains the edge."""
        return edge in self

    def add(self, edge: Edge) -> bool:
        """Add an edge; False if the list contains it already."""
        is_new = False
        for edges in (
            self.edges_by_start.setdefault(edge.key, []),
            self.edges_by_end.setdefault(edge.rkey, []),
        ):
            if edge not in edges:
                edges.append(edge)
                is_new = True
        return is_new

    def add_edges(self, start: str | None, dest: str | None, direction: str, label: str = "") -> bool:
        """Add the edges between two names; True if one is new."""
        if not start or not dest:
            logger.warning("cannot add edge: no node's name for %s", "start" if not start else "dest")
            return False
        added = [self.add(Edge(*arguments)) for arguments in edge_args(start, dest, direction, label)]
        return any(added)

    def delete(self, edge: Edge) -> None:
        """Remove an edge."""
        for edges in (self.edges_by_start.get(edge.key, []), self.edges_by_end.get(edge.rkey, [])):
            if edge in edges:
                edges.remove(edge)

    def delete_all(self, node: str) -> None:
        """Remove the edges that start or end at a name."""
        for edge in [edge for edge in self if node in (edge.start, edge.end)]:
            self.delete(edge)


class Graph:
    """State of the graph, as of the last queries."""

    def __init__(self, node_ns: str = "/", topic_ns: str = "/") -> None:
        """Create an empty graph.

        Args:
            node_ns: prefix of the nodes to include.
            topic_ns: prefix of the topics to include.
        """
        self.master = Master(_CALLER)
        self.node_ns, self.topic_ns = node_ns or "/", topic_ns or "/"
        self.nn_nodes: set[str] = set()
        self.nt_nodes: set[str] = set()
        self.srvs: set[str] = set()
        self.bad_nodes: dict[str, BadNode] = {}
        self.bad_nodes_lock = threading.Lock()
        self.nn_edges, self.nt_edges, self.nt_all_edges = EdgeList(), EdgeList(), EdgeList()
        self.node_uri_map: dict[str, str] = {}
        self.uri_node_map: dict[str, str] = {}
        self.master_stale = self.node_stale = _STALE_S
        self.last_master_refresh = 0.0
        self.last_node_refresh: dict[str, float] = {}

    def set_master_stale(self, stale_secs: float) -> None:
        """Set the age [s] after which the master is queried again."""
        self.master_stale = stale_secs

    def set_node_stale(self, stale_secs: float) -> None:
        """Set the age [s] after which a node is queried again."""
        self.node_stale = stale_secs

    def update(self) -> bool:
        """Query the master and the nodes whose state is stale; True if anything changed."""
        updated = False
        if time.time() > self.last_master_refresh + self.master_stale:
            updated = self._query_master()
            if not self.last_master_refresh:
                for node in self.nn_nodes:
                    self._find_uri(node)
            self.last_master_refresh = time.time()
        return self._query_nodes(list(self.nn_nodes), self._query_node) or updated

    def bad_update(self) -> bool:
        """Query the nodes again that did not respond; True if anything changed."""
        with self.bad_nodes_lock:
            names = list(self.bad_nodes)
        return self._query_nodes(names, self._query_bad_node)

    def _query_nodes(self, names: Iterable[str], query: Callable[[str], bool]) -> bool:
        updated = False
        for node in names:
            if time.time() > self.last_node_refresh.get(node, 0.0) + self.node_stale:
                updated = query(node) or updated
                # stale at different times, so that one update does not query all nodes
                self.last_node_refresh[node] = time.time() + random.random() * self.node_stale / 5.0
            time.sleep(_PAUSE_S)
        return updated

    def _query_master(self) -> bool:
        try:
            publishers, subscribers, services = self.master.getSystemState()
        except (MasterException, OSError) as error:
            print("Unable to contact master", error, file=sys.stderr)
            return False
        updated = False
        nodes: set[str] = set()
        for state, direction in ((publishers, "o"), (subscribers, "i")):
            for topic, names in state:
                if topic.startswith(self.topic_ns):
                    nodes.update(name for name in names if name.startswith(self.node_ns))
                    self.nt_nodes.add(topic_node(topic))
                    for name in names:
                        updated = self.nt_all_edges.add_edges(name, topic_node(topic), direction) or updated
        for removed in self.nn_nodes - nodes:
            for edges in (self.nn_edges, self.nt_edges, self.nt_all_edges):
                edges.delete_all(removed)
        names = {name for name, _ in services}
        updated = updated or (nodes, names) != (self.nn_nodes, self.srvs)
        self.nn_nodes, self.srvs = nodes, names
        return updated

    def _find_uri(self, node: str) -> str | None:
        try:
            uri = str(self.master.lookupNode(node))
        except (MasterException, OSError) as error:
            logger.warning("master reported error in node lookup: %s", error)
            return None
        self.node_uri_map[node], self.uri_node_map[uri] = uri, node
        return uri

    def _query_bad_node(self, node: str) -> bool:
        with self.bad_nodes_lock:
            self.bad_nodes[node].type = BadNode.WONKY
        return self._query_node(node)

    def _query_node(self, node: str) -> bool:
        """Query a node for its connections; a node that does not respond becomes a BadNode."""
        uri = self._find_uri(node)
        if uri is None:
            return False
        try:
            code, text, connections = ServerProxy(uri, timeout_s=_TIMEOUT_S).getBusInfo(_CALLER)
            if code == 1:
                entries = [entry for entry in connections if len(entry) > _TOPIC_FIELD]
                changed = [self._add_connection(node, *entry) for entry in entries]
                return any(changed)
        except (OSError, TypeError, ValueError, AttributeError) as error:  # no response, or an invalid one
            text = str(error)
        with self.bad_nodes_lock:
            self.bad_nodes[node] = BadNode(node, BadNode.DEAD, text)
        return False

    def _add_connection(
        self, node: str, number: Any, other: Any, direction: str, transport: str, topic: str,
        is_connected: bool = True, *rest: Any,
    ) -> bool:  # fmt: skip
        del number, transport, rest
        if not topic.startswith(self.topic_ns) or not is_connected:
            return False
        self.nt_nodes.add(topic_node(topic))
        updated = self.nt_edges.add_edges(node, topic_node(topic), direction)
        if str(other).startswith("http://"):  # subscribers list their peers by URI, publishers by name
            updated = self.nn_edges.add_edges(node, self.uri_node_map.get(other), direction, topic) or updated
        return updated
