"""Nodes of the graph."""

import sys
import time
from typing import Any

import rosgraph
from rosgraph.network import parse_http_host_and_port
from rosgraph.server_proxy import ServerProxy

ID = "/rosnode"


class ROSNodeException(Exception):
    """Base class."""


class ROSNodeIOException(ROSNodeException):
    """The master does not respond."""


def get_api_uri(master: Any, caller_id: str, skip_cache: bool = False) -> str | None:
    """URI of a node's API; None for an unknown node.

    Raises:
        ROSNodeIOException: the master does not answer.
    """
    del skip_cache
    try:
        return master.lookupNode(caller_id)
    except rosgraph.MasterException:
        return None
    except OSError:
        raise ROSNodeIOException("Unable to communicate with master!") from None


def get_node_names(namespace: str | None = None) -> list[str]:
    """Names of all nodes, or of those in a namespace.

    Raises:
        ROSNodeIOException: the master does not answer.
    """
    try:
        state = rosgraph.Master(ID).getSystemState()
    except OSError:
        raise ROSNodeIOException("Unable to communicate with master!") from None
    names = {node for kind in state for _, nodes in kind for node in nodes}
    if namespace:
        prefix = rosgraph.names.make_global_ns(namespace)
        names = {node for node in names if node == namespace or node.startswith(prefix)}
    return sorted(names)


def get_machines_by_nodes() -> list[str]:
    """Hosts of the nodes."""
    return sorted({host for node in get_node_names() if (host := _host(node)) is not None})


def get_nodes_by_machine(machine: str) -> list[str]:
    """Nodes on a host."""
    return [node for node in get_node_names() if _host(node) == machine]


def _host(node: str) -> str | None:
    uri = get_api_uri(rosgraph.Master(ID), node)
    return None if uri is None else parse_http_host_and_port(uri)[0]


def kill_nodes(node_names: list[str]) -> tuple[list[str], list[str]]:
    """Shut nodes down; returns the names of known and of unknown nodes."""
    master = rosgraph.Master(ID)
    uris = {name: get_api_uri(master, name) for name in node_names}
    for uri in uris.values():
        if uri is not None:
            try:
                ServerProxy(uri).shutdown(ID, "user request")
            except Exception:  # the node may end before it responds
                continue
    return [name for name, uri in uris.items() if uri], [name for name, uri in uris.items() if not uri]


def rosnode_ping(node_name: str, max_count: int | None = None, verbose: bool = False, skip_cache: bool = False) -> bool:
    """Call a node's API once per second; True if it responds."""
    uri = get_api_uri(rosgraph.Master(ID), node_name, skip_cache)
    if not uri:
        print(f"cannot ping [{node_name}]: unknown node", file=sys.stderr)
        return False
    times: list[float] = []
    while max_count is None or len(times) < max_count:
        begin = time.time()
        try:
            ServerProxy(uri).getPid(ID)
        except OSError:
            print(f"ERROR: connection refused to [{uri}]", file=sys.stderr)
            return False
        times.append((time.time() - begin) * 1000)
        if verbose:
            print(f"xmlrpc reply from {uri}\ttime={times[-1]:f}ms")
        if len(times) != max_count:
            time.sleep(1.0)
    if verbose and len(times) > 1:
        print(f"ping average: {sum(times) / len(times):f}ms")
    return True


def rosnode_ping_all(verbose: bool = False, skip_cache: bool = False) -> tuple[list[str], list[str]]:
    """Names of the nodes that respond, and of those that do not."""
    responses = {
        name: rosnode_ping(name, max_count=1, verbose=verbose, skip_cache=skip_cache) for name in get_node_names()
    }
    return (
        [name for name, is_alive in responses.items() if is_alive],
        [name for name, is_alive in responses.items() if not is_alive],
    )


def rosnode_listnodes(namespace: str | None = None, list_uri: bool = False, list_all: bool = False) -> None:
    """Print the nodes."""
    master = rosgraph.Master(ID)
    for name in get_node_names(namespace):
        print(f"{get_api_uri(master, name)} \t{name}" if list_all else get_api_uri(master, name) if list_uri else name)


def rosnodemain(argv: list[str] | None = None) -> None:
    """Run the command rosnode with its arguments; default: this process's arguments.

    Raises:
        SystemExit: always, with the exit code.
    """
    from trundle.app.cli.main import main

    sys.exit(main(["node", *(sys.argv if argv is None else argv)[1:]]))
