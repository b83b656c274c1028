"""Draw the nodes and topics of the graph, as rqt_graph does."""

import argparse
import json
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.drawing import graph_dot, graph_svg, node_graph

from .graph_command import master, ros_errors

EXAMPLES = """
  trundle graph                   as Graphviz text
  trundle graph -o graph.svg      as an image
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-o", "--output", metavar="FILE", help="an image (.svg), or Graphviz text (.gv, .dot)")
    parser.add_argument("-a", "--all", action="store_true", help="with /rosout, /clock and topics without subscribers")
    parser.add_argument("--json", action="store_true", help="nodes, topics and services as one JSON object")


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Draw the current graph."""
    publishers, subscribers, services = master("rosgraph").call("getSystemState")
    if args.json:
        tables = {"publishers": publishers, "subscribers": subscribers, "services": services}
        print(json.dumps({name: dict(table) for name, table in tables.items()}))
        return 0
    drawing = node_graph(dict(publishers), dict(subscribers), with_all=args.all)
    if args.output is None:
        print(graph_dot(drawing), end="")
        return 0
    target = Path(args.output)
    if target.suffix not in (".svg", ".gv", ".dot"):
        raise UsageError(f"{target} ends in none of .svg, .gv, .dot")
    write_atomically(target, graph_svg(drawing) if target.suffix == ".svg" else graph_dot(drawing))
    return 0
