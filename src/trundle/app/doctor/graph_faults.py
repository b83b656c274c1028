"""Faults of a running graph, as roswtf finds them."""

import socket
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from trundle.ros import MasterProxy, RosError, blocking_call, uri_host

_CALLER = "/roswtf"
_TIMEOUT_S = 3.0
_OPTIONAL_TOPICS = frozenset({"/rosout", "/rosout_agg", "/statistics", "/tf", "/tf_static"})
"""Topics with many subscribers that need no publisher."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GraphFault:
    """Fault, with the affected names."""

    is_error: bool
    """True: an error; False: a warning, as it may be intended."""
    what: str
    names: tuple[str, ...]

    def __str__(self) -> str:
        return "\n".join([f"{'ERROR' if self.is_error else 'WARNING'} {self.what}", *(f" * {n}" for n in self.names)])


def graph_faults(proxy: MasterProxy) -> list[GraphFault]:
    """Query the master and every node; return the faults.

    Raises:
        MasterUnreachableError: no master answers.
    """
    publishers, subscribers, services = (dict(table) for table in proxy.call("getSystemState"))
    nodes = sorted(
        {node for table in (publishers, subscribers, services) for names in table.values() for node in names}
    )
    states = {node: _state(proxy, node) for node in nodes}
    dead = {node for node, state in states.items() if state != "alive"}
    unconnected = (
        f"{topic}: {', '.join(names)}"
        for topic, names in sorted(subscribers.items())
        if not publishers.get(topic) and topic not in _OPTIONAL_TOPICS
    )
    unreachable = (
        f"{service} ({node})" for service, names in sorted(services.items()) for node in names if node in dead
    )
    faults = [
        _fault("Could not contact the following nodes:", _nodes_in(states, "dead"), is_error=True),
        _fault("The addresses of the following nodes are unknown here:", _nodes_in(states, "unknown"), is_error=True),
        _fault("The following services belong to nodes that do not answer:", unreachable, is_error=True),
        _fault(
            "The following topics are used with different types:",
            _mismatches(proxy, _nodes_in(states, "alive")),
            is_error=True,
        ),
        _fault("Nodes wait for /clock, which no node publishes:", _waiting(proxy, publishers), is_error=True),
        _fault("The following node subscriptions are unconnected:", unconnected, is_error=False),
    ]
    return [fault for fault in faults if fault.names]


def _fault(what: str, names: Iterator[str], *, is_error: bool) -> GraphFault:
    return GraphFault(is_error=is_error, what=what, names=tuple(names))


def _nodes_in(states: dict[str, str], state: str) -> Iterator[str]:
    return (node for node, node_state in states.items() if node_state == state)


def _state(proxy: MasterProxy, node: str) -> str:
    """Return `alive`, `dead`, or `unknown` if this machine cannot resolve the node's host."""
    try:
        uri = str(proxy.call("lookupNode", node))
        socket.getaddrinfo(uri_host(uri), None)
    except RosError:
        return "dead"
    except OSError:
        return "unknown"
    try:
        return "alive" if blocking_call(uri, "getPid", _CALLER, timeout_s=_TIMEOUT_S)[0] == 1 else "dead"
    except (OSError, RosError):
        return "dead"


def _mismatches(proxy: MasterProxy, nodes: Iterable[str]) -> Iterator[str]:
    """Yield topics that nodes publish and subscribe to with different types, which never connect."""
    users: dict[str, dict[str, list[str]]] = {}
    for node in nodes:
        for method in ("getPublications", "getSubscriptions"):
            try:
                uri = str(proxy.call("lookupNode", node))
                code, _, topics = blocking_call(uri, method, _CALLER, timeout_s=_TIMEOUT_S)
            except (OSError, RosError):
                continue
            for topic, kind in topics if code == 1 else ():
                if kind != "*":
                    users.setdefault(topic, {}).setdefault(kind, []).append(node)
    for topic, kinds in sorted(users.items()):
        if len(kinds) > 1:
            yield f"{topic}: " + "; ".join(f"{kind} by {', '.join(names)}" for kind, names in sorted(kinds.items()))


def _waiting(proxy: MasterProxy, publishers: dict[str, Any]) -> Iterator[str]:
    try:
        if proxy.call("getParam", "/use_sim_time") and not publishers.get("/clock"):
            yield "/use_sim_time is true; a simulator that was started with it may be gone"
    except RosError:  # the parameter is not set
        return
