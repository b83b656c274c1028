"""Draw the graph: which node publishes what to whom, as rqt_graph does."""

import argparse
import json
from pathlib import Path

from trundle.diagnostics import UsageError

from .graph_picture import Drawing, Item, as_dot, as_svg
from .running import master, original_errors

EXAMPLES = """
  trundle graph                   as text for Graphviz
  trundle graph -o graph.svg      as a picture
"""
_QUIET = ("/rosout", "/rosout_agg", "/clock", "/diagnostics", "/statistics")
"""What everybody talks about; rqt_graph hides them too."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-o", "--output", metavar="FILE", help="a picture (.svg), or Graphviz' language (.gv, .dot)")
    parser.add_argument("-a", "--all", action="store_true", help="with /rosout, /clock and topics that nobody hears")
    parser.add_argument("--json", action="store_true", help="nodes, topics and services as one JSON object")


@original_errors
def main(args: argparse.Namespace) -> int:
    """Draw the graph as it is now."""
    publishers, subscribers, services = master("rosgraph").call("getSystemState")
    if args.json:
        tables = {"publishers": publishers, "subscribers": subscribers, "services": services}
        print(json.dumps({name: dict(table) for name, table in tables.items()}))
        return 0
    drawing = _drawing(dict(publishers), dict(subscribers), with_all=args.all)
    if args.output is None:
        print(as_dot(drawing), end="")
        return 0
    target = Path(args.output)
    if target.suffix not in (".svg", ".gv", ".dot"):
        raise UsageError(f"{target} ends in none of .svg, .gv, .dot")
    try:
        target.write_text(as_svg(drawing) if target.suffix == ".svg" else as_dot(drawing), encoding="utf-8")
    except OSError as error:
        raise UsageError(f"{target} cannot be written: {error.strerror}") from None
    return 0


def _drawing(publishers: dict[str, list[str]], subscribers: dict[str, list[str]], *, with_all: bool) -> Drawing:
    topics = sorted({*publishers, *subscribers})
    if not with_all:
        topics = [t for t in topics if t not in _QUIET and t in publishers and t in subscribers]
    edges: list[tuple[Item, Item]] = []
    for topic in topics:
        item: Item = ("topic", topic)
        edges.extend((_node(name), item) for name in publishers.get(topic, []))
        edges.extend((item, _node(name)) for name in subscribers.get(topic, []))
    everybody = {node for table in (publishers, subscribers) for nodes in table.values() for node in nodes}
    items: list[Item] = [_node(name) for name in sorted(everybody) if name != "/rosout" or with_all]
    return Drawing([*items, *(("topic", topic) for topic in topics)], edges)


def _node(name: str) -> Item:
    return "node", name
