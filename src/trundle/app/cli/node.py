"""List, describe, ping and stop nodes, as rosnode does."""

import argparse
import re
import socket
import sys
import time
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.ros import MasterError, MasterProxy, RosError, blocking_call, uri_host

from .graph_command import global_name, master, ros_errors
from .prompt import read_line, read_number

EXAMPLES = """
  trundle node list
  trundle node info /robot_state_publisher
  trundle node ping -a
  trundle node kill /robot_state_publisher
  trundle node cleanup
  trundle node machine
"""
_SCRIPT = "rosnode"
_CALLER = "/rosnode"
_NODE_TIMEOUT_S = 3.0
_CONNECTION = re.compile(r"\w+ connection on port (\d+) to \[(.*) on socket (\d+)\]")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    add = commands.add_parser("list", help="names of all nodes")
    add.add_argument("namespace", nargs="?", help="only nodes below this namespace")
    add.add_argument("-u", dest="uris", action="store_true", help="addresses instead of names")
    add.add_argument("-a", "--all", action="store_true", help="addresses and names")
    add.set_defaults(run=_list)
    add = commands.add_parser("info", help="topics, services and connections of nodes")
    add.add_argument("nodes", nargs="+", help="names of the nodes")
    add.add_argument("-q", "--quiet", action="store_true", help="ask the master only, not the nodes")
    add.set_defaults(run=_info)
    add = commands.add_parser("ping", help="check whether nodes answer")
    add.add_argument("node", nargs="?", help="name of the node; none with --all")
    add.add_argument("-a", "--all", action="store_true", help="every node, once")
    add.add_argument("-c", dest="count", type=int, help="stop after N answers")
    add.set_defaults(run=_ping, refuse=add.error)
    add = commands.add_parser("kill", help="ask nodes to shut down")
    add.add_argument("nodes", nargs="*", help="names of the nodes; none: a choice of all")
    add.add_argument("-a", "--all", action="store_true", help="every node")
    add.set_defaults(run=_kill)
    add = commands.add_parser("cleanup", help="unregister nodes that do not answer")
    add.set_defaults(run=_cleanup)
    add = commands.add_parser("machine", help="machines with nodes, or the nodes of one machine")
    add.add_argument("machine", nargs="?", help="name or address of the machine; none: all machines")
    add.set_defaults(run=_machine)


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _names(state: Any) -> list[str]:
    return sorted({node for table in state for _, nodes in table for node in nodes})


def _uri(proxy: MasterProxy, node: str) -> str | None:
    try:
        return str(proxy.call("lookupNode", node))
    except MasterError:
        return None


def _call_node(uri: str, method: str, *arguments: object) -> Any:
    """Call a node's slave API.

    Raises:
        OSError, RosError: no answer, or an answer with a failure.
    """
    code, text, value = blocking_call(uri, method, _CALLER, *arguments, timeout_s=_NODE_TIMEOUT_S)
    if code != 1:
        raise RosError(f"remote call failed: {text}")
    return value


def _list(args: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    nodes = _names(proxy.call("getSystemState"))
    if args.namespace:
        name = global_name(args.namespace, _SCRIPT)
        nodes = [node for node in nodes if node == name or node.startswith(name.rstrip("/") + "/")]
    if args.all:
        nodes = [f"{_uri(proxy, node) or 'unknown address'} \t{node}" for node in nodes]
    elif args.uris:
        nodes = [_uri(proxy, node) or "unknown address" for node in nodes]
    print("\n".join(nodes))
    return 0


def _info(args: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    code = 0
    for node in args.nodes:
        name = global_name(node, _SCRIPT)
        state = proxy.call("getSystemState")
        print("-" * 80)
        print(_description(name, state, dict(proxy.call("getPublishedTopics", "/"))))
        uri = _uri(proxy, name)
        if uri is None:
            print(f"cannot contact [{name}]: unknown node", file=sys.stderr)
            code = 1
        elif not args.quiet:
            print(f"\ncontacting node {uri} ...")
            try:
                print(_connections(proxy, uri, state))
            except (OSError, RosError):
                raise RosError(f"Communication with node[{uri}] failed!") from None
    return code


def _description(node: str, state: Any, types: dict[str, str]) -> str:
    lines = [f"Node [{node}]"]
    for title, table, typed in zip(("Publications", "Subscriptions", "Services"), state, (1, 1, 0), strict=True):
        names = sorted(name for name, nodes in table if node in nodes)
        lines.append(f"{title}: " + ("" if names else "None"))
        lines += [f" * {name}" + (f" [{types.get(name, 'unknown type')}]" if typed else "") for name in names]
        lines.append("")
    return "\n".join(lines)


def _connections(proxy: MasterProxy, uri: str, state: Any) -> str:
    text = f"Pid: {_call_node(uri, 'getPid')}\n"
    links = [link for link in _call_node(uri, "getBusInfo") if len(link) < 6 or link[5]]
    if links:
        text += "Connections:\n"
    for _, peer, direction, transport, topic, *more in links:
        text += f" * topic: {topic}\n    * to: {_peer_name(proxy, state, topic, peer)}\n"
        text += f"    * direction: {({'i': 'inbound', 'o': 'outbound'}).get(direction, 'unknown')}"
        match = _CONNECTION.match(more[1]) if len(more) > 1 else None
        text += " ({} - {}) [{}]".format(*match.groups()) if match else ""
        text += f"\n    * transport: {transport}\n"
    return text


def _peer_name(proxy: MasterProxy, state: Any, topic: str, peer: str) -> str:
    """Return the name of the node at an address."""
    if peer.startswith("http://"):
        for name, nodes in [*state[0], *state[1]]:
            if name == topic:
                for node in nodes:
                    if _uri(proxy, node) == peer:
                        return f"{node} ({peer})"
    return peer


def _ping(args: argparse.Namespace) -> int:
    if args.all:
        if args.node or args.count:
            args.refuse("-a pings every node once; it excludes a node's name and -c")
        nodes = _names(master(_SCRIPT).call("getSystemState"))
        print("Will ping the following nodes: \n" + "".join(f" * {node}\n" for node in nodes))
        answers = [_ping_one(node, 1) for node in nodes]
        return 0 if all(answers) else 1
    if not args.node:
        nodes = "\n".join(_names(master(_SCRIPT).call("getSystemState")))
        args.refuse(f"Please enter a node to ping. Available nodes are:\n{nodes}")
    name = global_name(args.node, _SCRIPT)
    print(f"rosnode: node is [{name}]")
    return 0 if _ping_one(name, args.count) else 1


def _ping_one(node: str, count: int | None) -> bool:
    uri = _uri(master(_SCRIPT), node)
    if uri is None:
        print(f"cannot ping [{node}]: unknown node", file=sys.stderr)
        return False
    print(f"pinging {node} with a timeout of {_NODE_TIMEOUT_S}s", flush=True)
    times: list[float] = []
    try:
        while True:
            start = time.perf_counter()
            _call_node(uri, "getPid")
            times.append((time.perf_counter() - start) * 1000.0)
            print(f"xmlrpc reply from {uri}\ttime={times[-1]:f}ms", flush=True)
            if count and len(times) >= count:
                break
            time.sleep(1.0)
    except TimeoutError:
        print(f"connection to [{node}] timed out", file=sys.stderr)
        return False
    except ConnectionRefusedError:
        print(f"ERROR: connection refused to [{uri}]", file=sys.stderr)
        return False
    except (OSError, RosError):
        print(f"connection to [{node}] failed", file=sys.stderr)
        return False
    finally:
        if len(times) > 1:
            print(f"ping average: {sum(times) / len(times):f}ms")
    return True


def _kill(args: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    running = _names(proxy.call("getSystemState"))
    if args.all:
        nodes = running
    elif args.nodes:
        nodes = [global_name(node, _SCRIPT) for node in args.nodes]
        if unknown := [node for node in nodes if node not in running]:
            raise RosError("Unknown node(s):\n" + "\n".join(f" * {node}" for node in unknown))
    else:
        nodes = [_choose_node(running)] if running else []
    if not nodes:
        print("No nodes running", file=sys.stderr)
        return 0
    print("killing:\n" + "\n".join(f" * {node}" for node in nodes) if len(nodes) > 1 else f"killing {nodes[0]}")
    failed: list[str] = []
    for node in nodes:
        uri = _uri(proxy, node)
        try:
            if uri is None:
                failed.append(node)
            else:
                _call_node(uri, "shutdown", "user request")
        except (OSError, RosError):  # many nodes end before they answer
            pass
    if failed:
        print("ERROR: Failed to kill:\n" + "\n".join(f" * {node}" for node in failed), file=sys.stderr)
        return 1
    print("killed")
    return 0


def _choose_node(nodes: list[str]) -> str:
    """Prompt for a node."""
    print("\n".join(f"{i}. {node}" for i, node in enumerate(nodes, 1)))
    print("\nPlease enter the number of the node you wish to kill.\n> ", end="", flush=True)
    return nodes[read_number(len(nodes)) - 1]


def _cleanup(_: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    state = proxy.call("getSystemState")
    dead = [node for node in _names(state) if not _answers(_uri(proxy, node))]
    if not dead:
        return 0
    print("Unable to contact the following nodes:")
    print("\n".join(f" * {node}" for node in dead))
    print("Warning: these might include alive and functioning nodes, e.g. in unstable networks.")
    print("Cleanup will purge all information about these nodes from the master.")
    print("Please type y or n to continue:", flush=True)
    while (answer := read_line()) not in ("y", "n"):
        pass
    if answer != "y":
        print("aborting")
        return 0
    for node in dead:
        print("Unregistering", node)
        _unregister(node, _uri(proxy, node) or "", state, proxy)
    print("done")
    return 0


def _answers(uri: str | None) -> bool:
    try:
        return uri is not None and bool(_call_node(uri, "getPid"))
    except (OSError, RosError):
        return False


def _unregister(node: str, uri: str, state: Any, proxy: MasterProxy) -> None:
    as_node = MasterProxy(proxy.uri, node)
    publishers, subscribers, services = ([n for n, nodes in table if node in nodes] for table in state)
    for topic in publishers:
        as_node.call("unregisterPublisher", topic, uri)
    for topic in subscribers:
        as_node.call("unregisterSubscriber", topic, uri)
    for service in services:
        as_node.call("unregisterService", service, proxy.call("lookupService", service))


def _machine(args: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    hosts = {node: uri_host(_uri(proxy, node) or "") for node in _names(proxy.call("getSystemState"))}
    if args.machine:
        address = _address(args.machine)
        if address is None:
            raise UsageError(f"cannot resolve machine name [{args.machine}] to address")
        print("\n".join(node for node, host in hosts.items() if host and _address(host) == address))
    else:
        print("\n".join(sorted({host for host in hosts.values() if host})))
    return 0


def _address(host: str) -> str | None:
    try:
        return socket.gethostbyname(host)
    except OSError:
        return None
