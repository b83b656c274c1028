"""List, print, measure and publish topics, as rostopic does."""

import argparse

from trundle.base.diagnostics import UsageError
from trundle.ros import MasterError, MasterProxy, RosError, uri_host

from ..graph_command import IntermixedParser, global_name, master, ros_errors

EXAMPLES = """
  trundle topic list
  trundle topic info /odom
  trundle topic type /odom/pose
  trundle topic find geometry_msgs/Twist
  trundle topic echo /odom
  trundle topic echo /odom/pose/pose/position -n 1
  trundle topic hz /scan
  trundle topic delay /scan
  trundle topic bw /camera/image_raw
  trundle topic pub -1 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.5}}'
  trundle topic pub -r 10 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.5}}'
"""
_SCRIPT = "rostopic"
Rows = list[tuple[str, str, list[str]]]
"""(topic, type, nodes)"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=IntermixedParser)
    add = commands.add_parser("list", help="names of all topics")
    add.add_argument("topic", nargs="?", help="topic or namespace to list")
    add.add_argument("-b", "--bag", metavar="BAG", help="topics in a bag")
    add.add_argument("-v", "--verbose", action="store_true", help="with types and counts")
    only = add.add_mutually_exclusive_group()
    only.add_argument("-p", dest="publishers", action="store_true", help="published topics only")
    only.add_argument("-s", dest="subscribers", action="store_true", help="subscribed topics only")
    add.add_argument("--host", action="store_true", help="grouped by machine")
    add.set_defaults(run=_list)
    add = commands.add_parser("info", help="type, publishers and subscribers of a topic")
    add.add_argument("topic", help="name of the topic")
    add.set_defaults(run=_info)
    add = commands.add_parser("type", help="type of a topic or of a field of its messages")
    add.add_argument("topic", help="name of the topic")
    add.set_defaults(run=_type)
    add = commands.add_parser("find", help="topics of a type")
    add.add_argument("type", help="type, as geometry_msgs/Twist")
    add.set_defaults(run=_find)
    # Subcommands with messages are in separate modules, imported on use.
    add = commands.add_parser("echo", help="print messages")
    add.add_argument("topic", nargs="?", help="topic or field, as /odom/pose/pose or /tf/transforms[0]")
    add.add_argument("-b", "--bag", metavar="BAG", help="print from a bag")
    add.add_argument("-a", "--all", action="store_true", help="all messages of the bag")
    add.add_argument("-n", dest="count", type=int, metavar="COUNT", help="stop after COUNT messages")
    add.add_argument("-p", dest="plot", action="store_true", help="comma-separated values for plotting")
    add.add_argument("-w", dest="width", type=int, metavar="NUM_WIDTH", help="width of numbers")
    add.add_argument("--filter", metavar="EXPR", help="Python expression of m that selects messages to print")
    add.add_argument("--nostr", action="store_true", help="hide strings")
    add.add_argument("--noarr", action="store_true", help="hide arrays")
    add.add_argument("-c", "--clear", action="store_true", help="clear the screen before each message")
    add.add_argument("--offset", action="store_true", help="print times relative to now")
    add.set_defaults(run=_echo, refuse=add.error)
    add = commands.add_parser("hz", help="measure the rate of topics")
    add.add_argument("topics", nargs="+", help="names of the topics")
    add.add_argument("-w", "--window", type=int, default=-1, help="window of the averages [messages]")
    add.add_argument("--filter", metavar="EXPR", help="Python expression of m that selects messages to count")
    add.add_argument("--wall-time", action="store_true", help="measure in wall time, not simulated time")
    add.add_argument("--tcpnodelay", action="store_true", help="ask publishers for small delays")
    add.set_defaults(run=_rate)
    add = commands.add_parser("delay", help="measure the delay of messages from their header's stamp")
    add.add_argument("topics", nargs=1, metavar="topic", help="name of the topic")
    add.add_argument("-w", "--window", type=int, default=-1, help="window of the averages [messages]")
    add.add_argument("--tcpnodelay", action="store_true", help="ask publishers for small delays")
    add.set_defaults(run=_rate)
    add = commands.add_parser("bw", help="measure the bandwidth of a topic")
    add.add_argument("topics", nargs=1, metavar="topic", help="name of the topic")
    add.add_argument("-w", "--window", type=int, default=100, help="window of the averages [messages]")
    add.set_defaults(run=_rate)
    add = commands.add_parser("pub", help="publish messages")
    add.add_argument("topic", help="name of the topic")
    add.add_argument("type", help="such as geometry_msgs/Twist")
    add.add_argument("values", nargs="*", help="message as YAML, or its fields in order")
    add.add_argument("-r", "--rate", type=float, metavar="HZ", help="publish periodically")
    add.add_argument("-1", "--once", action="store_true", help="publish one message and stop after 3 s")
    add.add_argument("-f", "--file", help="read messages from a file of YAML documents")
    add.add_argument("-l", "--latch", action="store_true", help="latch with -r, -f or piped messages too")
    add.add_argument(
        "-s", "--substitute-keywords", action="store_true", help="with -r, update 'now' and 'auto' each time"
    )
    add.add_argument("--use-rostime", action="store_true", help="use simulated time for 'now' and 'auto'")
    add.add_argument("-v", "--verbose", action="store_true", help="print what is published")
    add.set_defaults(run=_pub, refuse=add.error)


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return int(args.run(args))


def _echo(args: argparse.Namespace) -> int:
    from .echo import main

    return main(args)


def _rate(args: argparse.Namespace) -> int:
    from .measure import main

    return main(args)


def _pub(args: argparse.Namespace) -> int:
    from .pub import main

    return main(args)


def _tables(proxy: MasterProxy) -> tuple[Rows, Rows]:
    publishers, subscribers, _ = proxy.call("getSystemState")
    types = dict(proxy.call("getTopicTypes"))

    def rows(table: list[tuple[str, list[str]]]) -> Rows:
        return [(topic, types.get(topic, "unknown type"), nodes) for topic, nodes in table]

    return rows(publishers), rows(subscribers)


def _list(args: argparse.Namespace) -> int:
    if args.bag:
        from .echo import list_bag

        return list_bag(args)
    proxy = master(_SCRIPT)
    publishers, subscribers = _tables(proxy)
    if args.topic:
        name = global_name(args.topic, _SCRIPT)
        publishers, subscribers = (
            [row for row in rows if row[0] == name or row[0].startswith(name.rstrip("/") + "/")]
            for rows in (publishers, subscribers)
        )
    if not args.host:
        _print_list(args, publishers, subscribers, "")
        return 0
    hosts = _hosts(proxy, publishers + subscribers)
    for host in sorted(set(hosts.values())):
        tables = [
            [(topic, kind, local) for topic, kind, nodes in rows if (local := [n for n in nodes if hosts[n] == host])]
            for rows in (publishers, subscribers)
        ]
        if (tables[0] and not args.subscribers) or (tables[1] and not args.publishers):
            print(f"Host [{host}]:")
            _print_list(args, tables[0], tables[1], "  ")
    return 0


def _hosts(proxy: MasterProxy, rows: Rows) -> dict[str, str]:
    nodes = {node for _, _, nodes in rows for node in nodes}
    return {node: uri_host(str(proxy.call("lookupNode", node))) for node in nodes}


def _print_list(args: argparse.Namespace, publishers: Rows, subscribers: Rows, indent: str) -> None:
    if not args.verbose:
        rows = publishers if args.publishers else subscribers if args.subscribers else publishers + subscribers
        print("\n".join(indent + topic for topic in sorted({row[0] for row in rows})))
        return
    if not args.subscribers:
        print(f"\n{indent}Published topics:")
        _print_counts(publishers, "publisher", indent)
    if not args.publishers:
        print(f"{indent}\n{indent}Subscribed topics:")
        _print_counts(subscribers, "subscriber", indent)
    print()


def _print_counts(rows: Rows, role: str, indent: str) -> None:
    for topic, kind, nodes in rows:
        print(f"{indent} * {topic} [{kind}] {len(nodes)} {role}{'s' if len(nodes) > 1 else ''}")


def _info(args: argparse.Namespace) -> int:
    proxy = master(_SCRIPT)
    topic = global_name(args.topic, _SCRIPT)
    tables = [[row for row in rows if row[0] == topic] for rows in _tables(proxy)]
    if not any(tables):
        raise RosError(f"Unknown topic {topic}")
    print(f"Type: {next(row[1] for rows in tables for row in rows)}\n")
    for title, rows in zip(("Publishers", "Subscribers"), tables, strict=True):
        print(f"{title}: " + ("" if rows else "None"))
        for node in (node for _, _, nodes in rows for node in nodes):
            print(f" * {node} ({_uri(proxy, node)})")
        print()
    print()
    return 0


def _uri(proxy: MasterProxy, node: str) -> str:
    try:
        return str(proxy.call("lookupNode", node))
    except MasterError:
        return f"unknown address {node}"


def _type(args: argparse.Namespace) -> int:
    name = global_name(args.topic, _SCRIPT)
    types: dict[str, str] = dict(master(_SCRIPT).call("getTopicTypes"))
    if name in types:
        print(types[name])
        return 0
    from trundle.ros import field_type, split_topic

    field = split_topic(name, types)
    if field is None:
        raise UsageError(f"unknown topic type [{name}]")
    topic, path = field
    print(f"{types[topic]} {path} {field_type(types[topic], path)}")
    return 0


def _find(args: argparse.Namespace) -> int:
    print("\n".join(topic for topic, kind in master(_SCRIPT).call("getTopicTypes") if kind == args.type))
    return 0
